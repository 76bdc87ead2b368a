#include <set>
#include <string>
#include <tf2_msgs/TFMessage.h>

#include <gtest/gtest.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/State.h>

#include "../support/core_run.h"
#include "../support/pilot.h"
#include "../support/recorded_flight.h"

namespace hovercraft_ros::testing {
namespace {

std::set<std::string> childFrames(const tf2_msgs::TFMessage& message) {
  std::set<std::string> names;
  for (const auto& transform : message.transforms) names.insert(transform.child_frame_id);
  return names;
}

TEST(TwoVehicles, EachFliesByItsOwnCommandsOnly) {
  Pilot alpha("alpha");
  Pilot beta("beta");
  RecordedFlight flight(outputTopics({"alpha", "beta"}));
  alpha.command({3.0, 0.0, 0.5});
  alpha.waitFor("is driven", [](const auto& state) { return state.thrust[0] > 0.0; });
  alpha.waitFor(300);
  const std::uint64_t alone_until = alpha.state().tick;
  beta.command(hovercraft::EngineId::kLeft, 1.0);
  beta.waitFor("is driven", [](const auto& state) { return state.thrust[1] > 0.0; });
  beta.waitFor(200);
  const Recording recording = flight.finish();

  const auto of_alpha = recording.messages<hovercraft_sim::AppliedCommand>("/alpha/commands");
  ASSERT_EQ(of_alpha.size(), 1U);
  EXPECT_EQ(of_alpha[0].engines, 7);
  EXPECT_EQ(of_alpha[0].rear, 3.0);
  const auto of_beta = recording.messages<hovercraft_sim::AppliedCommand>("/beta/commands");
  ASSERT_EQ(of_beta.size(), 1U);
  EXPECT_EQ(of_beta[0].engines, hovercraft_sim::AppliedCommand::LEFT);
  EXPECT_EQ(of_beta[0].left, 1.0);
  EXPECT_GE(of_beta[0].tick, alone_until);

  const auto states = recording.messages<hovercraft_sim::State>("/beta/state");
  ASSERT_FALSE(states.empty());
  const std::string at_rest = bitsOfMotion(states.front());
  for (const auto& state : states) {
    EXPECT_EQ(bitsOfMotion(state) == at_rest, state.tick <= of_beta[0].tick) << state.tick;
  }
  EXPECT_EQ(states.front().pose.position.y, 3.0);
  expectEqualsCoreRun(recording);
}

TEST(TwoVehicles, OneTfMessageCarriesBothAndEachHasItsEngineFrames) {
  Pilot alpha("alpha");
  RecordedFlight flight({"/tf", "/tf_static"});
  alpha.waitFor(100);
  const Recording recording = flight.finish();
  const auto messages = recording.messages<tf2_msgs::TFMessage>("/tf");
  ASSERT_FALSE(messages.empty());
  for (const auto& message : messages) {
    ASSERT_EQ(childFrames(message), (std::set<std::string>{"alpha/base_link", "beta/base_link"}));
  }
  const auto statics = recording.messages<tf2_msgs::TFMessage>("/tf_static");
  ASSERT_EQ(statics.size(), 1U);
  EXPECT_EQ(childFrames(statics[0]),
            (std::set<std::string>{"alpha/engine_rear", "alpha/engine_left", "alpha/engine_right",
                                   "beta/engine_rear", "beta/engine_left", "beta/engine_right"}));
}

}  // namespace
}  // namespace hovercraft_ros::testing
