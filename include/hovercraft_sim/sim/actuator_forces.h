#pragma once

#include <vector>

#include "hovercraft_sim/hovercraft/forces.h"
#include "hovercraft_sim/sim/scenario.h"

namespace hovercraft {

/// The forces of a craft's actuators besides its engines, in the order of their ids. A lift fan has
/// none of its own.
std::vector<Force> forcesOf(const VehicleScenario& vehicle);

}  // namespace hovercraft
