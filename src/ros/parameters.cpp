#include "hovercraft_sim/ros/parameters.h"

#include <fmt/format.h>
#include <stdexcept>
#include <string>

namespace hovercraft_ros {
namespace {

/// XmlRpcValue converts in place: its accessors are not const.
template <class T>
T valueOf(const XmlRpc::XmlRpcValue& value) {
  XmlRpc::XmlRpcValue copy = value;
  return static_cast<T>(copy);
}

/// @param path of the value within the source; empty at the top.
YAML::Node treeOf(const XmlRpc::XmlRpcValue& value, const std::string& source,
                  const std::string& path) {
  using XmlRpc::XmlRpcValue;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return YAML::Node(valueOf<bool>(value) ? "true" : "false");
    case XmlRpcValue::TypeInt:
      return YAML::Node(fmt::format("{}", valueOf<int>(value)));
    case XmlRpcValue::TypeDouble:
      return YAML::Node(fmt::format("{:.17g}", valueOf<double>(value)));
    case XmlRpcValue::TypeString:
      return YAML::Node(valueOf<std::string>(value));
    case XmlRpcValue::TypeArray: {
      YAML::Node sequence(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i) {
        XmlRpcValue copy = value;
        sequence.push_back(treeOf(copy[i], source, fmt::format("{}[{}]", path, i)));
      }
      return sequence;
    }
    case XmlRpcValue::TypeStruct: {
      YAML::Node map(YAML::NodeType::Map);
      XmlRpcValue copy = value;
      const std::string prefix = path.empty() ? "" : path + ".";
      for (auto& member : copy) {
        map[member.first] = treeOf(member.second, source, prefix + member.first);
      }
      return map;
    }
    case XmlRpcValue::TypeInvalid:
      return YAML::Node();
    default:
      throw std::invalid_argument(fmt::format("{}{}{}: must be a number, text, list or map", source,
                                              path.empty() ? "" : ": ", path));
  }
}

}  // namespace

YAML::Node toYaml(const XmlRpc::XmlRpcValue& value, const std::string& source) {
  return treeOf(value, source, "");
}

}  // namespace hovercraft_ros
