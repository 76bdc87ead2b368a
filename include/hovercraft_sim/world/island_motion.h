#pragma once

#include "hovercraft_sim/world/island.h"

namespace hovercraft {

/// How much faster a body moves on, on average over a piece of a step, than the mean of its
/// velocities at both ends says, m/s: half of what the piece adds to them with explicit Euler, as
/// much less with the semi-implicit one, nothing with the others but for curvature.
inline Vector3 lagOf(const IslandMember& member, const Scene& scene, double duration) {
  const Mobility& mobility = scene.mobilityOf(member.index);
  const Vector3 mean =
      0.5 * (velocityOf(member.state, mobility) + velocityOf(member.end, mobility));
  return (positionOf(member.end) - positionOf(member.state)) / duration - mean;
}

}  // namespace hovercraft
