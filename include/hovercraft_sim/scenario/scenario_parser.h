#pragma once

#include <functional>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/overrides.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/scenario/yaml_text.h"

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
  /// Of a recording: a physics_version before that of the build is no error.
  bool may_be_older = false;
};

/// By which equations the bits of a run of this text were computed; 1, the first, if it does not
/// say. @throws std::invalid_argument if it is not the YAML of a map.
HOVERCRAFT_PUBLIC std::int64_t physicsVersionOf(const std::string& text, const std::string& source);

/// Checks a whole scenario. @param tree of treeOf().
/// @throws std::invalid_argument with one line that names source, key path, value and rule.
HOVERCRAFT_PUBLIC Scenario parseScenario(const ConfigNode& tree, const ScenarioSource& source);

/// Parses and checks the text of a scenario: of a file, of a parameter, of a recording. There is
/// one parser (treeOf), so a text means the same wherever it comes from.
/// @param overrides see withOverrides(); messages name them behind the source.
/// @throws std::invalid_argument also if the text is not YAML.
HOVERCRAFT_PUBLIC Scenario parseScenario(const std::string& text, const ScenarioSource& source,
                                         const OverrideList& overrides = {});

/// Reads the file and parses it; relative mesh paths start from its folder.
/// @param package_folder, note see ScenarioSource.
/// @param overrides as parseScenario().
/// @throws std::invalid_argument also if the file cannot be read or is not YAML.
HOVERCRAFT_PUBLIC Scenario loadScenario(
    const std::string& path, std::function<std::string(const std::string&)> package_folder = {},
    const OverrideList& overrides = {}, std::function<void(const std::string&)> note = {});

/// The scenario with every default written out, numbers as the shortest text that gives the same
/// bits, keys in a fixed order: parsing it gives the same scenario to the last bit. A craft with a
/// mesh among its parts is written with its mass, centre of mass and inertia instead, so that the
/// text needs no other file.
HOVERCRAFT_PUBLIC std::string toYaml(const Scenario& scenario);

}  // namespace hovercraft
