#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/live/node_config.h"

#include "../support/files.h"
#include "../support/scenario_text.h"

namespace hovercraft_ros {
namespace {

using hovercraft::ConfigNode;

/// Parameters of a node, as a YAML map of texts.
ConfigNode parametersOf(const std::string& yaml) {
  return hovercraft::treeOf(yaml, "parameters");
}

/// Those with another one, or with another value for one.
ConfigNode with(const ConfigNode& parameters, const std::string& key, const std::string& text) {
  ConfigNode::Map members = parameters.members();
  members.erase(std::remove_if(members.begin(), members.end(),
                               [&key](const auto& member) { return member.first == key; }),
                members.end());
  members.emplace_back(key, ConfigNode::ofText(text, true));
  return ConfigNode::ofMap(members);
}

/// Parameters of a node with a valid scenario (steps of 2 ms) and these others.
ConfigNode parametersWith(const std::string& others) {
  return with(parametersOf(others.empty() ? "{}" : others), "scenario",
              hovercraft::testing::validScenario());
}

NodeConfig configWith(const std::string& others) {
  return parseNodeConfig(parametersWith(others), "/sim");
}

/// What parsing says, or "" if it says nothing.
std::string complaintAbout(const ConfigNode& parameters) {
  try {
    parseNodeConfig(parameters, "/sim");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

std::string complaintWith(const std::string& others) {
  return complaintAbout(parametersWith(others));
}

TEST(NodeConfig, HasADefaultForEverythingButTheScenario) {
  const NodeConfig config = configWith("");
  EXPECT_EQ(config.scenario.step_ns, 2000000);
  EXPECT_EQ(config.scenario.vehicles.at(0).name, "alpha");
  EXPECT_EQ(config.publish_every, 5);  // 100 Hz
  EXPECT_EQ(config.frames.world, "world");
  EXPECT_EQ(config.frames.prefix, "");
  EXPECT_EQ(config.real_time_factor, 1.0);
  EXPECT_FALSE(config.paused);
  EXPECT_FALSE(config.clock);
  EXPECT_EQ(config.clock_rate, 100.0);
  EXPECT_FALSE(config.lockstep);
  EXPECT_EQ(config.control_period, 5);
  EXPECT_EQ(config.lockstep_timeout, 5.0);
  EXPECT_EQ(config.diagnostic_period, 1.0);
}

TEST(NodeConfig, TakesEveryParameter) {
  const NodeConfig config = configWith(
      "{publish_rate: 50, world_frame: map, tf_prefix: red/1, real_time_factor: 0, paused: true, "
      "clock: true, "
      "clock_rate: 250, lockstep: true, control_period: 0.02, lockstep_timeout: 0.5, "
      "diagnostic_period: 0.1}");
  EXPECT_EQ(config.publish_every, 10);
  EXPECT_EQ(config.frames.world, "map");
  EXPECT_EQ(config.frames.prefix, "red/1");
  EXPECT_EQ(config.real_time_factor, 0.0);
  EXPECT_TRUE(config.paused);
  EXPECT_TRUE(config.clock);
  EXPECT_EQ(config.clock_rate, 250.0);
  EXPECT_TRUE(config.lockstep);
  EXPECT_EQ(config.control_period, 10);
  EXPECT_EQ(config.lockstep_timeout, 0.5);
  EXPECT_EQ(config.diagnostic_period, 0.1);
}

// The robot_description of such a craft would be a parameter of the node.
TEST(NodeConfig, NothingOfTheScenarioHasTheNameOfTheNode) {
  const auto complaint_of = [](const std::string& node_name, const std::string& others) {
    try {
      parseNodeConfig(parametersWith(others), node_name);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string rule =
      ": must not have the name of the node, below which its own parameters and topics lie: rename "
      "it, or the node (__name:=NAME)";
  EXPECT_EQ(complaint_of("/alpha", ""), "/alpha/scenario: vehicles.alpha" + rule);
  EXPECT_EQ(complaint_of("/red/alpha", ""), "/red/alpha/scenario: vehicles.alpha" + rule);
  EXPECT_EQ(complaint_of("/alpha/sim", ""), "");
}

TEST(NodeConfig, ThePublishRateDividesTheStepRate) {
  EXPECT_EQ(configWith("{publish_rate: 500}").publish_every, 1);
  EXPECT_EQ(configWith("{publish_rate: 250}").publish_every, 2);
  EXPECT_EQ(configWith("{publish_rate: 0.5}").publish_every, 1000);
  EXPECT_EQ(configWith("{publish_rate: 166.66666666667}").publish_every, 3);
  EXPECT_EQ(complaintWith("{publish_rate: 200}"),
            "/sim: publish_rate = 200: must divide the step rate of 500 Hz");
  EXPECT_EQ(complaintWith("{publish_rate: 1000}"),
            "/sim: publish_rate = 1000: must divide the step rate of 500 Hz");
  EXPECT_EQ(complaintWith("{publish_rate: 0}"), "/sim: publish_rate = 0: must be greater than 0");
}

TEST(NodeConfig, StepsLongerThanTheDefaultPeriodArePublishedEachTime) {
  EXPECT_EQ(configWith("{set: step_size=0.05}").publish_every, 1);
}

TEST(NodeConfig, TheControlPeriodIsWholeSteps) {
  EXPECT_EQ(configWith("{lockstep: true, control_period: 0.002}").control_period, 1);
  EXPECT_EQ(configWith("{lockstep: true, control_period: 0.006}").control_period, 3);
  EXPECT_EQ(configWith("{publish_rate: 50}").control_period, 10) << "the publish period by default";
  EXPECT_EQ(complaintWith("{control_period: 0.003}"),
            "/sim: control_period = 0.003: must be a whole number of steps of 0.002 s");
  EXPECT_EQ(complaintWith("{control_period: 0.0005}"),
            "/sim: control_period = 0.0005: must be a whole number of steps of 0.002 s");
  EXPECT_EQ(complaintWith("{control_period: -1}"),
            "/sim: control_period = -1: must be greater than 0");
  EXPECT_EQ(complaintWith("{lockstep: true, control_period: 1e300}"),
            "/sim: control_period = 1e300: must be a whole number of steps of 0.002 s");
}

TEST(NodeConfig, AControlPeriodWithoutLockstepIsAnError) {
  EXPECT_EQ(
      complaintWith("{control_period: 0.006}"),
      "/sim: control_period = 0.006: has a meaning in lockstep only: set lockstep or leave it "
      "out");
}

// The same rule holds when it is changed while the node runs.
TEST(NodeConfig, ARealTimeFactorIsZeroOrWhatCanBeMeant) {
  for (const double factor : {0.0, -0.0, 1e-6, 1.0, 1000.0}) {
    EXPECT_TRUE(isRealTimeFactor(factor)) << factor;
  }
  for (const double factor :
       {-1.0, 5e-324, 9e-7, 1000.1, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(isRealTimeFactor(factor)) << factor;
  }
}

TEST(NodeConfig, SaysWhichParameterBreaksWhichRule) {
  EXPECT_EQ(complaintWith("{world_frame: /map}"),
            "/sim: world_frame = /map: must not begin with a slash (tf2)");
  for (const char* prefix : {"/red", "red/", "/"}) {
    EXPECT_EQ(complaintWith(std::string("{tf_prefix: ") + prefix + "}"),
              std::string("/sim: tf_prefix = ") + prefix + ": must not begin or end with a slash");
  }
  EXPECT_EQ(complaintWith("{tf_prefix: ''}"), "/sim: tf_prefix: must be a text");
  EXPECT_EQ(complaintWith("{world_frame: ''}"), "/sim: world_frame: must be a text");
  EXPECT_EQ(complaintWith("{real_time_factor: -1}"),
            "/sim: real_time_factor = -1: must be 0 (as fast as it can) or 1e-6 to 1000");
  EXPECT_EQ(complaintWith("{real_time_factor: 1001}"),
            "/sim: real_time_factor = 1001: must be 0 (as fast as it can) or 1e-6 to 1000");
  const std::string of_a_switch = ": must be true or false (or 1, 0, yes, no, on, off)";
  EXPECT_EQ(complaintWith("{clock: maybe}"), "/sim: clock = maybe" + of_a_switch);
  EXPECT_EQ(complaintWith("{paused: 2}"), "/sim: paused = 2" + of_a_switch);
  EXPECT_EQ(complaintWith("{paused: [true]}"), "/sim: paused = [true]: must be a text");
  EXPECT_EQ(complaintWith("{clock_rate: 251}"), "/sim: clock_rate = 251: must be 0.001 to 250 Hz");
  EXPECT_EQ(complaintWith("{clock_rate: 0}"), "/sim: clock_rate = 0: must be 0.001 to 250 Hz");
  EXPECT_EQ(complaintWith("{clock_rate: 1e-10}"),
            "/sim: clock_rate = 1e-10: must be 0.001 to 250 Hz");
  EXPECT_EQ(complaintWith("{lockstep: 01}"), "/sim: lockstep = 01" + of_a_switch);
  EXPECT_EQ(complaintWith("{lockstep_timeout: 0}"),
            "/sim: lockstep_timeout = 0: must be greater than 0");
  EXPECT_EQ(complaintWith("{diagnostic_period: 0}"),
            "/sim: diagnostic_period = 0: must be 0.01 to 3600 s");
  EXPECT_EQ(complaintWith("{diagnostic_period: 1e-12}"),
            "/sim: diagnostic_period = 1e-12: must be 0.01 to 3600 s");
  EXPECT_EQ(complaintWith("{diagnostic_period: 1e10}"),
            "/sim: diagnostic_period = 1e10: must be 0.01 to 3600 s");
}

TEST(NodeConfig, AParameterThatNobodyKnowsIsAnError) {
  EXPECT_EQ(complaintWith("{publish_rat: 50}"),
            "/sim: publish_rat = 50: unknown key; known here: scenario, scenario_dir, "
            "scenario_file, set, publish_rate, world_frame, tf_prefix, truth_odom, map_height, "
            "map_resolution, real_time_factor, paused, clock, clock_rate, lockstep, "
            "control_period, lockstep_timeout, diagnostic_period");
}

// As roslaunch's `if`, and as rosparam reads YAML.
TEST(NodeConfig, ASwitchTakesTheWordsOfRoslaunchAndRosparam) {
  for (const char* word : {"true", "True", "TRUE", "1", "yes", "Yes", "on", "ON"}) {
    for (const char* key : {"paused", "clock", "lockstep"}) {
      const NodeConfig config = parseNodeConfig(with(parametersWith(""), key, word), "/sim");
      EXPECT_EQ(config.paused, key == std::string("paused")) << word;
      EXPECT_EQ(config.clock, key == std::string("clock")) << word;
      EXPECT_EQ(config.lockstep, key == std::string("lockstep")) << word;
    }
  }
  for (const char* word : {"false", "False", "FALSE", "0", "no", "No", "off", "OFF"}) {
    const ConfigNode parameters = with(parametersWith(""), "paused", word);
    EXPECT_FALSE(parseNodeConfig(parameters, "/sim").paused) << word;
  }
}

TEST(NodeConfig, AMissingScenarioIsExplained) {
  const std::string explanation =
      "/sim/scenario: the parameter is missing: give the text of a scenario file by <param "
      "name=\"scenario\" textfile=\"FILE\"/> inside the <node>, as sim.launch does, or the path of "
      "one on the node's machine as scenario_file";
  EXPECT_EQ(complaintAbout(parametersOf("{publish_rate: 50}")), explanation);
  EXPECT_EQ(complaintAbout(parametersOf("{}")), explanation) << "no parameter at all";
}

TEST(NodeConfig, TheTreeOfOldIsRefusedWithTheLineToWrite) {
  const std::string refusal =
      "/sim/scenario: must be the text of a scenario file; since version 0.2.0 its tree is "
      "refused, "
      "as a parameter server loses part of it: write <param name=\"scenario\" textfile=\"FILE\"/> "
      "in "
      "the place of <rosparam command=\"load\" ns=\"scenario\" file=\"FILE\"/>";
  EXPECT_EQ(complaintAbout(parametersOf("{scenario: {}}")), refusal);
  EXPECT_EQ(complaintAbout(parametersOf("{scenario: [], scenario_file: /a.yaml}")), refusal);
}

TEST(NodeConfig, AScenarioMayBeAFileOfTheNodesMachine) {
  const hovercraft::testing::TestFolder folder;
  std::filesystem::copy_file("test/data/cube.obj", folder.file("hull.obj"));
  const std::string text = hovercraft::testing::with(
      hovercraft::testing::validScenario(), hovercraft::testing::kMassByNumbers,
      "    parts: [{mesh: {file: hull.obj}, mass: 3}]\n");
  const std::string file = std::filesystem::absolute(folder.write("s.yaml", text)).string();
  const ConfigNode by_file = with(parametersOf("{}"), "scenario_file", file);
  const auto from_file = parseNodeConfig(by_file, "/sim").scenario;
  EXPECT_EQ(from_file.vehicles[0].mass_properties.mass, 3.0);

  const ConfigNode by_text = with(parametersOf("{}"), "scenario", text);
  EXPECT_EQ(complaintAbout(by_text).rfind("/sim/scenario: vehicles.alpha.parts[0].mesh.file = "
                                          "hull.obj: is relative to no folder",
                                          0),
            0U)
      << complaintAbout(by_text);
  const std::string directory = std::filesystem::path(file).parent_path().string();
  const auto from_text = parseNodeConfig(with(by_text, "scenario_dir", directory), "/sim").scenario;
  EXPECT_EQ(toYaml(from_text), toYaml(from_file));

  EXPECT_EQ(complaintAbout(with(by_text, "scenario_file", file)),
            "/sim: scenario_file = " + file + ": must not stand beside scenario: give one");
  EXPECT_EQ(
      complaintAbout(with(by_file, "scenario_dir", directory)),
      "/sim: scenario_dir = " + directory + ": belongs to scenario: a file has its own folder");
  EXPECT_EQ(complaintAbout(with(by_file, "scenario_file", "s.yaml")),
            "/sim: scenario_file = s.yaml: must be an absolute path");
  EXPECT_EQ(complaintAbout(with(by_text, "scenario_dir", "config")),
            "/sim: scenario_dir = config: must be an absolute path");
  EXPECT_EQ(complaintAbout(with(by_file, "scenario_file", "/nowhere/s.yaml")),
            "/nowhere/s.yaml: there is no such file");
}

TEST(NodeConfig, OverridesChangeTheScenario) {
  const auto mass = [](const std::string& set) {
    return configWith("{set: '" + set + "'}").scenario.vehicles[0].mass_properties.mass;
  };
  EXPECT_EQ(mass("vehicles.alpha.mass=6; seed=3"), 6.0);
  EXPECT_EQ(mass(";"), 5.5);
  EXPECT_EQ(mass(""), 5.5);
  EXPECT_EQ(complaintWith("{set: vehicles.beta.mass=6}"),
            "/sim/set vehicles.beta.mass=6: vehicles has no key beta; there: alpha");
  EXPECT_EQ(complaintWith("{set: {seed: 3}}"),
            "/sim: set = {seed: 3}: must be a text: KEY.PATH=VALUE; KEY.PATH=VALUE");
}

TEST(NodeConfig, AnErrorInTheScenarioNamesTheParameter) {
  const std::string text =
      hovercraft::testing::with(hovercraft::testing::validScenario(), "mass: 5.5", "mass: -5.5");
  EXPECT_EQ(complaintAbout(with(parametersOf("{}"), "scenario", text)),
            "/sim/scenario: vehicles.alpha.mass = -5.5: must be greater than 0");
}

TEST(NodeConfig, AMeshOfAPackageThatIsNotThereIsAnError) {
  const std::string text = hovercraft::testing::with(
      hovercraft::testing::validScenario(), hovercraft::testing::kMassByNumbers,
      "    parts: [{mesh: {file: 'package://no_such_package/a.obj'}, mass: 1}]\n");
  const std::string complaint = complaintAbout(with(parametersOf("{}"), "scenario", text));
  EXPECT_NE(complaint.find("no_such_package"), std::string::npos) << complaint;
}

TEST(NodeConfig, TheTrueOdometryMayHaveAnotherTopic) {
  EXPECT_EQ(configWith("").truth_odom, "odom");
  EXPECT_EQ(configWith("truth_odom: truth/odom").truth_odom, "truth/odom");
  for (const char* bad : {"/odom", "truth/", "a b", "truth//odom"}) {
    EXPECT_NE(complaintWith(std::string("truth_odom: '") + bad + "'").find("/sim: truth_odom = "),
              std::string::npos)
        << bad;
  }
  // One on which an actuator is commanded is that of something else.
  const std::string topic = "{truth_odom: truth/pilot, set: 'vehicles.alpha.engines.rear.topic=";
  EXPECT_NE(complaintWith(topic + "truth/pilot'}").find("/sim: truth_odom = truth/pilot"),
            std::string::npos);
  EXPECT_EQ(configWith(topic + "truth/helm'}").truth_odom, "truth/pilot");
}

TEST(NodeConfig, AMapHasAHeightAndCells) {
  EXPECT_FALSE(configWith("").map_height.has_value());
  const NodeConfig config = configWith("{map_height: 0.2, map_resolution: 0.1}");
  EXPECT_EQ(config.map_height, 0.2);
  EXPECT_EQ(config.map_resolution, 0.1);
  EXPECT_EQ(complaintWith("map_resolution: 0.1"),
            "/sim: map_resolution = 0.1: has a meaning with map_height only");
  EXPECT_EQ(complaintWith("{map_height: 0.2, map_resolution: 0}"),
            "/sim: map_resolution = 0: must be greater than 0");
}

}  // namespace
}  // namespace hovercraft_ros
