#pragma once

#include <XmlRpcValue.h>
#include <yaml-cpp/yaml.h>

namespace hovercraft_ros {

/// A value of the parameter server as the tree that a scenario file is parsed into: numbers keep
/// every bit (17 digits), so that a scenario loaded by <rosparam> and one read from its file are
/// the same.
/// @throws std::invalid_argument for a type that has no place in a scenario (binary, date).
YAML::Node toYaml(const XmlRpc::XmlRpcValue& value);

}  // namespace hovercraft_ros
