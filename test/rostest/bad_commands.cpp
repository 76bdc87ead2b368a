#include <algorithm>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/EngineStatus.h>
#include <hovercraft_sim/State.h>
#include <ros/node_handle.h>

#include "../support/core_run.h"
#include "../support/pilot.h"
#include "../support/recorded_flight.h"
#include "../support/wait_until.h"

namespace hovercraft_ros::testing {
namespace {

using hovercraft::EngineId;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The number behind `key` in the report on the craft's commands, -1 if the message has none.
int reported(const diagnostic_msgs::DiagnosticArray& message, const std::string& key) {
  for (const auto& status : message.status) {
    if (status.name != "hovercraft_sim: hovercraft: commands") continue;
    for (const auto& entry : status.values) {
      if (entry.key == key) return std::stoi(entry.value);
    }
  }
  return -1;
}

std::vector<int> allReported(const Recording& recording, const std::string& key) {
  std::vector<int> numbers;
  for (const auto& message : recording.messages<diagnostic_msgs::DiagnosticArray>("/diagnostics")) {
    const int number = reported(message, key);
    if (number >= 0) numbers.push_back(number);
  }
  return numbers;
}

/// Watches the diagnostics of the live simulation.
class Diagnostics {
 public:
  Diagnostics() {
    const boost::function<void(const diagnostic_msgs::DiagnosticArray&)> keep =
        [this](const diagnostic_msgs::DiagnosticArray& message) { last_ = message; };
    subscriber_ =
        ros::NodeHandle().subscribe<diagnostic_msgs::DiagnosticArray>("/diagnostics", 10, keep);
  }
  void waitFor(const std::string& key, int number) {
    waitUntil("diagnostics report " + key + " " + std::to_string(number),
              [&] { return reported(last_, key) == number; });
  }

 private:
  diagnostic_msgs::DiagnosticArray last_;
  ros::Subscriber subscriber_;
};

TEST(BadCommands, AThrustThatIsNotFiniteIsDroppedWholeAndReported) {
  Pilot pilot("hovercraft");
  RecordedFlight flight(outputTopics({"hovercraft"}));
  Diagnostics diagnostics;  // connected later than the recorder: what it hears is in the bag
  diagnostics.waitFor("Dropped commands", 0);
  pilot.command({1.5, 0.0, 0.25});
  pilot.waitFor("is driven", [](const auto& state) { return state.thrust[2] > 0.0; });
  pilot.command({2.0, kNan, 0.0});
  pilot.command({2.0, 0.0, -kInfinity});
  pilot.command(EngineId::kRear, kNan);
  pilot.command(EngineId::kLeft, kInfinity);
  diagnostics.waitFor("Dropped commands", 4);
  pilot.command(EngineId::kLeft, 0.5);
  pilot.waitFor("goes on", [](const auto& state) { return state.thrust[1] > 0.0; });
  pilot.waitFor(100);
  const Recording recording = flight.finish();

  const auto commands = recording.messages<hovercraft_sim::AppliedCommand>("/hovercraft/commands");
  ASSERT_EQ(commands.size(), 2U);
  EXPECT_EQ(commands[0].engines, 7);
  EXPECT_EQ(commands[0].rear, 1.5);
  EXPECT_EQ(commands[1].engines, hovercraft_sim::AppliedCommand::LEFT);
  EXPECT_EQ(commands[1].left, 0.5);
  // The core knows nothing of the bad messages: equal bits say that they changed nothing.
  expectEqualsCoreRun(recording);

  const std::vector<int> drops = allReported(recording, "Dropped commands");
  ASSERT_FALSE(drops.empty());
  EXPECT_TRUE(std::is_sorted(drops.begin(), drops.end()));
  EXPECT_EQ(drops.front(), 0);
  EXPECT_EQ(drops.back(), 4);
}

TEST(BadCommands, AThrustBeyondTheLimitsIsSaturatedAndReported) {
  Pilot pilot("hovercraft");
  RecordedFlight flight(outputTopics({"hovercraft"}));
  Diagnostics diagnostics;  // connected later than the recorder: what it hears is in the bag
  diagnostics.waitFor("Saturated commands", 0);
  pilot.command({100.0, -1.0, 0.5});
  pilot.waitFor("is driven", [](const auto& state) { return state.thrust[0] > 1.0; });
  diagnostics.waitFor("Saturated commands", 1);
  const Recording recording = flight.finish();

  const auto statuses = recording.messages<hovercraft_sim::EngineStatus>("/hovercraft/engines");
  ASSERT_FALSE(statuses.empty());
  const hovercraft_sim::EngineStatus& last = statuses.back();
  EXPECT_EQ(last.rear.commanded, 100.0);
  EXPECT_TRUE(last.rear.saturated);
  EXPECT_LE(last.rear.applied, 4.5);
  EXPECT_EQ(last.left.commanded, -1.0);
  EXPECT_TRUE(last.left.saturated);
  EXPECT_GE(last.left.applied, 0.0);
  EXPECT_EQ(last.right.commanded, 0.5);
  EXPECT_FALSE(last.right.saturated);
  for (const auto& state : recording.messages<hovercraft_sim::State>("/hovercraft/state")) {
    ASSERT_LE(state.thrust[0], 4.5) << "tick " << state.tick;
    ASSERT_GE(state.thrust[1], 0.0) << "tick " << state.tick;
  }
  const std::vector<int> saturations = allReported(recording, "Saturated commands");
  ASSERT_FALSE(saturations.empty());
  EXPECT_EQ(saturations.back(), 1);
}

}  // namespace
}  // namespace hovercraft_ros::testing
