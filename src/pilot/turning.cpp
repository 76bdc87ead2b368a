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
  double turns = 0.0;
  if (last_) {
    // Of the headings that the angle may be, the one next to where the yaw rates lead.
    const double turn = 0.5 * (last_->yaw_rate + w_WB.z()) * (time - last_->time);
    turns = std::round((last_->heading + turn - angle) / (2.0 * kPi));
  }
  const Vector3 v_WB_B = transposeTimes(R_WB, v_WB);
  last_ = PlanarMotion{time,       p_WB.x(),   p_WB.y(), angle + turns * (2.0 * kPi),
                       v_WB_B.x(), v_WB_B.y(), w_WB.z()};
  return *last_;
}

}  // namespace hovercraft
