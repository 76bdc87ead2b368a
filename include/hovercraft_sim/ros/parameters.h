#pragma once

#include <XmlRpcValue.h>
#include <string>
#include <yaml-cpp/yaml.h>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// A value of the parameter server as the tree that a scenario file is parsed into: numbers keep
/// every bit (17 digits), so that a scenario loaded by <rosparam> and one read from its file are
/// the same.
/// @param source name of the parameter, the beginning of an error.
/// @throws std::invalid_argument with the key path for a type that has no place in a scenario
/// (binary, date).
HOVERCRAFT_PUBLIC YAML::Node toYaml(const XmlRpc::XmlRpcValue& value, const std::string& source);

}  // namespace hovercraft_ros
