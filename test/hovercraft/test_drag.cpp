#include <random>

#include <gtest/gtest.h>

#include "hovercraft_sim/hovercraft/drag.h"

#include "../support/numbers.h"

namespace hovercraft {
namespace {

using testing::kRounding;

/// Twelve different coefficients, so that no two can change places unseen.
Drag differentCoefficients() {
  Drag drag;
  drag.linear = {0.8, 1.2, 2.5};
  drag.quadratic = {0.4, 0.9, 1.7};
  drag.angular_linear = {0.11, 0.13, 0.17};
  drag.angular_quadratic = {0.05, 0.07, 0.19};
  return drag;
}

// Each axis by itself: at a rate of ±2, -(c1 2 + c2 2²) and its opposite, and nothing on the
// others.
TEST(Drag, EachAxisResistsByItself) {
  const Drag drag = differentCoefficients();
  for (int i = 0; i < 3; ++i) {
    for (const double rate : {-2.0, 2.0}) {
      Vector3 along = Vector3::Zero();
      along[i] = rate;
      const Wrench moving = drag.wrenchInBody(along, Vector3::Zero());
      const Wrench turning = drag.wrenchInBody(Vector3::Zero(), along);
      Vector3 force = Vector3::Zero();
      force[i] = -(drag.linear[i] * 2.0 + drag.quadratic[i] * 4.0) * (rate / 2.0);
      Vector3 torque = Vector3::Zero();
      torque[i] = -(drag.angular_linear[i] * 2.0 + drag.angular_quadratic[i] * 4.0) * (rate / 2.0);
      EXPECT_LT(norm(moving.force - force), 10.0 * kRounding) << "axis " << i;
      EXPECT_EQ(moving.torque, Vector3(0.0, 0.0, 0.0)) << "axis " << i;
      EXPECT_LT(norm(turning.torque - torque), 10.0 * kRounding) << "axis " << i;
      EXPECT_EQ(turning.force, Vector3(0.0, 0.0, 0.0)) << "axis " << i;
    }
  }
}

TEST(Drag, LinearPartDoublesAndQuadraticPartQuadruplesWithSpeed) {
  Drag linear;
  linear.linear = {3.0, 0.0, 0.0};
  Drag quadratic;
  quadratic.quadratic = {3.0, 0.0, 0.0};
  const Vector3 slow(0.5, 0.0, 0.0);
  const Vector3 fast(1.0, 0.0, 0.0);
  const Vector3 still = Vector3::Zero();
  EXPECT_EQ(linear.wrenchInBody(slow, still).force.x(), -1.5);
  EXPECT_EQ(linear.wrenchInBody(fast, still).force.x(), -3.0);
  EXPECT_EQ(quadratic.wrenchInBody(slow, still).force.x(), -0.75);
  EXPECT_EQ(quadratic.wrenchInBody(fast, still).force.x(), -3.0);
}

TEST(Drag, NeverAddsEnergy) {
  std::mt19937 engine(11);
  std::normal_distribution<double> number;
  const Drag drag = differentCoefficients();
  for (int n = 0; n < 200; ++n) {
    const Vector3 u_B(number(engine), number(engine), number(engine));
    const Vector3 w_WB_B(number(engine), number(engine), number(engine));
    const Wrench wrench = drag.wrenchInBody(u_B, w_WB_B);
    EXPECT_LT(dot(wrench.force, u_B) + dot(wrench.torque, w_WB_B), 0.0) << "sample " << n;
  }
}

TEST(Drag, IsNothingAtRest) {
  const Wrench wrench = differentCoefficients().wrenchInBody(Vector3::Zero(), Vector3::Zero());
  EXPECT_EQ(wrench.force, Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(wrench.torque, Vector3(0.0, 0.0, 0.0));
}

}  // namespace
}  // namespace hovercraft
