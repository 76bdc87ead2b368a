#include <gtest/gtest.h>

#include "hovercraft_sim/pacing/lockstep.h"

namespace hovercraft {
namespace {

constexpr std::int64_t kStamp = 12340000000;
constexpr std::int64_t kOther = 12350000000;

TEST(Lockstep, NobodyOwesACommandAtFirst) {
  Lockstep lockstep(2);
  EXPECT_FALSE(lockstep.awaited());
  EXPECT_NE(lockstep.offer(0, kStamp), nullptr);
}

TEST(Lockstep, GoesOnWhenEveryVehicleHasAnswered) {
  Lockstep lockstep(3);
  lockstep.await(kStamp);
  EXPECT_EQ(lockstep.awaited(), 0U);
  EXPECT_EQ(lockstep.offer(0, kStamp), nullptr);
  EXPECT_EQ(lockstep.awaited(), 1U);
  EXPECT_EQ(lockstep.offer(2, kStamp), nullptr);
  EXPECT_EQ(lockstep.awaited(), 1U);
  EXPECT_EQ(lockstep.offer(1, kStamp), nullptr);
  EXPECT_FALSE(lockstep.awaited());
}

TEST(Lockstep, TakesOneCommandOfTheRightStampOnly) {
  Lockstep lockstep(1);
  lockstep.await(kStamp);
  EXPECT_NE(lockstep.offer(0, kOther), nullptr);
  EXPECT_NE(lockstep.offer(0, std::nullopt), nullptr);
  EXPECT_EQ(lockstep.awaited(), 0U);
  EXPECT_EQ(lockstep.offer(0, kStamp), nullptr);
  EXPECT_NE(lockstep.offer(0, kStamp), nullptr);  // a second one
}

TEST(Lockstep, ClearForgetsWhatIsOwed) {
  Lockstep lockstep(1);
  lockstep.await(kStamp);
  lockstep.clear();
  EXPECT_FALSE(lockstep.awaited());
}

}  // namespace
}  // namespace hovercraft
