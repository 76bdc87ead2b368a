#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/web/driver_seats.h"
#include "hovercraft_sim/web/rate_limiter.h"

namespace hovercraft_ros {
namespace {

using Stops = std::vector<std::size_t>;
constexpr std::int64_t kSecond = 1000000000;

TEST(DriverSeats, OneDrivesUntilHeLeaves) {
  DriverSeats seats(2);
  EXPECT_FALSE(seats.drive(0, 1, 0));
  EXPECT_TRUE(seats.take(0, 1, 0));
  EXPECT_TRUE(seats.take(0, 1, 0));
  EXPECT_FALSE(seats.take(0, 2, 0));
  EXPECT_FALSE(seats.drive(0, 2, 0));
  EXPECT_TRUE(seats.drive(0, 1, 0));
  EXPECT_FALSE(seats.leave(0, 2));
  EXPECT_EQ(seats.driver(0), ViewerId{1});
  EXPECT_TRUE(seats.take(1, 2, 0));
  EXPECT_TRUE(seats.leave(0, 1));
  EXPECT_FALSE(seats.drive(0, 1, 0));
  EXPECT_TRUE(seats.take(0, 2, 0));
}

TEST(DriverSeats, WhoSaysNothingIsStoppedOnceWithinADeadMansTime) {
  DriverSeats seats(2);
  seats.take(1, 7, 0);
  seats.drive(1, 7, 0);
  EXPECT_EQ(seats.takeStops(DriverSeats::kDeadManNs), Stops());
  EXPECT_EQ(seats.takeStops(DriverSeats::kDeadManNs + 1), Stops{1});
  EXPECT_EQ(seats.takeStops(DriverSeats::kDeadManNs + 2), Stops());
  EXPECT_EQ(seats.driver(1), ViewerId{7});
  // He goes on, and is watched again.
  EXPECT_TRUE(seats.drive(1, 7, kSecond));
  EXPECT_EQ(seats.takeStops(kSecond + DriverSeats::kDeadManNs + 1), Stops{1});
  // With what else passes, less than 0.3 s.
  EXPECT_LE(DriverSeats::kDeadManNs, 280000000);
}

TEST(DriverSeats, WhoLeavesIsStoppedAtOnce) {
  DriverSeats seats(3);
  for (const std::size_t craft : {0U, 2U}) {
    seats.take(craft, 4, 0);
    seats.drive(craft, 4, 0);
  }
  seats.take(1, 5, 0);
  seats.drive(1, 5, 0);
  EXPECT_TRUE(seats.leaveAll(4));
  EXPECT_EQ(seats.takeStops(1), (Stops{0, 2}));
  EXPECT_EQ(seats.driver(1), ViewerId{5});
  EXPECT_FALSE(seats.leaveAll(4));
}

TEST(DriverSeats, WhoNeverDroveNeedsNoStop) {
  DriverSeats seats(1);
  seats.take(0, 1, 0);
  EXPECT_EQ(seats.takeStops(kSecond), Stops());
  seats.leave(0, 1);
  EXPECT_EQ(seats.takeStops(kSecond), Stops());
}

TEST(DriverSeats, TheNextDriversLevelsAreNotStoppedForTheLastOnes) {
  DriverSeats seats(1);
  seats.take(0, 1, 0);
  seats.drive(0, 1, 0);
  seats.leave(0, 1);
  seats.take(0, 2, 1);
  seats.drive(0, 2, 2);
  EXPECT_EQ(seats.takeStops(3), Stops());
}

TEST(DriverSeats, WhoSaysNothingForLongHasLeft) {
  DriverSeats seats(1);
  seats.take(0, 1, 0);
  EXPECT_FALSE(seats.lapse(DriverSeats::kLapseNs));
  EXPECT_TRUE(seats.lapse(DriverSeats::kLapseNs + 1));
  EXPECT_FALSE(seats.lapse(DriverSeats::kLapseNs + 2));
  EXPECT_EQ(seats.driver(0), std::nullopt);
}

TEST(RateLimiter, LetsABurstThroughThenTheRate) {
  RateLimiter limiter(10.0, 5.0);
  int passed = 0;
  for (int i = 0; i < 20; ++i) passed += limiter.take(0) ? 1 : 0;
  EXPECT_EQ(passed, 5);
  // 100 in a second: ten of them, and none that the burst left.
  passed = 0;
  for (int i = 1; i <= 100; ++i) passed += limiter.take(i * kSecond / 100) ? 1 : 0;
  EXPECT_NEAR(passed, 10, 1);
}

TEST(RateLimiter, WhoWaitedHasOneBurstAndNoMore) {
  RateLimiter limiter(10.0, 5.0);
  EXPECT_TRUE(limiter.take(0));
  int passed = 0;
  for (int i = 0; i < 20; ++i) passed += limiter.take(1000 * kSecond) ? 1 : 0;
  EXPECT_EQ(passed, 5);
}

TEST(RateLimiter, AClockThatStandsOrGoesBackGivesNothing) {
  RateLimiter limiter(1000.0, 1.0);
  EXPECT_TRUE(limiter.take(kSecond));
  EXPECT_FALSE(limiter.take(kSecond));
  EXPECT_FALSE(limiter.take(0));
}

}  // namespace
}  // namespace hovercraft_ros
