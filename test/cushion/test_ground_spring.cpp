#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/ground_spring.h"

namespace hovercraft {
namespace {

TEST(GroundSpring, PressesAlongTheNormalAndIsDampedButNeverPulls) {
  const GroundSpring spring = {2.0, 0.0, 0.02};
  const Vector3 nhat(0.0, 0.6, 0.8);
  const Vector3 sinking = -0.1 * nhat;
  EXPECT_NEAR(norm(spring.force(5.0, nhat, sinking) - 6.0 * nhat), 0.0, 1e-15);
  EXPECT_EQ(norm(spring.force(5.0, nhat, 0.6 * nhat)), 0.0);  // faster than 1/alpha
}

TEST(GroundSpring, FrictionOpposesSlidingAndGrowsUpToTheSlipSpeed) {
  const GroundSpring spring = {0.0, 0.3, 0.02};
  const Vector3 fast = spring.force(10.0, Vector3::UnitZ(), Vector3(4.0, -3.0, 0.0));
  EXPECT_NEAR(fast.x(), -3.0 * 0.8, 1e-4);
  EXPECT_NEAR(fast.y(), 3.0 * 0.6, 1e-4);
  EXPECT_EQ(fast.z(), 10.0);
  const Vector3 slow = spring.force(10.0, Vector3::UnitZ(), Vector3(0.02, 0.0, 0.0));
  EXPECT_NEAR(slow.x(), -3.0 / std::sqrt(2.0), 1e-12);
  EXPECT_EQ(norm(spring.force(10.0, Vector3::UnitZ(), Vector3::Zero())), 10.0);
}

}  // namespace
}  // namespace hovercraft
