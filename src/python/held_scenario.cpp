#include "hovercraft_sim/python/held_scenario.h"

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "hovercraft_sim/io/input_file.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft_python {

using hovercraft::ScenarioSource;

HeldScenario::HeldScenario(const std::string& text, ScenarioSource source)
    : tree_(hovercraft::treeOf(text, source.name)),
      source_(std::move(source)),
      changes_{"--set", {}},
      scenario_(std::make_shared<const hovercraft::Scenario>(parseScenario(tree_, source_))) {}

HeldScenario HeldScenario::load(const std::string& path,
                                std::function<std::string(const std::string&)> package_folder) {
  std::error_code unreadable;
  if (!std::filesystem::exists(path, unreadable)) {
    throw std::invalid_argument(path + ": there is no such file");
  }
  const std::string text = hovercraft::readWholeFile(path, hovercraft::kLongestYamlText);
  const std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
  return {text, {path, folder.string(), std::move(package_folder), {}}};
}

void HeldScenario::set(const std::string& assignment) {
  const hovercraft::ConfigNode tree = withOverrides(tree_, {changes_.source, {assignment}});
  hovercraft::OverrideList changes = changes_;
  changes.assignments.push_back(assignment);
  ScenarioSource source = source_;
  source.name = sourceWith(source_.name, changes);
  scenario_ = std::make_shared<const hovercraft::Scenario>(parseScenario(tree, source));
  tree_ = tree;
  changes_ = std::move(changes);
}

}  // namespace hovercraft_python
