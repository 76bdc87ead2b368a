#pragma once

#include <XmlRpcValue.h>
#include <cstdlib>
#include <string>
#include <yaml-cpp/yaml.h>

namespace hovercraft_ros::testing {

/// What <rosparam command="load"> makes of a YAML tree: whole numbers become int, other numbers
/// double, true and false bool, the rest text.
inline XmlRpc::XmlRpcValue loadedByRosparam(const YAML::Node& node) {
  XmlRpc::XmlRpcValue value;
  if (node.IsMap()) {
    for (const auto& member : node) {
      value[member.first.as<std::string>()] = loadedByRosparam(member.second);
    }
    return value;
  }
  if (node.IsSequence()) {
    value.setSize(static_cast<int>(node.size()));
    for (std::size_t i = 0; i < node.size(); ++i) {
      value[static_cast<int>(i)] = loadedByRosparam(node[i]);
    }
    return value;
  }
  const std::string& text = node.Scalar();
  if (text == "true" || text == "false") return XmlRpc::XmlRpcValue(text == "true");
  if (text.find_first_not_of("+-0123456789") == std::string::npos) {
    return XmlRpc::XmlRpcValue(std::stoi(text));
  }
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (*end == '\0') return XmlRpc::XmlRpcValue(number);
  return XmlRpc::XmlRpcValue(text);
}

}  // namespace hovercraft_ros::testing
