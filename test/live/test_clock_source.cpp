#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/live/clock_source.h"
#include "hovercraft_sim/live/node_config.h"
#include "hovercraft_sim/math/time.h"

#include "../support/numbers.h"

namespace hovercraft_ros {
namespace {

using hovercraft::testing::kNow;
using hovercraft::testing::kStepNs;

/// A clock and what it published.
struct RecordedClock {
  explicit RecordedClock(double rate)
      : source([this](const ros::Time& stamp) { stamps.push_back(stamp); }, rate) {}

  std::vector<ros::Time> stamps;
  ClockSource source;
};

ros::Time clockStamp(std::int64_t tick) {
  ros::Time stamp;
  return stamp.fromNSec(static_cast<std::uint64_t>(tick * kStepNs));
}

TEST(ClockSource, PublishesOncePerPeriodOfSimulatedTime) {
  RecordedClock clock(100.0);  // every 10 steps of 1 ms, here in real time
  for (std::int64_t tick = 1; tick <= 100; ++tick) {
    clock.source.publishIfDue(clockStamp(tick), kNow + tick * kStepNs, false);
  }
  ASSERT_EQ(clock.stamps.size(), 10U);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(clock.stamps[i], clockStamp(10 * (static_cast<std::int64_t>(i) + 1)));
  }
}

// A thousand times real time for 1 s of wall time.
TEST(ClockSource, IsNeverAboveItsGreatestRateOfWallTime) {
  RecordedClock clock(NodeConfig::kMaxClockRate);
  std::int64_t last_ns = 0;
  std::size_t seen = 0;
  for (std::int64_t tick = 1; tick <= 1000000; ++tick) {
    const std::int64_t now = kNow + tick * kStepNs / 1000;
    clock.source.publishIfDue(clockStamp(tick), now, tick % 2 == 0);
    if (clock.stamps.size() == seen) continue;
    seen = clock.stamps.size();
    ASSERT_GE(now - last_ns, 4000000) << tick;
    last_ns = now;
  }
  EXPECT_GT(clock.stamps.size(), 240U);
  EXPECT_LE(clock.stamps.size(), 250U);
}

TEST(ClockSource, NeverPublishesTimeZero) {
  RecordedClock clock(100.0);
  for (int i = 0; i < 10; ++i) {
    clock.source.publishIfDue(ros::Time(), kNow + i * hovercraft::kNanosecondsPerSecond, true);
  }
  EXPECT_TRUE(clock.stamps.empty());
}

TEST(ClockSource, WhoWaitsSeesWhereTheSimulationStandsAndOnce) {
  RecordedClock clock(1.0);
  clock.source.publishIfDue(clockStamp(3), kNow, false);
  EXPECT_TRUE(clock.stamps.empty()) << "a second has not passed";
  clock.source.publishIfDue(clockStamp(3), kNow, true);
  clock.source.publishIfDue(clockStamp(3), kNow + hovercraft::kNanosecondsPerSecond, true);
  EXPECT_EQ(clock.stamps, (std::vector<ros::Time>{clockStamp(3)}));
}

TEST(ClockSource, SaysHowLongItIsUntilTheNextMessage) {
  RecordedClock clock(100.0);
  clock.source.publishIfDue(clockStamp(10), kNow, false);
  EXPECT_EQ(clock.source.untilDueNs(clockStamp(10)), 10 * kStepNs);
  EXPECT_EQ(clock.source.untilDueNs(clockStamp(13)), 7 * kStepNs);
  EXPECT_LE(clock.source.untilDueNs(clockStamp(20)), 0);
}

}  // namespace
}  // namespace hovercraft_ros
