#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "hovercraft_sim/hovercraft/command_map.h"
#include "hovercraft_sim/hovercraft/engines.h"

namespace hovercraft {
namespace {

constexpr double kMin = -1.5;
constexpr double kMax = 4.0;

CommandMap normalizedMap() {
  CommandMap map;
  map.unit = CommandUnit::kNormalized;
  return map;
}

/// A dead zone about 0, and less astern than ahead.
CommandMap tableMap() {
  CommandMap map;
  map.table = {{-100.0, -1.2}, {-10.0, 0.0}, {10.0, 0.0}, {60.0, 2.5}, {100.0, 3.0}};
  return map;
}

// (28): piecewise linear, held at the ends.
TEST(ThrustTable, IsLinearBetweenItsKnotsAndHeldBeyondThem) {
  const CommandMap map = tableMap();
  for (const ThrustKnot& knot : map.table) {
    EXPECT_EQ(map.levelOf(knot.command, kMin, kMax), knot.thrust) << knot.command;
  }
  EXPECT_DOUBLE_EQ(map.levelOf(35.0, kMin, kMax), 1.25);
  EXPECT_DOUBLE_EQ(map.levelOf(-55.0, kMin, kMax), -0.6);
  EXPECT_DOUBLE_EQ(map.levelOf(90.0, kMin, kMax), 2.875);
  EXPECT_EQ(map.levelOf(0.0, kMin, kMax), 0.0);
  EXPECT_EQ(map.levelOf(1e300, kMin, kMax), 3.0);
  EXPECT_EQ(map.levelOf(-1e300, kMin, kMax), -1.2);
  EXPECT_FALSE(map.exceeds(100.0, kMin, kMax));
  EXPECT_TRUE(map.exceeds(std::nextafter(100.0, 200.0), kMin, kMax));
  EXPECT_TRUE(map.exceeds(std::nextafter(-100.0, -200.0), kMin, kMax));
  EXPECT_TRUE(map.exceeds(100.0, kMin, 2.9));  // beyond the limit that holds after the table
  EXPECT_FALSE(map.exceeds(100.0, kMin, 3.0));
  EXPECT_TRUE(map.exceeds(-100.0, -1.1, kMax));
  EXPECT_FALSE(map.exceeds(-100.0, -1.2, kMax));
}

TEST(ThrustTable, NeverLeavesTheTwoKnotsItLiesBetween) {
  CommandMap map;
  map.table = {{0.1, 0.1}, {0.3, 0.7}};
  const double last = std::nextafter(0.3, 0.0);
  EXPECT_LE(map.levelOf(last, 0.0, 1.0), 0.7);
  EXPECT_GE(map.levelOf(std::nextafter(0.1, 1.0), 0.0, 1.0), 0.1);
  map.table = {{-1e30, -1e30}, {1e30, 1e30}};
  EXPECT_TRUE(std::isfinite(map.levelOf(5e29, -1e30, 1e30)));
}

TEST(NormalizedCommand, IsAShareOfEitherLimitAndSaturatesBeyondOne) {
  const CommandMap map = normalizedMap();
  EXPECT_EQ(map.levelOf(1.0, kMin, kMax), kMax);
  EXPECT_EQ(map.levelOf(0.3, kMin, kMax), 0.3 * kMax);
  EXPECT_EQ(map.levelOf(-0.3, kMin, kMax), 0.3 * kMin);
  EXPECT_EQ(map.levelOf(-1.0, kMin, kMax), kMin);
  EXPECT_EQ(map.levelOf(7.0, kMin, kMax), kMax);
  EXPECT_EQ(map.levelOf(-7.0, kMin, kMax), kMin);
  EXPECT_EQ(map.levelOf(0.0, kMin, kMax), 0.0);
  EXPECT_FALSE(map.exceeds(1.0, kMin, kMax));
  EXPECT_FALSE(map.exceeds(-1.0, kMin, kMax));
  EXPECT_TRUE(map.exceeds(std::nextafter(1.0, 2.0), kMin, kMax));
  EXPECT_TRUE(map.exceeds(-1.1, kMin, kMax));
}

TEST(CommandMap, TellsWhichCommandMakesALevel) {
  CommandMap both = tableMap();
  for (ThrustKnot& knot : both.table) knot.command *= 0.01;
  both.unit = CommandUnit::kNormalized;
  for (const CommandMap& map : {normalizedMap(), tableMap(), both}) {
    for (const double level : {-1.2, -0.7, -1e-3, 0.0, 1e-3, 0.9, 2.5, 3.0}) {
      EXPECT_NEAR(map.levelOf(map.commandOf(level, kMin, kMax), kMin, kMax), level, 1e-12);
    }
  }
  EXPECT_EQ(tableMap().commandOf(0.0, kMin, kMax), 0.0);     // in the dead zone
  EXPECT_EQ(tableMap().commandOf(50.0, kMin, kMax), 100.0);  // the most there is
  EXPECT_EQ(CommandMap().commandOf(50.0, kMin, kMax), 50.0);
  CommandMap forwards = normalizedMap();
  EXPECT_EQ(forwards.commandOf(-1.0, 0.0, kMax), 0.0);
}

TEST(EngineDynamics, FollowsWhatACommandAsksForAndReportsItAsReceived) {
  EngineParameters engine;
  engine.min_thrust = kMin;
  engine.max_thrust = kMax;
  engine.timeout_ns = 500000000;
  engine.command = normalizedMap();
  const EngineDynamics dynamics({engine, engine, engine}, 1000000);
  EngineStates states;
  states[0] = {0.5, 0.0, 0};
  states[1] = {-2.0, 0.0, 0};
  const ThrustCourse course = dynamics.course(states, 10);
  EXPECT_EQ(course.start[0], 2.0);
  EXPECT_EQ(course.start[1], kMin);
  EXPECT_FALSE(dynamics.isSaturated(0, states[0]));
  EXPECT_TRUE(dynamics.isSaturated(1, states[1]));
  EXPECT_EQ(dynamics.course(states, 500).start[0], 0.0);  // timed out
}

TEST(EngineDynamics, TakesWhatIsThereBeforeTheFirstCommandForALevel) {
  EngineParameters engine;
  engine.max_thrust = kMax;
  engine.command = normalizedMap();
  const EngineDynamics dynamics({engine, engine, engine}, 1000000);
  EngineStates states;
  states[0] = {0.5, 0.5, EngineState::kNever};
  EXPECT_EQ(dynamics.course(states, 10).start[0], 0.5);
  EXPECT_FALSE(dynamics.isSaturated(0, states[0]));
}

}  // namespace
}  // namespace hovercraft
