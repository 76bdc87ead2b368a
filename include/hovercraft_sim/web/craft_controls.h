#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft_ros {

/// One engine or actuator as a driver has it before him.
struct CraftControl {
  std::string name;
  std::string unit;    // N, 1/s, rad, or empty: a share
  double least = 0.0;  // of its level
  double most = 0.0;
  double rest = 0.0;   // the level of a craft that nobody drives
  bool holds = false;  // without its driver it stays as it is: lift fans, rudders
  int ahead = 0;       // 1, 0 or -1: what of it goes with "ahead"
  int turn = 0;        // ... and with "turn left"
};

/// The engines that are built in, then the actuators. Ahead goes what pushes along x through the
/// centre of mass; where nothing does, whatever pushes along x (two screws abreast). With turns
/// goes what has an arm about it, and each rudder.
HOVERCRAFT_PUBLIC std::vector<CraftControl> controlsOf(const hovercraft::VehicleScenario& craft);

}  // namespace hovercraft_ros
