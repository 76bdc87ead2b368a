#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hovercraft_sim/cushion/ground.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

namespace hovercraft {

/// The map behind `ground` of a scenario; none without it.
/// @param top the whole scenario. @throws std::invalid_argument
[[nodiscard]] std::optional<GroundScenario> parseGround(const ConfigReader& top,
                                                        const ScenarioSource& source);

/// The text of `ground` for toYaml(); it needs no other file. Empty without one.
std::string groundYaml(const Scenario& scenario);

/// The surface of it, without the obstacles of a world.
std::shared_ptr<const Ground> surfaceOf(const GroundScenario& ground);

}  // namespace hovercraft
