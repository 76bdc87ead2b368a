#pragma once

#include <vector>

#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/world/island.h"

/// Velocities of the bodies of an island. A slot is 0 for what is fixed, else 1 + the index of the
/// member.

namespace hovercraft {

/// Velocity of a body's point at the start of the piece, m/s; 0 for what is fixed.
inline Vector3 velocityNow(std::int32_t slot, const Vector3& p_WC, const Scene& scene,
                           const std::vector<IslandMember>& members) {
  if (slot == 0) return Vector3::Zero();
  const IslandMember& member = members[at(slot - 1)];
  const Twist twist = twistOf(member.state, scene.mobilityOf(member.index));
  return velocityOfPoint(twist, p_WC, member.pose.p_AB);
}

/// The same at its end without contact.
inline Vector3 velocityAtEnd(std::int32_t slot, const Vector3& p_WC, const Scene& scene,
                             const std::vector<IslandMember>& members) {
  if (slot == 0) return Vector3::Zero();
  const IslandMember& member = members[at(slot - 1)];
  const Twist twist = twistOf(member.end, scene.mobilityOf(member.index));
  return velocityOfPoint(twist, p_WC, member.pose.p_AB);
}

/// How much faster a body moves on, on average over a piece of a step, than the mean of its
/// velocities at both ends says, m/s: half of what the piece adds to them with explicit Euler, as
/// much less with the semi-implicit one, nothing with the others but for curvature.
inline Vector3 lagOf(const IslandMember& member, const Scene& scene, double duration) {
  const Mobility& mobility = scene.mobilityOf(member.index);
  const Vector3 mean =
      0.5 * (twistOf(member.state, mobility).v_WB + twistOf(member.end, mobility).v_WB);
  return (positionOf(member.end) - positionOf(member.state)) / duration - mean;
}

}  // namespace hovercraft
