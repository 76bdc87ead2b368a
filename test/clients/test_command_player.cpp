#include <gtest/gtest.h>

#include "hovercraft_sim/clients/command_player.h"

#include "../support/numbers.h"

namespace hovercraft_ros {
namespace {

using hovercraft::testing::kStepNs;

/// @param time_ms ROS time since some beginning.
hovercraft_sim::State stateAt(std::uint32_t episode, std::uint64_t tick, std::uint64_t time_ms) {
  hovercraft_sim::State state;
  state.episode = episode;
  state.tick = tick;
  state.header.stamp.fromNSec((1700000000000 + time_ms) * 1000000);
  return state;
}

TEST(PlayedTime, CountsTheTicksFromTheFirstState) {
  PlayedTime time(kStepNs);
  EXPECT_EQ(time.hear(stateAt(0, 500, 500)), 0);
  EXPECT_TRUE(time.isNewRun());
  EXPECT_EQ(time.hear(stateAt(0, 510, 510)), 10);
  EXPECT_FALSE(time.isNewRun());
}

TEST(PlayedTime, GoesOnThroughResetAndLoad) {
  PlayedTime time(kStepNs);
  time.hear(stateAt(0, 500, 500));
  time.hear(stateAt(0, 700, 700));
  // A reset 3 ms after that state; the first that is heard after it is tick 10.
  EXPECT_EQ(time.hear(stateAt(1, 10, 713)), 213);
  EXPECT_TRUE(time.isNewRun());
  EXPECT_EQ(time.hear(stateAt(1, 20, 723)), 223);
  EXPECT_FALSE(time.isNewRun());
  // A load of a snapshot of tick 5000.
  EXPECT_EQ(time.hear(stateAt(2, 5010, 733)), 233);
  EXPECT_TRUE(time.isNewRun());
  EXPECT_EQ(time.hear(stateAt(2, 5030, 753)), 253);
}

TEST(PlayedTime, GoesOnWhereASimulationWasStartedAgain) {
  PlayedTime time(kStepNs);
  time.hear(stateAt(0, 500, 500));
  time.hear(stateAt(0, 700, 700));
  EXPECT_EQ(time.hear(stateAt(0, 10, 9000)), 200);  // its epoch is a later time of the wall clock
  EXPECT_TRUE(time.isNewRun());
  EXPECT_EQ(time.hear(stateAt(0, 30, 9020)), 220);
}

TEST(PlayedTime, NeverGoesBack) {
  PlayedTime time(kStepNs);
  time.hear(stateAt(3, 500, 500));
  time.hear(stateAt(3, 700, 700));
  EXPECT_EQ(time.hear(stateAt(0, 900, 10)), 200);
  EXPECT_EQ(time.hear(stateAt(4, 10, 5)), 200);
}

}  // namespace
}  // namespace hovercraft_ros
