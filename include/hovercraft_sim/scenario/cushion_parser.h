#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

namespace hovercraft {

/// The map behind `cushion` of a vehicle; none without it. @param actuators of the vehicle: its
/// lift fans may turn the fans of the cushion.
/// @throws std::invalid_argument
[[nodiscard]] std::optional<CushionParameters> parseCushion(
    const ConfigReader& vehicle, const std::vector<ActuatorScenario>& actuators);

/// The text of `cushion` for toYaml(), indented by four, every cell written out; empty without one.
std::string cushionYaml(const VehicleScenario& vehicle);

/// Whether each cushion of a scenario can do what it is for (doc/craft.md): what cannot fly, or is
/// not modelled, is an error; what flies badly is a note to the source. Each says its number.
/// @param top the whole scenario. @throws std::invalid_argument
void checkCushions(const ConfigReader& top, const ScenarioSource& source, const Scenario& scenario);

}  // namespace hovercraft
