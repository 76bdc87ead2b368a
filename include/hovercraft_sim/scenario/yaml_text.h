#pragma once

#include <cstddef>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/scenario/config_node.h"

namespace hovercraft {

/// Bounds of what is read, which no scenario that anyone flies comes near to: a hull of 10,000
/// points takes 1 MB and 50,000 values.
constexpr std::size_t kLongestYamlText = std::size_t{16} << 20U;  // bytes
constexpr std::size_t kMostYamlValues = 1000000;                  // ConfigNode::size()
constexpr std::size_t kDeepestYaml = 32;                          // ConfigNode::depth()

/// The tree of a YAML text, the one meaning that it has for every program:
/// - one document, UTF-8 (a byte order mark is passed over), lines that end in LF or CR LF and are
///   indented by spaces;
/// - a key is a text and stands once in its map; merge keys (`<<`: a map, or a list of maps of
/// which
///   the earlier wins) add what the map does not have itself; anchors and aliases; no tags;
/// - at most kLongestYamlText, kMostYamlValues, kDeepestYaml, aliases written out.
/// Any bytes may come.
/// @param source what the text is: begins every message.
/// @throws std::invalid_argument with source, key path or line, and rule.
HOVERCRAFT_PUBLIC ConfigNode treeOf(const std::string& text, const std::string& source);

/// A name or another text as a YAML scalar that is read as this text and as nothing else, by YAML
/// 1.1 too: in double quotes if it must be.
HOVERCRAFT_PUBLIC std::string yamlText(const std::string& text);

/// A number, or three in a list, as the shortest YAML that reads back the same; with a point where
/// there is an exponent, as YAML 1.1 takes 1e-06 for a text.
HOVERCRAFT_PUBLIC std::string yamlNumber(double number);
HOVERCRAFT_PUBLIC std::string yamlVector(const Vector3& v);

}  // namespace hovercraft
