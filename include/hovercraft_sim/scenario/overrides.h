#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/config_node.h"

namespace hovercraft {

/// Values that take the place of those of a scenario's text.
struct OverrideList {
  std::string source;                    // what they came from, such as --set: begins messages
  std::vector<std::string> assignments;  // each KEY.PATH=VALUE, or several with ; between them
};

/// A tree with other values. KEY.PATH is written as messages write it: keys with points between
/// them (in quotes if they hold one of .[]=;"' or white space), [N] for an element of a list. VALUE
/// is YAML. All but the last key of a path must be there; the last one may be new. In quotes and in
/// brackets a semicolon separates nothing.
/// @throws std::invalid_argument that names the override and the rule: for a path that leads
/// nowhere, a value that is missing or is not YAML, one override that would undo another.
HOVERCRAFT_PUBLIC ConfigNode withOverrides(const ConfigNode& tree, const OverrideList& overrides);

/// What the messages about such a tree begin with: the source of the text and the overrides.
HOVERCRAFT_PUBLIC std::string sourceWith(const std::string& source, const OverrideList& overrides);

}  // namespace hovercraft
