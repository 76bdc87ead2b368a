#include "hovercraft_sim/messages/parameters.h"

#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/io/number_text.h"

namespace hovercraft_ros {
namespace {

using hovercraft::ConfigNode;
using XmlRpc::XmlRpcValue;

/// @param value not const, as the accessors of XmlRpcValue are not.
ConfigNode nodeOf(XmlRpcValue& value, const std::string& name) {
  const auto plain = [](std::string text) { return ConfigNode::ofText(std::move(text), true); };
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return plain(static_cast<bool>(value) ? "true" : "false");
    case XmlRpcValue::TypeInt:
      return plain(fmt::format("{}", static_cast<int>(value)));
    case XmlRpcValue::TypeDouble:
      return plain(hovercraft::numberText(static_cast<double>(value)));
    case XmlRpcValue::TypeString:
      return plain(static_cast<std::string>(value));
    case XmlRpcValue::TypeArray:
      return ConfigNode::ofList({});
    case XmlRpcValue::TypeStruct:
      return ConfigNode::ofMap({});
    case XmlRpcValue::TypeInvalid:
      return {};
    default:
      throw std::invalid_argument(name + ": must be a number, true or false, or a text");
  }
}

}  // namespace

ConfigNode parameterTree(const XmlRpcValue& parameters, const std::string& name) {
  ConfigNode::Map members;
  if (parameters.getType() == XmlRpcValue::TypeStruct) {
    XmlRpcValue copy = parameters;
    for (auto& [key, value] : copy) {
      members.emplace_back(key, nodeOf(value, fmt::format("{}: {}", name, key)));
    }
  }
  return ConfigNode::ofMap(std::move(members));
}

}  // namespace hovercraft_ros
