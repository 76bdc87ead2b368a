#include <csignal>

#include <gtest/gtest.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/EngineStatus.h>
#include <hovercraft_sim/State.h>

#include "../support/child_process.h"
#include "../support/core_run.h"
#include "../support/pilot.h"
#include "../support/recorded_flight.h"

namespace hovercraft_ros::testing {
namespace {

constexpr std::uint64_t kTimeoutTicks = 500;  // 0.5 s

TEST(TimeOut, TheThrustOfAPublisherThatDiedEndsOneStepAfterTheTimeOut) {
  Pilot observer("hovercraft");
  RecordedFlight flight(outputTopics({"hovercraft"}));
  // The first command of the README, as a user types it.
  ChildProcess publisher(
      {"rostopic", "pub", "-r", "10", "/hovercraft/thrust/rear", "std_msgs/Float64", "3.0"});
  observer.waitFor("is driven", [](const auto& state) { return state.thrust[0] > 0.0; });
  publisher.signal(SIGKILL);
  observer.waitFor("is driven no more", [](const auto& state) { return state.thrust[0] == 0.0; });
  const Recording recording = flight.finish();

  const auto commands = recording.messages<hovercraft_sim::AppliedCommand>("/hovercraft/commands");
  ASSERT_FALSE(commands.empty());
  const std::uint64_t last_command = commands.back().tick;
  int on_time_out = 0;
  int after = 0;
  for (const auto& state : recording.messages<hovercraft_sim::State>("/hovercraft/state")) {
    // The thrust of a state is that of the step which ended there. A step that begins when the
    // command is as old as the time-out is the first without thrust.
    if (state.tick <= last_command) continue;
    const bool timed_out = state.tick > last_command + kTimeoutTicks;
    ASSERT_EQ(state.thrust[0], timed_out ? 0.0 : 3.0) << state.tick - last_command;
    ++(timed_out ? after : on_time_out);
  }
  EXPECT_GT(on_time_out, 0);
  EXPECT_GT(after, 0);
  const auto statuses = recording.messages<hovercraft_sim::EngineStatus>("/hovercraft/engines");
  ASSERT_FALSE(statuses.empty());
  EXPECT_TRUE(statuses.back().rear.timed_out);
  EXPECT_EQ(statuses.back().rear.commanded, 3.0);
  EXPECT_FALSE(statuses.back().left.timed_out) << "an engine without a command has no time-out";
  expectEqualsCoreRun(recording);
}

}  // namespace
}  // namespace hovercraft_ros::testing
