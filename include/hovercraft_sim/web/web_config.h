#pragma once

#include <cstdint>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/config_node.h"
#include "hovercraft_sim/web/access.h"

namespace hovercraft_ros {

struct WebConfig {
  static constexpr double kLeastRate = 1.0;
  static constexpr double kMostRate = 60.0;
  static constexpr std::int64_t kMostViewers = 64;

  std::string address = "127.0.0.1";  // to listen on: of IPv4 or IPv6
  std::uint16_t port = 8080;          // 0: any that is free
  AccessRules access;
  double rate = 30.0;                         // Hz at which viewers are told the state
  std::int64_t viewers = 16;                  // at once
  std::string simulation = "hovercraft_sim";  // node whose services and topics are used
};

/// @param parameters the node's private namespace. @param node_name begins every error.
/// @throws std::invalid_argument that names the parameter, its value and the rule: an address other
/// than a loopback one needs a token. `bound_port`, which the node itself writes, is passed over.
HOVERCRAFT_PUBLIC WebConfig parseWebConfig(const hovercraft::ConfigNode& parameters,
                                           const std::string& node_name);

/// Where a browser finds the page; the word TOKEN in the place of a token.
HOVERCRAFT_PUBLIC std::string urlOf(const WebConfig& config, std::uint16_t port);

}  // namespace hovercraft_ros
