#include "hovercraft_sim/pilot/turning.h"

#include <cmath>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/rotation.h"

namespace hovercraft {

PlanarMotion MotionWatch::see(double time, const Vector3& p_WB, const Quaternion& q_WB,
                              const Vector3& v_WB, const Vector3& w_WB) {
  const FloatingPointEnvironment environment;
  const Matrix3 R_WB = rotationMatrix(q_WB);
  const double angle = angleOf(R_WB(1, 0), R_WB(0, 0));
  const double turns = has_seen_ ? std::round((heading_ - angle) / (2.0 * kPi)) : 0.0;
  heading_ = angle + turns * (2.0 * kPi);
  has_seen_ = true;
  const Vector3 v_WB_B = transposeTimes(R_WB, v_WB);
  return {time, p_WB.x(), p_WB.y(), heading_, v_WB_B.x(), v_WB_B.y(), w_WB.z()};
}

}  // namespace hovercraft
