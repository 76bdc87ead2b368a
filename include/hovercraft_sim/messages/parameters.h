#pragma once

#include <XmlRpcValue.h>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/config_node.h"

namespace hovercraft_ros {

/// The parameters of a node, of which each is a number, true or false, or a text: as texts. A text
/// counts as one without quotes, as roslaunch makes a text of `1e1` and `yes`. What is a tree or a
/// list on the server is an empty map or list here: no parameter of ours is one, and what a
/// scenario file says cannot be told from the tree that the server keeps of it.
/// @param parameters a namespace; one that is not there has no parameters.
/// @param name of the node: begins an error.
/// @throws std::invalid_argument that names the parameter if it is of another type (binary, date).
HOVERCRAFT_PUBLIC hovercraft::ConfigNode parameterTree(const XmlRpc::XmlRpcValue& parameters,
                                                       const std::string& name);

}  // namespace hovercraft_ros
