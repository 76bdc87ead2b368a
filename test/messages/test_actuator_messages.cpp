#include <algorithm>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/ActuatorStatusArray.h>
#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/State.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "hovercraft_sim/bags/replay.h"
#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/messages/conversions.h"

#include "../support/files.h"
#include "../support/numbers.h"
#include "../support/scenarios.h"

/// Actuators besides the engines, in messages and bags.

namespace hovercraft_ros {
namespace {

using hovercraft::kFirstActuator;
using hovercraft::testing::messageOf;
using hovercraft::testing::scenarioOf;
using hovercraft::testing::TestFolder;
using hovercraft_sim::AppliedCommand;
using hovercraft_sim::State;

/// Four fans and a rudder in the stream of one of them, and no engine.
std::string fourFansYaml() {
  std::string yaml =
      "step_size: 0.01\nmodel: planar\nvehicles:\n  craft:\n    mass: 0.18\n    inertia: {ixx: "
      "0.001, iyy: 0.001, izz: 0.0008}\n    actuators:\n";
  for (const char* fan : {"bl", "br", "fl", "fr"}) {
    const bool is_aft = fan[0] == 'b';
    yaml += std::string("      ") + fan + ": {kind: fan, position: [" +
            (is_aft ? "-0.04" : "0.04") + ", " + (fan[1] == 'l' ? "0.04" : "-0.04") +
            ", 0], direction: [" + (is_aft ? "1" : "-1") +
            ", 0, 0], min_thrust: 0, max_thrust: 0.07, time_constant: 0.066}\n";
  }
  return yaml +
         "      tail: {kind: rudder, position: [-0.09, 0.04, 0], fan: bl, disc_diameter: 0.05, "
         "area: 0.001, lift_slope: 3}\n";
}

const char* const kFlight =
    "time,bl,br,tail,fl\n0,0.06,0.05,0,\n0.3,0.06,0.05,0.2,\n0.6,0.09,,,0.02\n";

class FourFans : public ::testing::Test {
 protected:
  void SetUp() override {
    SimulateRequest request;
    request.scenario = folder_.write("s.yaml", fourFansYaml());
    request.commands = folder_.write("c.csv", kFlight);
    request.duration = "1.5";
    request.output = run_;
    simulate(request, messages_);
  }

  template <class Message>
  std::vector<Message> messagesOf(const std::string& topic) const {
    const rosbag::Bag bag(run_);
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    std::vector<Message> messages;
    for (const rosbag::MessageInstance& instance : view) {
      messages.push_back(*instance.instantiate<Message>());
    }
    return messages;
  }

