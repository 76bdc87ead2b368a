#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/ActuatorCommand.h>
#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/RunEvent.h>
#include <hovercraft_sim/ThrustCommand.h>
#include <rosbag/bag.h>
#include <std_msgs/Float32.h>
#include <std_msgs/Float64.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/bags/commands_bag.h"
#include "hovercraft_sim/bags/simulate.h"

#include "../support/files.h"
#include "../support/scenarios.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Command;
using hovercraft::Vector3;
using hovercraft::testing::messageOf;
using hovercraft::testing::oneCraftYaml;
using hovercraft::testing::scenarioOf;
using hovercraft::testing::TestFolder;
using hovercraft::testing::twoCraftYaml;

// A bag that was recorded live begins at a time of the wall clock.
const ros::Time kBegin(1700000000, 250000000);

ros::Time after(double seconds) {
  return kBegin + ros::Duration(seconds);
}

hovercraft_sim::AppliedCommand appliedAt(std::uint64_t tick, double rear) {
  hovercraft_sim::AppliedCommand message;
  message.tick = tick;
  message.engines = hovercraft_sim::AppliedCommand::REAR;
  message.rear = rear;
  return message;
}

hovercraft_sim::ThrustCommand thrustOf(double rear, double left, double right) {
  hovercraft_sim::ThrustCommand message;
  message.rear = rear;
  message.left = left;
  message.right = right;
  return message;
}

std_msgs::Float64 newtons(double value) {
  std_msgs::Float64 message;
  message.data = value;
  return message;
}

class CommandsBag : public ::testing::Test {
 protected:
  /// Writes a bag whose first message, at kBegin, is of another topic.
  void write(const std::function<void(rosbag::Bag&)>& fill) const {
    rosbag::Bag bag(path_, rosbag::bagmode::Write);
    bag.write("/chatter", kBegin, std_msgs::String());
    fill(bag);
  }

  std::vector<Command> read(const hovercraft::Scenario& scenario) const {
    BagCommandSource source(path_, scenario);
    std::vector<Command> commands;
    while (const auto command = source.next()) commands.push_back(*command);
    return commands;
  }

  std::string errorOf(const hovercraft::Scenario& scenario) const {
    const std::string message = messageOf([&] { read(scenario); });
    return message.rfind(path_, 0) == 0 ? "c.bag" + message.substr(path_.size()) : message;
  }

  TestFolder folder_;
  std::string path_ = folder_.file("c.bag");
  hovercraft::Scenario one_ = scenarioOf(oneCraftYaml());
  hovercraft::Scenario two_ = scenarioOf(twoCraftYaml());
};

TEST_F(CommandsBag, PlaysEachActuatorFromTheTopicAndTypeThatTheScenarioSays) {
  const hovercraft::Scenario boat = scenarioOf(
      "step_size: 0.01\nvehicles:\n  boat:\n    mass: 1\n    inertia: {ixx: 1, iyy: 1, izz: "
      "1}\n    engines:\n      left: {position: [0, 0, 0], direction: [1, 0, 0], min_thrust: 0, "
      "max_thrust: 1, type: float32, topic: thrusters/left}\n    actuators:\n      tail: {kind: "
      "rudder, position: [-1, 0, 0], area: 0.1, lift_slope: 3, topic: /helm}\n      lift: {kind: "
      "lift_fan}\n");
  write([](rosbag::Bag& bag) {
    std_msgs::Float32 single;
    single.data = 0.1F;
    hovercraft_sim::ActuatorCommand several;
    several.names = {"lift", "left"};
    several.values = {0.5, 0.25};
    bag.write("/boat/thrusters/left", after(1.0), single);
    bag.write("/helm", after(2.0), newtons(0.3));
    bag.write("/boat/actuator_command", after(3.0), several);
    bag.write("/boat/actuators/lift", after(4.0), newtons(0.7));
    bag.write("/boat/actuators/tail", after(4.0), newtons(9.0));  // no topic of it
  });
  const auto commands = read(boat);
  ASSERT_EQ(commands.size(), 4U);
  EXPECT_EQ(commands[0].engines, 2);
  EXPECT_EQ(commands[0].thrusts[1], static_cast<double>(0.1F));
  EXPECT_EQ(commands[0].tick, 100);
  EXPECT_EQ(commands[1].engines, 16);
  EXPECT_EQ(commands[1].thrusts[4], 0.3);
  EXPECT_EQ(commands[2].engines, 2 + 8);
  EXPECT_EQ(commands[2].thrusts[3], 0.5);
  EXPECT_EQ(commands[3].thrusts[3], 0.7);
  write([](rosbag::Bag& bag) { bag.write("/boat/thrusters/left", after(1.0), newtons(0.1)); });
  EXPECT_NE(errorOf(boat).find("Float32"), std::string::npos) << errorOf(boat);
}

