#pragma once

#include <vector>

#include "hovercraft_sim/hovercraft/forces.h"
#include "hovercraft_sim/hovercraft/rotors.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// The forces of a craft's laws of drag, then of its actuators besides its engines, in the order of
/// their ids. A lift fan has none of its own.
std::vector<Force> forcesOf(const VehicleScenario& vehicle);

/// The rotors of its engines and other actuators, in the order of their ids.
std::vector<Rotor> rotorsOf(const VehicleScenario& vehicle);

/// A fan of a cushion and the actuator that turns it: its speed is the actuator's level.
struct FanDrive {
  std::size_t fan = 0;       // index of the fan in the cushion
  std::size_t actuator = 0;  // id
};

/// Of the fans of a craft's cushion those that lift fans of its actuators turn, in their order.
std::vector<FanDrive> fanDrivesOf(const VehicleScenario& vehicle);

}  // namespace hovercraft
