#pragma once

#include <string>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

namespace hovercraft {

/// Name, mass, drag and initial motion, of a craft or a loose body.
/// @throws std::invalid_argument
VehicleScenario parseMovingBody(const std::string& name, const ConfigReader& reader,
                                const ScenarioSource& source, BodyModel model);

/// Reads `world`, and `hull` and `material` of the vehicles that were read before; without `world`
/// the hulls alone where there is a `ground`, and else nothing: these keys are refused then.
/// @param top the whole scenario. @throws std::invalid_argument, also if bodies overlap at the
/// start.
void parseWorld(const ConfigReader& top, const ScenarioSource& source, Scenario& scenario);

/// The text of `world` for toYaml(), and of `hull` and `material` of a craft, indented by four.
std::string worldYaml(const Scenario& scenario);
std::string surfaceYaml(const VehicleScenario& vehicle, const Scenario& scenario);

}  // namespace hovercraft
