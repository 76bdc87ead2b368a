#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <geometry_msgs/TwistStamped.h>
#include <hovercraft_sim/State.h>

#include "../support/core_run.h"
#include "../support/pilot.h"
#include "../support/recorded_flight.h"

namespace hovercraft_ros::testing {
namespace {

double speedOf(const hovercraft_sim::State& state) {
  return std::hypot(state.velocity.x, state.velocity.y);
}

/// Angle from the heading to the velocity, rad in [-π, π]: negative while the craft slides to the
/// right.
double slipOf(const hovercraft_sim::State& state) {
  const double s = state.pose.orientation.w;
  const double z = state.pose.orientation.z;
  const double forwards = (s * s - z * z) * state.velocity.x + 2.0 * s * z * state.velocity.y;
  const double leftwards = (s * s - z * z) * state.velocity.y - 2.0 * s * z * state.velocity.x;
  return std::atan2(leftwards, forwards);
}

/// A car would go where it points; a hovercraft that was turned to the left goes on as it went.
bool slidesSideways(const hovercraft_sim::State& state) {
  return slipOf(state) < -0.5 && speedOf(state) > 0.5;
}

TEST(Drift, ATurnedCraftSlidesSidewaysExactlyAsTheCoreSays) {
  Pilot pilot("hovercraft");
  RecordedFlight flight(outputTopics({"hovercraft"}));
  pilot.flyUntil("is fast", {4.5, 0.0, 0.0},
                 [](const auto& state) { return speedOf(state) > 0.8; });
  pilot.flyUntil("slides", {4.5, 0.0, 1.5}, slidesSideways);
  pilot.flyFor(300, {0.0, 0.6, 0.0});
  const Recording recording = flight.finish();

  const auto states = recording.messages<hovercraft_sim::State>("/hovercraft/state");
  EXPECT_TRUE(std::any_of(states.begin(), states.end(), slidesSideways));
  // The twist in base_link says so too: it has a sideways part.
  const auto twists = recording.messages<geometry_msgs::TwistStamped>("/hovercraft/twist");
  EXPECT_TRUE(std::any_of(twists.begin(), twists.end(),
                          [](const auto& twist) { return twist.twist.linear.y < -0.2; }));
  expectEqualsCoreRun(recording);
}

}  // namespace
}  // namespace hovercraft_ros::testing
