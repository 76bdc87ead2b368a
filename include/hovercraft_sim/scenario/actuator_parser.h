#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// `engines` of a craft: those that are left out have limits 0. A craft that has other actuators
/// may leave all of them out.
void parseEngines(const ConfigReader& craft, VehicleScenario& vehicle);

/// `actuators` of a craft, by name. @throws std::invalid_argument that names key, value and rule.
std::vector<ActuatorScenario> parseActuators(const ConfigReader& reader);

/// The text of `engines` for toYaml(), every key with its value; empty if there are none, but other
/// actuators.
std::string enginesYaml(const VehicleScenario& vehicle);

/// The text of `actuators` for toYaml(), every key with its value; empty if there are none.
std::string actuatorsYaml(const VehicleScenario& vehicle);

}  // namespace hovercraft
