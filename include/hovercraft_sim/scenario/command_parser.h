#pragma once

#include <string>

#include "hovercraft_sim/hovercraft/command_map.h"
#include "hovercraft_sim/scenario/config_reader.h"

namespace hovercraft {

/// `command` and, where the level is a thrust, `thrust_table` of an actuator or engine.
/// @param unit the word for a command that is the level itself: newton, ...
/// @throws std::invalid_argument that names key, value and rule.
CommandMap parseCommandMap(const ConfigReader& reader, const char* unit, bool has_thrust);

/// Both keys as YAML, with a comma before each.
std::string commandMapYaml(const CommandMap& map, const char* unit);

}  // namespace hovercraft
