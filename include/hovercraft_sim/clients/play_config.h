#pragma once

#include <cstdint>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/config_node.h"

namespace hovercraft_ros {

/// The private parameters of play_commands, checked.
struct PlayConfig {
  std::string file;                      // commands CSV
  std::int64_t settle_ns = 1000000000;   // simulated time to wait after the last command
  std::uint32_t wanted_subscribers = 1;  // of each thrust topic before it begins
  bool ends_launch =
      false;  // at its end it interrupts the roslaunch that started it, as Ctrl-C does
};

/// @param parameters the node's private namespace as a tree: what the members of PlayConfig are
/// called; `settle` in s.
/// @param node_name begins every error.
/// @throws std::invalid_argument that names the parameter, its value and the rule.
HOVERCRAFT_PUBLIC PlayConfig parsePlayConfig(const hovercraft::ConfigNode& parameters,
                                             const std::string& node_name);

}  // namespace hovercraft_ros
