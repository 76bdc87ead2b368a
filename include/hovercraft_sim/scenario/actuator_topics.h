#pragma once

#include <cstddef>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/actuator_scenario.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario.h"

/// The topics on which single engines and other actuators are commanded.

namespace hovercraft {

/// `type` and `topic` of an actuator or engine. @throws std::invalid_argument that names key, value
/// and rule.
CommandTopic parseCommandTopic(const ConfigReader& reader);

/// Both keys as YAML, with a comma before each; the topic only where it is said.
std::string commandTopicYaml(const CommandTopic& topic);

/// A name of a topic by the rules of ROS, relative or absolute: letters, digits, _ and /, a letter
/// or / first, no empty part.
HOVERCRAFT_PUBLIC bool isTopicName(const std::string& name);

/// The topic of an actuator of a craft, an engine or another one, relative to the craft's namespace
/// or absolute. @param id of an engine that the craft has, or of another actuator.
HOVERCRAFT_PUBLIC std::string commandTopicOf(const VehicleScenario& vehicle, std::size_t id);
/// Whether its messages are Float32, not Float64.
HOVERCRAFT_PUBLIC bool isFloat32(const VehicleScenario& vehicle, std::size_t id);
/// A topic of a craft as an absolute one, with the craft's namespace in the root.
HOVERCRAFT_PUBLIC std::string absoluteTopic(const VehicleScenario& vehicle,
                                            const std::string& topic);

/// Whether an absolute topic is that of an actuator of some craft.
HOVERCRAFT_PUBLIC bool isCommandTopic(const Scenario& scenario, const std::string& topic);

/// No topic of an actuator is one of something else. @param reader of the scenario.
/// @throws std::invalid_argument that names key, value and rule.
void checkCommandTopics(const ConfigReader& reader, const Scenario& scenario);

}  // namespace hovercraft
