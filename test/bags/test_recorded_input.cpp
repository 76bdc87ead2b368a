#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/RunEvent.h>
#include <hovercraft_sim/State.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/bags/replay.h"
#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/messages/run_events.h"
#include "hovercraft_sim/messages/vehicle_messages.h"

#include "../support/files.h"
#include "../support/numbers.h"
#include "../support/scenarios.h"

namespace hovercraft_ros {
namespace {

using hovercraft::testing::contentOf;
using hovercraft::testing::kNan;
using hovercraft::testing::messageOf;
using hovercraft::testing::oneCraftYaml;
using hovercraft::testing::TestFolder;
using hovercraft_sim::AppliedCommand;
using hovercraft_sim::RunEvent;
using hovercraft_sim::State;

/// A bag of a run, whole or with something in it that cannot be.
class RecordedInput : public ::testing::Test {
 protected:
  void SetUp() override {
    SimulateRequest request;
    request.scenario = folder_.write("s.yaml", oneCraftYaml());
    request.commands = folder_.write("c.csv", "time,rear,left,right\n0,1,,\n0.05,2,,\n");
    request.duration = "0.2";
    request.output = run_;
    std::ostringstream messages;
    simulate(request, messages);
  }

  /// Copies the run; `change` changes the second message of a topic.
  template <class Message>
  void damage(const std::string& topic, const std::function<void(Message&)>& change) const {
    const rosbag::Bag run(run_);
    rosbag::Bag damaged(damaged_, rosbag::bagmode::Write);
    int count = 0;
    for (const rosbag::MessageInstance& instance : rosbag::View(run)) {
      if (instance.getTopic() != topic || ++count != 2) {
        damaged.write(instance.getTopic(), instance.getTime(), instance);
        continue;
      }
      Message message = *instance.instantiate<Message>();
      change(message);
      damaged.write(topic, instance.getTime(), message);
    }
  }

  void addEvent(const RunEvent& event) const {
    damage<State>("/craft/state", [](State&) {});
    rosbag::Bag damaged(damaged_, rosbag::bagmode::Append);
    damaged.write("/hovercraft_sim/events", ros::Time(0, 10000000), event);
  }

  /// What a replay of the damaged bag says, without the folder.
  std::string errorOf(const std::vector<std::string>& sets = {}) const {
    std::string verdict = "no verdict";
    const std::string message = messageOf([&] { replayBag({damaged_, "", sets}, verdict); });
    return message.rfind(damaged_, 0) == 0 ? "bag" + message.substr(damaged_.size()) : message;
  }

