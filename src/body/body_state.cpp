#include "hovercraft_sim/body/body_state.h"

#include <cmath>

#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {

bool isInReach(const BodyState& state) {
  const Pose pose = poseOf(state);
  // Written so that NaN is out of reach; an orientation that was lost is 0 or no number.
  return pose.p_AB.cwiseAbs().maxCoeff() <= kFarthest &&
         std::abs(determinant(pose.R_AB) - 1.0) <= kUnitLength;
}

}  // namespace hovercraft
