#pragma once

#include <functional>
#include <string>
#include <yaml-cpp/yaml.h>

#include "hovercraft_sim/sim/scenario.h"

namespace hovercraft {

/// Where a scenario came from: named in every error, and the place that its relative mesh paths
/// start from.
struct ScenarioSource {
  std::string name;  // file or parameter
  std::string
      directory;  // of relative mesh paths; empty: a path must be absolute or a package:// URL
  /// Folder of a ROS package, empty if there is none; not set: package:// URLs are refused.
  std::function<std::string(const std::string& package)> package_folder;
  /// Called with what the user should know of a scenario that is in order, one line each, such as
  /// what was made of a mesh file; not set: nobody is told.
  std::function<void(const std::string& note)> note = {};
};

/// Parses and checks a whole scenario (design: one schema, one parser, for files and for the
/// parameter server).
/// @throws std::invalid_argument with one line that names source, key path, value and rule.
Scenario parseScenario(const YAML::Node& tree, const ScenarioSource& source);

/// The tree of a text.
/// @param source what the text is, for the message.
/// @throws std::invalid_argument with the source if it is not YAML.
YAML::Node treeOf(const std::string& text, const std::string& source);

/// Reads the file and parses it; relative mesh paths start from its folder.
/// @param package_folder, note see ScenarioSource.
/// @throws std::invalid_argument also if the file cannot be read or is not YAML.
Scenario loadScenario(const std::string& path,
                      std::function<std::string(const std::string&)> package_folder = {},
                      std::function<void(const std::string&)> note = {});

/// The scenario with every default written out, 17 digits, keys in a fixed order: parsing it gives
/// the same scenario to the last bit. A craft with a mesh among its parts is written with its mass,
/// centre of mass and inertia instead, so that the text needs no other file.
std::string toYaml(const Scenario& scenario);

}  // namespace hovercraft