TEST_F(CommandsBag, PlaysAppliedCommandsAtTheirTicks) {
  write([](rosbag::Bag& bag) {
    bag.write("/craft/commands", after(1.0), appliedAt(3, 1.5));
    bag.write("/craft/commands", after(2.0), appliedAt(40, -0.1));
    bag.write("/craft/thrust", after(1.5), thrustOf(9.0, 9.0, 9.0));  // commands say it better
  });
  const auto commands = read(one_);
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].tick, 3);
  EXPECT_EQ(commands[0].engines, 1);
  EXPECT_EQ(commands[0].thrusts, Vector3(1.5, 0.0, 0.0));
  EXPECT_EQ(commands[1].tick, 40);
  EXPECT_EQ(BagCommandSource(path_, one_).description(), "/craft/commands");
}

TEST_F(CommandsBag, SortsTheCommandsOfSeveralVehiclesByTick) {
  // A recorder may receive what was published first as the second.
  write([](rosbag::Bag& bag) {
    bag.write("/alpha/commands", after(0.1), appliedAt(10, 1.0));
    bag.write("/alpha/commands", after(0.2), appliedAt(12, 2.0));
    bag.write("/beta/commands", after(0.3), appliedAt(11, 3.0));
    bag.write("/beta/commands", after(0.4), appliedAt(12, 4.0));
  });
  std::vector<std::pair<hovercraft::Tick, double>> order;
  for (const Command& command : read(two_)) order.emplace_back(command.tick, command.thrusts[0]);
  EXPECT_EQ(order, (std::vector<std::pair<hovercraft::Tick, double>>{
                       {10, 1.0}, {11, 3.0}, {12, 2.0}, {12, 4.0}}));
}

