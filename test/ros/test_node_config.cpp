#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/ros/node_config.h"

#include "../support/scenario_text.h"

namespace hovercraft_ros {
namespace {

/// Parameters of a node with a valid scenario (steps of 2 ms) and these others.
YAML::Node parametersWith(const std::string& others) {
  YAML::Node parameters = YAML::Load(others.empty() ? "{}" : others);
  parameters["scenario"] = YAML::Load(hovercraft::testing::validScenario());
  return parameters;
}

NodeConfig configWith(const std::string& others) {
  return parseNodeConfig(parametersWith(others), "/sim");
}

/// What parsing says, or "" if it says nothing.
std::string complaintAbout(const YAML::Node& parameters) {
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
  YAML::Node parameters = parametersWith("");
  parameters["scenario"]["step_size"] = "0.05";
  EXPECT_EQ(parseNodeConfig(parameters, "/sim").publish_every, 1);
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
  EXPECT_EQ(complaintWith("{paused: 1}"), "/sim: paused = 1: must be true or false");
  EXPECT_EQ(complaintWith("{clock: maybe}"), "/sim: clock = maybe: must be true or false");
  EXPECT_EQ(complaintWith("{clock_rate: 251}"), "/sim: clock_rate = 251: must be 0.001 to 250 Hz");
  EXPECT_EQ(complaintWith("{clock_rate: 0}"), "/sim: clock_rate = 0: must be 0.001 to 250 Hz");
  EXPECT_EQ(complaintWith("{clock_rate: 1e-10}"),
            "/sim: clock_rate = 1e-10: must be 0.001 to 250 Hz");
  EXPECT_EQ(complaintWith("{lockstep: 2}"), "/sim: lockstep = 2: must be true or false");
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
            "/sim: publish_rat = 50: unknown key; known here: scenario, publish_rate, world_frame, "
            "tf_prefix, real_time_factor, paused, clock, clock_rate, lockstep, control_period, "
            "lockstep_timeout, diagnostic_period");
}

TEST(NodeConfig, AMissingScenarioIsExplained) {
  const std::string explanation =
      "/sim/scenario: the parameter is missing; load a scenario with <rosparam command=\"load\" "
      "ns=\"scenario\" file=\"...\"/> inside the <node>, as sim.launch does";
  EXPECT_EQ(complaintAbout(YAML::Load("{publish_rate: 50}")), explanation);
  EXPECT_EQ(complaintAbout(YAML::Node()), explanation) << "no parameter at all";
}

TEST(NodeConfig, AnErrorInTheScenarioNamesTheParameter) {
  YAML::Node parameters = parametersWith("");
  parameters["scenario"]["vehicles"]["alpha"]["mass"] = "-5.5";
  EXPECT_EQ(complaintAbout(parameters),
            "/sim/scenario: vehicles.alpha.mass = -5.5: must be greater than 0");
}

TEST(NodeConfig, AMeshOfAPackageThatIsNotThereIsAnError) {
  YAML::Node parameters = parametersWith("");
  YAML::Node craft = parameters["scenario"]["vehicles"]["alpha"];
  craft.remove("mass");
  craft.remove("inertia");
  craft.remove("center_of_mass");
  craft["parts"] = YAML::Load("[{mesh: {file: 'package://no_such_package/a.obj'}, mass: 1}]");
  EXPECT_NE(complaintAbout(parameters).find("no_such_package"), std::string::npos)
      << complaintAbout(parameters);
}

}  // namespace
}  // namespace hovercraft_ros
