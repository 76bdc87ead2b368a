#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/State.h>

#include "../support/pilot.h"
#include "../support/recorded_flight.h"

namespace hovercraft_ros::testing {
namespace {

constexpr double kMass = 2.0;    // kg, of both craft
constexpr double kThrust = 3.0;  // N
constexpr double kStep = 0.001;  // s

// RK4's own error stays below 1e-14 (a step is 8e-4 time constants); what is left are the roundings
// of 2000 steps of numbers below 8: 2000 * 8 * 1.1e-16 = 1.8e-12.
constexpr double kTolerance = 2e-12;  // m, m/s

struct Run {
  double distance;  // m
  double speed;     // m/s
};

/// m v' = F - c v from rest: v = v∞ (1 - e^(-t/τ)), v∞ = F/c, τ = m/c.
Run linearRun(double t) {
  constexpr double drag = 1.6;  // N s/m
  constexpr double top_speed = kThrust / drag;
  constexpr double tau = kMass / drag;
  const double gained = -std::expm1(-t / tau);
  return {top_speed * (t - tau * gained), top_speed * gained};
}

/// m v' = F - c v² from rest: v = v∞ tanh(t/τ), v∞ = √(F/c), τ = m/(c v∞).
Run quadraticRun(double t) {
  constexpr double drag = 0.75;  // N s²/m²
  const double top_speed = std::sqrt(kThrust / drag);
  const double tau = kMass / (drag * top_speed);
  return {top_speed * tau * std::log(std::cosh(t / tau)), top_speed * std::tanh(t / tau)};
}

struct Course {
  const char* vehicle;
  double x, y, yaw;  // where it starts, m and rad
  std::function<Run(double)> run;
};

void expectRun(const Recording& recording, const Course& course) {
  SCOPED_TRACE(course.vehicle);
  const std::string prefix = std::string("/") + course.vehicle;
  const auto commands = recording.messages<hovercraft_sim::AppliedCommand>(prefix + "/commands");
  ASSERT_EQ(commands.size(), 1U);
  EXPECT_EQ(commands[0].engines, hovercraft_sim::AppliedCommand::REAR);
  EXPECT_EQ(commands[0].rear, kThrust);
  int moving = 0;
  for (const auto& state : recording.messages<hovercraft_sim::State>(prefix + "/state")) {
    const bool runs = state.tick > commands[0].tick;
    const Run run = runs ? course.run(kStep * static_cast<double>(state.tick - commands[0].tick))
                         : Run{0.0, 0.0};
    ASSERT_NEAR(state.pose.position.x, course.x + run.distance * std::cos(course.yaw), kTolerance)
        << "tick " << state.tick;
    ASSERT_NEAR(state.pose.position.y, course.y + run.distance * std::sin(course.yaw), kTolerance);
    ASSERT_NEAR(state.velocity.x, run.speed * std::cos(course.yaw), kTolerance);
    ASSERT_NEAR(state.velocity.y, run.speed * std::sin(course.yaw), kTolerance);
    ASSERT_NEAR(state.pose.orientation.z, std::sin(0.5 * course.yaw), kTolerance);
    ASSERT_NEAR(state.pose.orientation.w, std::cos(0.5 * course.yaw), kTolerance);
    moving += runs ? 1 : 0;
  }
  EXPECT_GE(moving, 100);
}

TEST(StraightRun, FollowsTheClosedFormsOfLinearAndOfQuadraticDrag) {
  Pilot linear("linear");
  Pilot quadratic("quadratic");
  RecordedFlight flight(outputTopics({"linear", "quadratic"}));
  linear.command(hovercraft::EngineId::kRear, kThrust);
  quadratic.command(hovercraft::EngineId::kRear, kThrust);
  linear.waitFor("runs", [](const auto& state) { return state.thrust[0] > 0.0; });
  quadratic.waitFor("runs", [](const auto& state) { return state.thrust[0] > 0.0; });
  linear.waitFor(1500);
  const Recording recording = flight.finish();
  expectRun(recording, {"linear", 1.0, -2.0, 0.6, linearRun});
  expectRun(recording, {"quadratic", -3.0, 4.0, -2.1, quadraticRun});
}

}  // namespace
}  // namespace hovercraft_ros::testing
