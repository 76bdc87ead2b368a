#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include <hovercraft_sim/Step.h>
#include <ros/node_handle.h>
#include <ros/param.h>
#include <ros/service.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/wait_until.h"

namespace hovercraft_ros::testing {
namespace {

constexpr std::uint32_t kTicks = 500;  // the craft meet at tick 50

std::string scenarioOf(const std::string& node) {
  ros::NodeHandle handle;
  std::string text;
  const boost::function<void(const std_msgs::String&)> on_scenario =
      [&text](const std_msgs::String& message) { text = message.data; };
  const ros::Subscriber subscriber =
      handle.subscribe<std_msgs::String>(node + "/scenario", 1, on_scenario);
  waitUntil("a scenario of " + node, [&text] { return !text.empty(); });
  return text;
}

// Both start paused, so that each flies the ticks that it is told to.
TEST(OneMeaning, OfAFileForTheToolsAndForANodeByTextAndByPath) {
  std::string file;
  std::string set;
  ASSERT_TRUE(ros::param::get("~scenario", file));
  ASSERT_TRUE(ros::param::get("~set", set));
  const hovercraft::Scenario scenario = loadScenarioFile(file, {"--set", {set}});
  ASSERT_TRUE(scenario.world);
  EXPECT_EQ(scenario.vehicles[0].name, "no");
  hovercraft::Simulation simulation(scenario);
  for (std::uint32_t i = 0; i < kTicks; ++i) simulation.step();
  EXPECT_GT(simulation.motion(1).p_WB.x(), 0.8) << "it was pushed";
  for (const std::string node : {"/text/hovercraft_sim", "/file/hovercraft_sim"}) {
    EXPECT_EQ(scenarioOf(node), hovercraft::toYaml(scenario)) << node;
    ASSERT_TRUE(ros::service::waitForService(node + "/step", 30000)) << node;
    hovercraft_sim::Step step;
    step.request.steps = kTicks;
    ASSERT_TRUE(ros::service::call(node + "/step", step)) << node;
    ASSERT_TRUE(step.response.success) << node << ": " << step.response.message;
    EXPECT_EQ(step.response.tick, kTicks) << node;
    EXPECT_EQ(step.response.hash, simulation.hash()) << node;
  }
}

}  // namespace
}  // namespace hovercraft_ros::testing