  TestFolder folder_;
  std::string run_ = folder_.file("run.bag");
  std::string damaged_ = folder_.file("damaged.bag");
};

TEST_F(RecordedInput, IsReplayedAsItIs) {
  std::string verdict;
  EXPECT_EQ(replayBag({run_, "", {}}, verdict), 0) << verdict;
}

// A recorder that comes to a run that stands at tick 0 is given its state; time 0 is none to ROS.
TEST_F(RecordedInput, AStateOfTickZeroMayHaveTheStampOfTickOne) {
  damage<State>("/craft/state", [](State&) {});
  const hovercraft::Simulation simulation(hovercraft::testing::scenarioOf(oneCraftYaml()));
  VehicleMessages messages(simulation.scenario(), 0);
  messages.fill(simulation, {ros::Time(0, 10000000)});
  {
    rosbag::Bag damaged(damaged_, rosbag::bagmode::Append);
    damaged.write("/craft/state", ros::Time(0, 1), messages.state());
  }
  std::string verdict;
  EXPECT_EQ(replayBag({damaged_, "", {}}, verdict), 0) << verdict;
  EXPECT_NE(verdict.find("21 states compared"), std::string::npos) << verdict;
}

/// The run as an episode 1, which a reset began; before it, a state of the episode before.
TEST_F(RecordedInput, WhereTheRunStoodBeforeTheResetIsNoGap) {
  const auto write = [this](bool moved) {
    const rosbag::Bag run(run_);
    rosbag::Bag whole(damaged_, rosbag::bagmode::Write);
    State before;
    before.tick = 57;
    before.commands = 4;
    before.header.stamp = ros::Time(0, 570000000);
    whole.write("/craft/state", ros::Time(0, 1), before);
    before.tick = 58;
    before.header.stamp = ros::Time(0, 580000000);
    if (moved) whole.write("/craft/state", ros::Time(0, 2), before);
    RunEvent reset = resetEvent(1);
    reset.episode = 1;
    reset.number = 1;
    whole.write("/hovercraft_sim/events", ros::Time(0, 3), reset);
    for (const rosbag::MessageInstance& instance : rosbag::View(run)) {
      if (const auto state = instance.instantiate<State>()) {
        state->episode = 1;
        state->events = 1;
        whole.write(instance.getTopic(), instance.getTime(), *state);
      } else if (const auto command = instance.instantiate<AppliedCommand>()) {
        command->episode = 1;
        whole.write(instance.getTopic(), instance.getTime(), *command);
      } else {
        whole.write(instance.getTopic(), instance.getTime(), instance);
      }
    }
  };
  std::string verdict;
  write(false);
  EXPECT_EQ(replayBag({damaged_, "", {}}, verdict), 0) << verdict;
  write(true);  // a flight of which commands are missing
  EXPECT_EQ(replayBag({damaged_, "", {}}, verdict), 2) << verdict;
}

TEST_F(RecordedInput, ACommandIsCheckedByTopicTimeAndRule) {
  const struct {
    std::function<void(AppliedCommand&)> change;
    std::string rule;
  } cases[] = {
      {[](AppliedCommand& command) { command.rear = kNan; }, "a thrust must be finite"},
      {[](AppliedCommand& command) { command.tick = 1ULL << 63; },
       "tick = 9223372036854775808: must fit 63 bits"},
      {[](AppliedCommand& command) { command.engines = 8; }, "engines = 8: must be 1 to 7"},
      {[](AppliedCommand& command) { command.values = {0.5}; },
       "ids and values: must be as many (0 and 1 are there)"},
      {[](AppliedCommand& command) {
         command.ids = {3};
         command.values = {0.5};
       },
       "ids: must be below 3: the craft has 0 actuators besides its engines"},
  };
  for (const auto& [change, rule] : cases) {
    damage<AppliedCommand>("/craft/commands", change);
    EXPECT_EQ(errorOf(), "bag: /craft/commands at 0.050000000: " + rule);
  }
}

TEST_F(RecordedInput, AStateIsNotReplayedTowardsATickThatWasNeverReached) {
  const struct {
    std::function<void(State&)> change;
    std::string rule;
  } cases[] = {
      {[](State& state) { state.tick = 1ULL << 63; },
       "tick = 9223372036854775808: must fit 63 bits"},
      {[](State& state) { state.tick = 1ULL << 62; },
       "tick = 4611686018427387904: must not be more steps than its stamp allows"},
      {[](State& state) { state.tick = 1000000000; },
       "tick = 1000000000: must not be more steps than its stamp allows"},
      {[](State& state) { state.header.stamp += ros::Duration(0, 1); },
       "tick = 2: from tick to tick of an episode, stamps must go on by the step size"},
  };
  for (const auto& [change, rule] : cases) {
    damage<State>("/craft/state", change);
    EXPECT_EQ(errorOf(), "bag: /craft/state at 0.020000000: " + rule);
  }
}

TEST_F(RecordedInput, AnEventIsCheckedByTopicTimeAndRule) {
  RunEvent motion;
  motion.kind = RunEvent::SET_STATE;
  motion.vehicle = "craft";
  motion.number = 1;
  motion.tick = 1;
  motion.pose.orientation.w = 1.0;
  const auto changed = [&motion](const std::function<void(RunEvent&)>& change) {
    RunEvent event = motion;
    change(event);
    return event;
  };
  const struct {
    RunEvent event;
    std::string rule;
  } cases[] = {
      {changed([](RunEvent& event) { event.kind = 9; }), "kind = 9: is no event that is known"},
      {changed([](RunEvent& event) { event.tick = 1ULL << 63; }),
       "tick = 9223372036854775808: must fit 63 bits"},
      {changed([](RunEvent& event) { event.pose.position.y = kNan; }),
       "pose.position: must be finite"},
      {changed([](RunEvent& event) { event.twist.linear.y = kNan; }),
       "twist.linear: must be finite"},
      {changed([](RunEvent& event) { event.twist.angular.z = kNan; }),
       "twist.angular: must be finite"},
      {changed([](RunEvent& event) { event.pose.orientation.w = 0.5; }),
       "pose.orientation: must have length 1 (it has 0.5)"},
      {changed([](RunEvent& event) {
         event.kind = RunEvent::APPLY_WRENCH;
         event.wrench.force.x = kNan;
       }),
       "wrench.force: must be finite"},
      {changed([](RunEvent& event) {
         event.kind = RunEvent::APPLY_WRENCH;
         event.wrench.torque.z = kNan;
       }),
       "wrench.torque: must be finite"},
      {changed([](RunEvent& event) {
         event.kind = RunEvent::APPLY_WRENCH;
         event.end_tick = 1ULL << 63;
       }),
       "end_tick = 9223372036854775808: must fit 63 bits"},
  };
  for (const auto& [event, rule] : cases) {
    addEvent(event);
    EXPECT_EQ(errorOf(), "bag: /hovercraft_sim/events at 0.010000000: " + rule);
  }
  addEvent(changed([](RunEvent& event) { event.vehicle = "nobody"; }));
  EXPECT_EQ(errorOf(), "bag: event 1 of episode 0: vehicle = nobody: must be one of: craft");
}

TEST_F(RecordedInput, ATextThatIsNotYamlIsNamed) {
  damage<State>("/craft/state", [](State&) {});
  const std::string error = errorOf({"vehicles.craft.mass=["});
  EXPECT_EQ(error.rfind("--set vehicles.craft.mass=[: not YAML: ", 0), 0U) << error;

  rosbag::Bag bag(damaged_, rosbag::bagmode::Write);
  std_msgs::String text;
  text.data = "vehicles: [";
  bag.write("/hovercraft_sim/scenario", ros::Time(1, 0), text);
  bag.close();
  const std::string error_of_bag = errorOf();
  EXPECT_EQ(error_of_bag.rfind("bag: /hovercraft_sim/scenario: not YAML: ", 0), 0U) << error_of_bag;
}

TEST_F(RecordedInput, ADamagedChunkIsNamedByWhereItBegins) {
  std::string bytes = contentOf(run_);
  const std::size_t lz4_begin = bytes.find("\x04\x22\x4d\x18");  // what LZ4 frames begin with
  ASSERT_NE(lz4_begin, std::string::npos);
  for (std::size_t i = 100; i < 200; ++i) bytes[lz4_begin + i] = '\x7f';
  folder_.write("damaged.bag", bytes);
  EXPECT_EQ(errorOf(), "bag: damaged at byte 4117: a chunk is not what its header says");
  // Whoever flies the commands of it finds the same.
  const hovercraft::Scenario scenario = hovercraft::testing::scenarioOf(oneCraftYaml());
  const std::string of_commands = messageOf([&] { openCommands(damaged_, scenario); });
  EXPECT_EQ(of_commands, damaged_ + ": damaged at byte 4117: a chunk is not what its header says");
}

}  // namespace
}  // namespace hovercraft_ros