  TestFolder folder_;
  std::string run_ = folder_.file("run.bag");
  std::ostringstream messages_;
};

TEST_F(FourFans, AreReplayedToTheLastBit) {
  std::string verdict;
  EXPECT_EQ(replayBag({run_, "", {}}, verdict), 0) << verdict;
  EXPECT_EQ(verdict.rfind("identical: 150 ticks, 150 states compared", 0), 0U) << verdict;
}

TEST_F(FourFans, StandInStatesCommandsAndStatus) {
  const auto states = messagesOf<State>("/craft/state");
  const auto status = messagesOf<hovercraft_sim::ActuatorStatusArray>("/craft/actuators");
  ASSERT_EQ(states.size(), 150U);
  ASSERT_EQ(status.size(), 150U);
  ASSERT_EQ(states[50].actuators.size(), 5U);
  EXPECT_EQ(states[50].actuators[4], 0.2);  // the rudder has no lag
  EXPECT_GT(states[50].actuators[0], 0.05);
  for (std::size_t i = 0; i < 5; ++i) {
    const hovercraft_sim::ActuatorStatus& one = status[50].actuators[i];
    EXPECT_EQ(one.id, kFirstActuator + i);
    EXPECT_EQ(one.applied, states[50].actuators[i]);
  }
  EXPECT_EQ(status[50].actuators[4].name, "tail");
  EXPECT_EQ(status[50].actuators[4].kind, "rudder");
  EXPECT_EQ(status[70].actuators[0].saturated, 1);
  EXPECT_EQ(status[149].actuators[1].timed_out, 1);
  EXPECT_EQ(status[149].actuators[4].timed_out, 0);
  const auto commands = messagesOf<AppliedCommand>("/craft/commands");
  ASSERT_EQ(commands.size(), 3U);
  EXPECT_EQ(commands[2].engines, 0);
  EXPECT_EQ(commands[2].ids, (std::vector<std::uint8_t>{3, 5}));
  EXPECT_EQ(commands[2].values, (std::vector<double>{0.09, 0.02}));
}

TEST_F(FourFans, WhoseCommandsAreLostAreNamed) {
  EXPECT_NE(messages_.str().find("craft: actuator br timed out at 0.8 s: 0.05 were commanded"),
            std::string::npos)
      << messages_.str();
}

TEST_F(FourFans, FlyTheCommandsOfTheirOwnBag) {
  SimulateRequest request;
  request.scenario = folder_.file("s.yaml");
  request.commands = run_;
  request.duration = "1.5";
  request.output = folder_.file("again.bag");
  std::ostringstream again;
  EXPECT_EQ(simulate(request, again).hash, [&] {
    std::ostringstream first;
    request.commands = folder_.file("c.csv");
    return simulate(request, first).hash;
  }());
}

TEST_F(FourFans, ACommandForAnActuatorThatIsNotThereIsRefused) {
  const std::string damaged = folder_.file("damaged.bag");
  const auto complaint = [&](const std::function<void(AppliedCommand&)>& change) {
    {
      const rosbag::Bag run(run_);
      rosbag::Bag bag(damaged, rosbag::bagmode::Write);
      for (const rosbag::MessageInstance& instance : rosbag::View(run)) {
        const auto command = instance.instantiate<AppliedCommand>();
        if (command == nullptr) {
          bag.write(instance.getTopic(), instance.getTime(), instance);
          continue;
        }
        change(*command);
        bag.write(instance.getTopic(), instance.getTime(), *command);
      }
    }
    std::string verdict;
    const std::string message = messageOf([&] { replayBag({damaged, "", {}}, verdict); });
    return message.substr(std::min(message.size(), message.rfind(": ids") + 2));
  };
  EXPECT_EQ(complaint([](AppliedCommand& command) { command.ids.back() = 8; }),
            "ids: must be below 8: the craft has 5 actuators besides its engines");
  EXPECT_EQ(complaint([](AppliedCommand& command) { command.ids.front() = 2; }),
            "ids: must be 3 or more, ascending (2 is there)");
  EXPECT_EQ(complaint([](AppliedCommand& command) {
              command.values.pop_back();
            }).rfind("ids and values: must be as many", 0),
            0U);
}

TEST(ActuatorCommand, IsTakenWholeOrNotAtAll) {
  const hovercraft::Scenario scenario = scenarioOf(fourFansYaml());
  const hovercraft::VehicleScenario& craft = scenario.vehicles[0];
  hovercraft_sim::ActuatorCommand message;
  message.names = {"tail", "bl"};
  message.values = {0.1, 0.05};
  const auto command = toCommand(message, craft, 0);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->tick, 0);
  EXPECT_EQ(command->engines,
            hovercraft::maskOf(std::size_t{3}) | hovercraft::maskOf(std::size_t{7}));
  EXPECT_EQ(command->thrusts[3], 0.05);
  EXPECT_EQ(command->thrusts[7], 0.1);
  const hovercraft_sim::ActuatorCommand back = toActuatorCommand(*command, craft, ros::Time(1, 0));
  EXPECT_EQ(back.names, (std::vector<std::string>{"bl", "tail"}));
  EXPECT_EQ(back.values, (std::vector<double>{0.05, 0.1}));
  const auto refused = [&](std::vector<std::string> names, std::vector<double> values) {
    message.names = std::move(names);
    message.values = std::move(values);
    return !toCommand(message, craft, 0);
  };
  EXPECT_TRUE(refused({}, {}));
  EXPECT_TRUE(refused({"bl"}, {}));
  EXPECT_TRUE(refused({"bl", "bl"}, {0.1, 0.2}));
  EXPECT_TRUE(refused({"rear"}, {0.1}));
  EXPECT_TRUE(refused({"bl", "sail"}, {0.1, 0.2}));
  EXPECT_TRUE(refused({"bl"}, {hovercraft::testing::kNan}));
  EXPECT_FALSE(refused({"fr"}, {0.01}));
}

// In lockstep a state has one answer: engines and others go in one message. One that the craft
// lacks is left out, though a command of all engines is for it too.
TEST(ActuatorMessages, EnginesGoWithTheOthersInOne) {
  std::string yaml = fourFansYaml();
  const std::string engines =
      "    engines: {rear: {position: [-0.1, 0, 0], direction: [1, 0, 0], min_thrust: 0, "
      "max_thrust: 1}}\n";
  yaml.insert(yaml.find("    actuators:"), engines);
  const hovercraft::Scenario scenario = scenarioOf(yaml);
  hovercraft::Command command{
      0, 0, hovercraft::kAllEngines | hovercraft::maskOf(std::size_t{4}), {}};
  command.thrusts[0] = 0.5;
  command.thrusts[4] = 0.06;
  const hovercraft_sim::ActuatorCommand message =
      toActuatorCommand(command, scenario.vehicles[0], ros::Time(1, 0));
  EXPECT_EQ(message.names, (std::vector<std::string>{"rear", "br"}));
  EXPECT_EQ(message.values, (std::vector<double>{0.5, 0.06}));
  const auto back = toCommand(message, scenario.vehicles[0], 0);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->engines, hovercraft::maskOf(std::size_t{0}) | hovercraft::maskOf(std::size_t{4}));
}

// So that one message commands all of a craft: in lockstep one is taken.
TEST(ActuatorCommand, NamesEnginesToo) {
  const hovercraft::Scenario scenario =
      hovercraft_ros::loadScenarioFile("test/rostest/four_fans.yaml");
  hovercraft_sim::ActuatorCommand message;
  message.names = {"tail", "rear"};
  message.values = {0.1, 0.03};
  const auto command = toCommand(message, scenario.vehicles[0], 0);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->engines,
            hovercraft::maskOf(std::size_t{0}) | hovercraft::maskOf(std::size_t{8}));
  EXPECT_EQ(command->thrusts[0], 0.03);
  EXPECT_EQ(command->thrusts[8], 0.1);
  message.names = {"rear", "rear"};
  EXPECT_FALSE(toCommand(message, scenario.vehicles[0], 0));
  message.names = {"tail", "left"};  // it has none
  EXPECT_FALSE(toCommand(message, scenario.vehicles[0], 0));
}

}  // namespace
}  // namespace hovercraft_ros
