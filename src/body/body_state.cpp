#include "hovercraft_sim/body/body_state.h"

#include <cmath>

#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {

namespace {

double sizeOf(const Quaternion& q_WB) {
  return squaredNorm(q_WB);
}

double sizeOf(const Matrix3& R_WB) {
  return determinant(R_WB);
}

}  // namespace

bool isInReach(const BodyState& state) {
  // Written so that NaN is out of reach; an orientation that was lost is 0 or no number.
  return std::visit(
      [](const auto& body) {
        const Vector3& p = body.p_WB;
        return std::abs(p.x()) <= kFarthest && std::abs(p.y()) <= kFarthest &&
               std::abs(p.z()) <= kFarthest &&
               std::abs(sizeOf(body.orientation) - 1.0) <= kUnitLength;
      },
      state);
}

}  // namespace hovercraft
