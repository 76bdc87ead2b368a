#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

namespace hovercraft_python {

/// A scenario, and the tree that it was read from, so that values of it may be changed.
class HeldScenario {
 public:
  /// @throws std::invalid_argument as parseScenario().
  HeldScenario(const std::string& text, hovercraft::ScenarioSource source);

  /// Reads a file. @param package_folder see ScenarioSource.
  /// @throws std::invalid_argument as loadScenario().
  static HeldScenario load(const std::string& path,
                           std::function<std::string(const std::string&)> package_folder);

  /// Changes values after the others that were changed; nothing is changed if it fails.
  /// @param assignment KEY.PATH=VALUE, see withOverrides().
  /// @throws std::invalid_argument as withOverrides() and parseScenario().
  void set(const std::string& assignment);

  const std::shared_ptr<const hovercraft::Scenario>& scenario() const { return scenario_; }

 private:
  hovercraft::ConfigNode tree_;
  hovercraft::ScenarioSource source_;
  hovercraft::OverrideList changes_;
  std::shared_ptr<const hovercraft::Scenario> scenario_;
};

}  // namespace hovercraft_python
