#pragma once

#include <memory>
#include <optional>

#include "hovercraft_sim/cushion/cushion.h"
#include "hovercraft_sim/cushion/ground.h"
#include "hovercraft_sim/cushion/hover.h"
#include "hovercraft_sim/cushion/pads.h"
#include "hovercraft_sim/hovercraft/ground_forces.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// The cushion of a craft that has one.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<Cushion> cushionOf(const VehicleScenario& vehicle);

/// The vertices by which a craft or a loose body stands on `ground`: those of its hull, in a
/// spatial scenario with a ground. None without a hull.
Pads padsOf(const Scenario& scenario, const VehicleScenario& body);

/// Cushion and pads of a craft or a loose body; none if it has neither.
std::shared_ptr<const GroundForces> groundForcesOf(const Scenario& scenario,
                                                   const VehicleScenario& body);

/// The surface of `ground`, without the obstacles of the world: what pads stand on. None without
/// it.
std::shared_ptr<const Ground> bareGroundOf(const Scenario& scenario);

/// What cushions blow on: `ground`, and the obstacles of the world as roofs over it. None without
/// both.
HOVERCRAFT_PUBLIC std::shared_ptr<const Ground> groundOf(const Scenario& scenario);

/// Mass, tensor and weight as hoverOf() wants them.
HOVERCRAFT_PUBLIC HoverBody hoverBodyOf(const Scenario& scenario, const VehicleScenario& vehicle);

}  // namespace hovercraft
