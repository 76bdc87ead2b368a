#pragma once

#include <string>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// Reads `sensors` and `tf` of every vehicle of a scenario whose other keys have been read.
/// @param top the whole scenario.
/// @throws std::invalid_argument with source, key path, value and rule.
void parseSensors(const ConfigReader& top, Scenario& scenario);

/// The same as YAML, indented as keys of a vehicle; empty if the vehicle has no sensors and its tf
/// is the default.
std::string sensorsYaml(const VehicleScenario& vehicle);

}  // namespace hovercraft
