#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/control/velocity_law.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// What a velocity controller needs, as its YAML file has it.
struct VelocityParameters {
  VelocityPlant plant;
  VelocityGains gains;
  std::vector<CommandMap> commands;  // of each actuator of the plant: what commands its level
};

/// By the masses, engines and drag of a craft of a scenario.
HOVERCRAFT_PUBLIC VelocityParameters velocityParametersOf(const VehicleScenario& vehicle);

/// As YAML. @param origin for the comment at its head.
HOVERCRAFT_PUBLIC std::string velocityYaml(const VelocityParameters& parameters,
                                           const std::string& origin);

/// Reads the keys of velocityYaml(). @throws std::invalid_argument with source, key, value, rule.
HOVERCRAFT_PUBLIC VelocityParameters parseVelocityParameters(const ConfigReader& reader);

}  // namespace hovercraft
