#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/live/node_config.h"
#include "hovercraft_sim/messages/parameters.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/broken_craft_rules.h"
#include "../support/broken_rules.h"
#include "../support/files.h"
#include "../support/yaml_rules.h"

/// A text means the same to the node and to the tools: by parameters and by file, with the
/// functions that both use.

namespace hovercraft_ros {
namespace {

using hovercraft::Scenario;
using hovercraft::testing::BrokenRule;
using hovercraft::testing::contentOf;
using hovercraft::testing::messageOf;
using hovercraft::testing::TestFolder;
using XmlRpc::XmlRpcValue;

/// As sim.launch gives it.
Scenario byParameters(const std::string& text, const std::string& folder, const std::string& set) {
  XmlRpcValue parameters;
  parameters["scenario"] = text;
  if (!folder.empty()) parameters["scenario_dir"] = folder;
  parameters["set"] = set;
  return parseNodeConfig(parameterTree(parameters, "/sim"), "/sim").scenario;
}

Scenario byPathParameter(const std::string& file, const std::string& set) {
  XmlRpcValue parameters;
  parameters["scenario_file"] = std::filesystem::absolute(file).string();
  parameters["set"] = set;
  return parseNodeConfig(parameterTree(parameters, "/sim"), "/sim").scenario;
}

/// The bits of where a flight ends: they hold every number of the scenario.
/// The hash of its state after a while, or why it flies no further.
std::string flightOf(const Scenario& scenario) {
  hovercraft::Simulation simulation(scenario);
  for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
    simulation.push({0, i, hovercraft::kAllEngines, {1.0, 0.2, 0.3}});
  }
  try {
    for (int i = 0; i < 100; ++i) simulation.step();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return std::to_string(simulation.hash());
}

void expectOneMeaning(const std::string& file, const std::string& set) {
  const std::string text = contentOf(file);
  const std::string folder = std::filesystem::absolute(file).parent_path().string();
  const Scenario offline = loadScenarioFile(file, {"--set", {set}});
  for (const Scenario& live : {byParameters(text, folder, set), byPathParameter(file, set)}) {
    EXPECT_EQ(hovercraft::toYaml(live), hovercraft::toYaml(offline)) << file;
    EXPECT_EQ(flightOf(live), flightOf(offline)) << file;
  }
  // What ~scenario says is a scenario too, and the same one.
  const Scenario again = hovercraft::parseScenario(hovercraft::toYaml(offline), {file, "", {}});
  EXPECT_EQ(hovercraft::toYaml(again), hovercraft::toYaml(offline)) << file;
  EXPECT_EQ(flightOf(again), flightOf(offline)) << file;
}

TEST(OneMeaning, OfEveryShippedScenario) {
  int count = 0;
  for (const auto& entry : std::filesystem::directory_iterator("config")) {
    if (entry.path().extension() != ".yaml") continue;
    expectOneMeaning(entry.path().string(), ";");
    expectOneMeaning(entry.path().string(), "step_size=0.0005; gravity=[0, 0, -1]");
    ++count;
  }
  EXPECT_GE(count, 7);
}

/// What a message says behind its source.
std::string behind(const std::string& source, const std::string& message) {
  EXPECT_EQ(message.rfind(source + ": ", 0), 0U) << message;
  return message.substr(std::min(message.size(), source.size() + 2));
}

/// The same scenario, or the same message, from a file and from a parameter.
void expectOneOutcome(const std::string& text, const std::string& name) {
  const TestFolder folder;
  const std::string file = folder.write("s.yaml", text);
  const std::string directory = std::filesystem::absolute("test/data").string();
  Scenario offline;
  Scenario live;
  const std::string by_file = messageOf([&] { offline = loadScenarioFile(file); });
  const std::string by_text = messageOf([&] { live = byParameters(text, directory, ";"); });
  if (by_file == "nothing was thrown") {
    ASSERT_EQ(by_text, by_file) << name;
    EXPECT_EQ(hovercraft::toYaml(live), hovercraft::toYaml(offline)) << name;
    EXPECT_EQ(flightOf(live), flightOf(offline)) << name;
  } else {
    EXPECT_EQ(behind("/sim/scenario", by_text), behind(file, by_file)) << name;
  }
}

TEST(OneMeaning, OfEveryRuleOfYaml) {
  for (const auto& rule : hovercraft::testing::yamlRules()) expectOneOutcome(rule.text, rule.name);
}

TEST(OneMeaning, OfEveryRuleOfAScenario) {
  for (const auto* rules :
       {&hovercraft::testing::kBrokenKeys, &hovercraft::testing::kBrokenNumbers,
        &hovercraft::testing::kBrokenTimes, &hovercraft::testing::kBrokenStructures,
        &hovercraft::testing::kBrokenInertias}) {
    for (const BrokenRule& rule : *rules) {
      expectOneOutcome(hovercraft::testing::with(hovercraft::testing::validScenario(),
                                                 rule.old_part, rule.new_part),
                       rule.name);
    }
  }
}

// An empty world is one: two crates that meet bounce, and do not pass through each other.
TEST(OneMeaning, OfAnEmptyWorld) {
  const std::string engines =
      "engines: {rear: {position: [-0.25,0,0], direction: [1,0,0], min_thrust: 0, max_thrust: "
      "4.5}, "
      "left: {position: [0.2,0.15,0], direction: [0,-1,0], min_thrust: 0, max_thrust: 1.5}, right: "
      "{position: [0.2,-0.15,0], direction: [0,1,0], min_thrust: 0, max_thrust: 1.5}}";
  const std::string craft = "{parts: [{box: {size: [0.6,0.4,0.12]}, mass: 5}], " + engines;
  const std::string text = "{step_size: 0.001, vehicles: {a: " + craft +
                           ", initial: {velocity: [1,0,0]}}, b: " + craft +
                           ", initial: {position: [2,0,0]}}}, world: {}}";
  const Scenario live = byParameters(text, "", ";");
  ASSERT_TRUE(live.world);
  const std::string published = hovercraft::toYaml(live);
  EXPECT_NE(published.find("\nworld:\n"), std::string::npos);
  hovercraft::Simulation simulation(
      hovercraft::parseScenario(published, {"/hovercraft_sim/scenario", "", {}}));
  for (int i = 0; i < 3000; ++i) simulation.step();
  // Restitution 0: the two go on together, 0.6 m apart.
  EXPECT_NEAR(simulation.motion(1).p_WB.x() - simulation.motion(0).p_WB.x(), 0.6, 1e-5);
}

}  // namespace
}  // namespace hovercraft_ros
