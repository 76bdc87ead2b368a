#include <cmath>

#include <gtest/gtest.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/State.h>

#include "../support/pilot.h"
#include "../support/recorded_flight.h"

namespace hovercraft_ros::testing {
namespace {

// config/mvwt.yaml; both fans push 4.5 N with a lever of 0.123 m.
constexpr double kTorque = 2.0 * 4.5 * 0.123;  // N m
constexpr double kDrag = 0.41;                 // N m s
constexpr double kInertia = 0.047;             // kg m²
constexpr double kTopRate = kTorque / kDrag;   // 2.7 rad/s
constexpr double kTau = kInertia / kDrag;      // 0.115 s
constexpr double kStep = 0.001;                // s

// RK4 multiplies the distance from the top rate by 1 - z + z²/2 - z³/6 + z⁴/24 per step, z = h/τ:
// off from e^(-z) by z⁵/120. After time t that adds up to top rate · z⁴/120 · (t/τ) e^(-t/τ), at
// most 2.7 · 5.8e-9/120 · 0.37 = 4.8e-11 rad/s; the angle is off by less than τ times the top
// rate's share, 2.7 · τ · 4.8e-11.
constexpr double kTolerance = 6e-11;  // rad/s, rad

TEST(PureTurn, FollowsTheClosedFormOfTheYawRateAndStaysWhereItIs) {
  Pilot pilot("mvwt");
  RecordedFlight flight(outputTopics({"mvwt"}));
  pilot.command({0.0, -4.5, 4.5});
  pilot.waitFor("turns", [](const auto& state) { return state.thrust[2] > 0.0; });
  pilot.waitFor(1000);
  const Recording recording = flight.finish();

  const auto commands = recording.messages<hovercraft_sim::AppliedCommand>("/mvwt/commands");
  ASSERT_EQ(commands.size(), 1U);
  int turning = 0;
  for (const auto& state : recording.messages<hovercraft_sim::State>("/mvwt/state")) {
    const double t = state.tick > commands[0].tick
                         ? kStep * static_cast<double>(state.tick - commands[0].tick)
                         : 0.0;
    const double gained = -std::expm1(-t / kTau);
    const double yaw = kTopRate * (t - kTau * gained);
    ASSERT_NEAR(state.angular_velocity.z, kTopRate * gained, kTolerance) << "tick " << state.tick;
    // The quaternion up to its sign, whatever the number of whole turns.
    const double s = state.pose.orientation.w;
    const double z = state.pose.orientation.z;
    ASSERT_NEAR(s * s - z * z, std::cos(yaw), kTolerance) << "tick " << state.tick;
    ASSERT_NEAR(2.0 * s * z, std::sin(yaw), kTolerance) << "tick " << state.tick;
    // The forces of a couple cancel to the last bit.
    ASSERT_EQ(state.pose.position.x, 0.0);
    ASSERT_EQ(state.pose.position.y, 0.0);
    ASSERT_EQ(state.velocity.x, 0.0);
    ASSERT_EQ(state.velocity.y, 0.0);
    turning += t > 0.0 ? 1 : 0;
  }
  EXPECT_GE(turning, 99);
}

}  // namespace
}  // namespace hovercraft_ros::testing
