#include <cstdint>
#include <stdexcept>

#include <gtest/gtest.h>

#include "hovercraft_sim/pacing/pacer.h"

#include "../support/numbers.h"

namespace hovercraft {
namespace {

using testing::kNow;
using testing::kStepNs;

TEST(Pacer, CountsDeadlinesFromOneOriginSoThatNoErrorAddsUp) {
  Pacer pacer(kStepNs, 1.0);
  pacer.restart(40, kNow);
  EXPECT_EQ(pacer.deadline(40), kNow);
  EXPECT_EQ(pacer.deadline(41), kNow + kStepNs);
  constexpr Tick year = 31557600000;  // steps of 1 ms in a year
  EXPECT_EQ(pacer.deadline(40 + year), kNow + year * kStepNs);
}

TEST(Pacer, AFactorThatDoesNotDivideTheStepRoundsEachDeadlineOnly) {
  Pacer pacer(kStepNs, 3.0);
  pacer.restart(0, kNow);
  for (const Tick tick : {1, 2, 3, 1000, 1000001}) {
    // Three times the offset is off from tick steps by three halves of a nanosecond at most.
    const std::int64_t tripled = 3 * (pacer.deadline(tick) - kNow);
    EXPECT_LE(tripled, tick * kStepNs + 1) << tick;
    EXPECT_GE(tripled, tick * kStepNs - 1) << tick;
  }
}

TEST(Pacer, AFactorScalesWallTime) {
  Pacer fast(kStepNs, 4.0);
  fast.restart(0, kNow);
  EXPECT_EQ(fast.deadline(1000), kNow + 250 * kStepNs);
  Pacer slow(kStepNs, 0.5);
  slow.restart(0, kNow);
  EXPECT_EQ(slow.deadline(1000), kNow + 2000 * kStepNs);
}

TEST(Pacer, CatchesUpABacklogWithinTheBound) {
  Pacer pacer(kStepNs, 1.0);
  pacer.restart(0, kNow);
  EXPECT_EQ(pacer.giveUpBacklog(1, kNow), 0) << "the next step is not even due";
  EXPECT_EQ(pacer.giveUpBacklog(1, pacer.deadline(1) + Pacer::kMaxBacklogNs), 0);
  EXPECT_EQ(pacer.deadline(1), kNow + kStepNs) << "the origin has not moved";
}

TEST(Pacer, GivesUpWhatLiesBeyondTheBoundAndNoMore) {
  Pacer pacer(kStepNs, 1.0);
  pacer.restart(0, kNow);
  const std::int64_t late = pacer.deadline(7) + Pacer::kMaxBacklogNs + 12345;
  EXPECT_EQ(pacer.giveUpBacklog(7, late), 12345);
  EXPECT_EQ(late - pacer.deadline(7), Pacer::kMaxBacklogNs);
  EXPECT_EQ(pacer.giveUpBacklog(7, late), 0) << "it is given up once";
  EXPECT_EQ(pacer.deadline(8) - pacer.deadline(7), kStepNs) << "the pace is as before";
}

TEST(Pacer, RestartForgetsTheBacklog) {
  Pacer pacer(kStepNs, 1.0);
  pacer.restart(0, kNow);
  pacer.restart(500, kNow + 10 * Pacer::kMaxBacklogNs);
  EXPECT_EQ(pacer.giveUpBacklog(501, kNow + 10 * Pacer::kMaxBacklogNs), 0);
  EXPECT_EQ(pacer.deadline(501), kNow + 10 * Pacer::kMaxBacklogNs + kStepNs);
}

// A controller that took longer than can be caught up; the node is a little late itself then.
TEST(Pacer, AWaitForSomeoneElseIsNotGivenUpByTheSimulation) {
  Pacer pacer(kStepNs, 1.0);
  pacer.restart(0, kNow);
  const std::int64_t answered = kNow + 30 * Pacer::kMaxBacklogNs;
  pacer.forgiveWait(0, answered);
  EXPECT_EQ(pacer.giveUpBacklog(1, answered + Pacer::kMaxBacklogNs / 2), 0);
  EXPECT_EQ(answered - pacer.deadline(0), Pacer::kMaxBacklogNs / 2);
}

TEST(Pacer, AShortWaitForSomeoneElseIsCaughtUp) {
  Pacer pacer(kStepNs, 1.0);
  pacer.restart(0, kNow);
  pacer.forgiveWait(5, pacer.deadline(5) + Pacer::kMaxBacklogNs / 2);
  pacer.forgiveWait(5, pacer.deadline(5) - kStepNs);
  EXPECT_EQ(pacer.deadline(5), kNow + 5 * kStepNs);
}

TEST(Pacer, ANonPositiveStepOrFactorIsAMistakeOfTheCaller) {
  EXPECT_THROW(Pacer(0, 1.0), std::logic_error);
  EXPECT_THROW(Pacer(kStepNs, -1.0), std::logic_error);
  EXPECT_THROW(Pacer(kStepNs, 0.0), std::logic_error);
}

}  // namespace
}  // namespace hovercraft