TEST_F(CommandsBag, PlaysThrustsAtTheFirstTickAfterTheirTimeInTheBag) {
  write([](rosbag::Bag& bag) {
    bag.write("/craft/thrust", after(0.02), thrustOf(1.0, 2.0, 3.0));
    bag.write("/craft/thrust/left", after(0.021), newtons(4.0));
    bag.write("/craft/thrust/right", after(0.03), newtons(5.0));
    bag.write("/craft/thrust/rear", after(0.045), newtons(6.0));
  });
  const auto commands = read(one_);
  ASSERT_EQ(commands.size(), 4U);
  EXPECT_EQ(commands[0].tick, 2);
  EXPECT_EQ(commands[0].thrusts, Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(commands[1].tick, 3);
  EXPECT_EQ(commands[1].engines, 2);
  EXPECT_EQ(commands[1].thrusts, Vector3(0.0, 4.0, 0.0));
  EXPECT_EQ(commands[2].tick, 3);
  EXPECT_EQ(commands[2].engines, 4);
  EXPECT_EQ(commands[3].tick, 5);
  EXPECT_EQ(commands[3].engines, 1);
}

TEST_F(CommandsBag, ABagWithoutCommandsIsAnError) {
  write([](rosbag::Bag&) {});
  EXPECT_EQ(errorOf(one_),
            "c.bag: there are no commands in it: must have /craft/commands, or /craft/thrust or "
            "one of its engines");
}

TEST_F(CommandsBag, EveryBadMessageIsNamedByTopicTimeAndRule) {
  const auto check = [&](const std::function<void(rosbag::Bag&)>& fill, const std::string& error) {
    write(fill);
    EXPECT_EQ(errorOf(one_), "c.bag: /craft/" + error);
  };
  check([](rosbag::Bag& bag) { bag.write("/craft/thrust", after(1.0), thrustOf(0.0, NAN, 0.0)); },
        "thrust at 1700000001.250000000: a thrust must be finite");
  check([](rosbag::Bag& bag) { bag.write("/craft/thrust/left", after(1.0), newtons(INFINITY)); },
        "thrust/left at 1700000001.250000000: a thrust must be finite");
  check([](rosbag::Bag& bag) { bag.write("/craft/thrust", after(1.0), newtons(1.0)); },
        "thrust at 1700000001.250000000: the type std_msgs/Float64 must be "
        "hovercraft_sim/ThrustCommand");
  check([](rosbag::Bag& bag) { bag.write("/craft/commands", after(1.0), appliedAt(1, NAN)); },
        "commands at 1700000001.250000000: a thrust must be finite");
  check(
      [](rosbag::Bag& bag) {
        bag.write("/craft/commands", after(1.0),
                  appliedAt(std::numeric_limits<std::uint64_t>::max(), 1.0));
      },
      "commands at 1700000001.250000000: tick = 18446744073709551615: must fit 63 bits");
  check(
      [](rosbag::Bag& bag) {
        auto message = appliedAt(1, 1.0);
        message.engines = 8;
        bag.write("/craft/commands", after(1.0), message);
      },
      "commands at 1700000001.250000000: engines = 8: must be 1 to 7");
  check(
      [](rosbag::Bag& bag) {
        bag.write("/craft/commands", after(1.0), appliedAt(9, 1.0));
        auto message = appliedAt(2, 1.0);
        message.episode = 1;
        bag.write("/craft/commands", after(2.0), message);
      },
      "commands at 1700000002.250000000: episode 1: must be episode 0 as before; a bag with a "
      "reset "
      "is for the tool replay");
  check(
      [](rosbag::Bag& bag) {
        bag.write("/craft/commands", after(1.0), appliedAt(9, 1.0));
        bag.write("/craft/commands", after(2.0), appliedAt(8, 1.0));
      },
      "commands at 1700000002.250000000: the command is for tick 8: must not be before tick 9 of "
      "the one that precedes it");
}

TEST_F(CommandsBag, ABagOfARunThatMoreThanCommandsChangedIsForReplay) {
  const auto error_with = [&](std::uint8_t kind, const std::string& name,
                              const std::vector<double>& values, bool has_applied) {
    write([&](rosbag::Bag& bag) {
      if (has_applied) bag.write("/craft/commands", after(1.0), appliedAt(3, 1.5));
      if (!has_applied) bag.write("/craft/thrust", after(1.0), thrustOf(1.0, 2.0, 3.0));
      hovercraft_sim::RunEvent event;
      event.kind = kind;
      event.tick = 120;
      event.pose.orientation.w = 1.0;
      event.name = name;
      event.values = values;
      bag.write("/hovercraft_sim/events", after(2.0), event);
      event.tick = 130;
      bag.write("/hovercraft_sim/events", after(3.0), event);
    });
    return errorOf(one_);
  };
  const auto refusal = [](const std::string& what) {
    return "c.bag: /hovercraft_sim/events at 1700000002.250000000: " + what +
           " at tick 120: commands alone would make another flight; a bag with a reset, a load or "
           "another event is for the tool replay";
  };
  using hovercraft_sim::RunEvent;
  for (const bool has_applied : {true, false}) {
    EXPECT_EQ(error_with(RunEvent::RESET, "", {}, has_applied), refusal("reset"));
    EXPECT_EQ(error_with(RunEvent::LOAD, "", {}, has_applied), refusal("load"));
    EXPECT_EQ(error_with(RunEvent::SET_STATE, "", {}, has_applied), refusal("set_state"));
    EXPECT_EQ(error_with(RunEvent::APPLY_WRENCH, "", {}, has_applied), refusal("apply_wrench"));
    EXPECT_EQ(error_with(5, "wind", {1.0, 0.0, 0.0}, has_applied), refusal("set_wind"));
    EXPECT_EQ(error_with(6, "rear", {0.5, 0.0}, has_applied), refusal("set_actuator"));
  }
}

TEST_F(CommandsBag, AFileThatIsNoBagIsReadAsCsv) {
  const std::string path = folder_.write("x.bag", "time,rear,left,right\n0.5,1,2,3\n");
  const auto source = openCommands(path, one_);
  EXPECT_EQ(source->next()->tick, 50);
}

TEST_F(CommandsBag, ABrokenBagIsAnError) {
  const std::string path = folder_.write("broken.bag", "#ROSBAG V2.0\nand then nothing");
  const std::string message = messageOf([&] { openCommands(path, one_); });
  EXPECT_EQ(message.rfind(path + ": ", 0), 0U) << message;
}

}  // namespace
}  // namespace hovercraft_ros
