#pragma once

#include <string>
#include <yaml-cpp/yaml.h>

#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/sim/scenario.h"

namespace hovercraft_ros {

/// The node's private parameters, checked.
struct NodeConfig {
  hovercraft::Scenario scenario;
  hovercraft::Tick publish_every = 1;  // ticks from one published state to the next
  std::string world_frame;
};

/// @param parameters the node's private namespace as a tree: `scenario` (design: scenario file),
/// `publish_rate` in Hz (a divisor of the step rate; default the nearest to 100), `world_frame`
/// (default "world").
/// @param node_name begins every error.
/// @throws std::invalid_argument that names the parameter, its value and the rule.
NodeConfig parseNodeConfig(const YAML::Node& parameters, const std::string& node_name);

}  // namespace hovercraft_ros
