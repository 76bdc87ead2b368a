#pragma once

#include <string>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// `drag` of a craft or a loose body. @throws std::invalid_argument that names key, value and rule.
void parseDrag(const ConfigReader& reader, VehicleScenario& vehicle);

/// The text of `drag` for toYaml(), every key with its value.
std::string dragYaml(const VehicleScenario& vehicle);

}  // namespace hovercraft
