#pragma once

#include <variant>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/geometry/pose.h"

namespace hovercraft {

/// State of a body in the representation of its orientation that the scenario chose.
using BodyState = std::variant<RigidBodyState<Quaternion>, RigidBodyState<Matrix3>>;

/// Of the centre of mass, in W.
inline Pose poseOf(const BodyState& state) {
  return std::visit(
      [](const auto& body) {
        return Pose{rotationMatrix(body.orientation), body.p_WB};
      },
      state);
}

/// Of the centre of mass, m, in W.
inline const Vector3& positionOf(const BodyState& state) {
  return std::visit([](const auto& body) -> const Vector3& { return body.p_WB; }, state);
}

/// B -> W; of a matrix the quaternion of the same rotation.
inline Quaternion orientationOf(const BodyState& state) {
  return std::visit([](const auto& body) { return toQuaternion(body.orientation); }, state);
}

/// Of the centre of mass, m/s, in W: twistOf() without the turn.
inline Vector3 velocityOf(const BodyState& state, const Mobility& mobility) {
  return std::visit([&](const auto& body) { return mobility.velocity(body.momentum_W); }, state);
}

/// Of the centre of mass, in W.
inline Twist twistOf(const BodyState& state, const Mobility& mobility) {
  return std::visit([&](const auto& body) { return mobility.twist(body); }, state);
}
/// The same of a body with rotors. @param rotors_B as Mobility::twist().
inline Twist twistOf(const BodyState& state, const Mobility& mobility, const Vector3& rotors_B) {
  return std::visit([&](const auto& body) { return mobility.twist(body, rotors_B); }, state);
}

/// Whether distances to the body are numbers: no coordinate beyond kFarthest, and a pose.
bool isInReach(const BodyState& state);

}  // namespace hovercraft
