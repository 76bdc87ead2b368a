#include <cmath>

#include <gtest/gtest.h>

#include "../support/test_world.h"

/// Bodies that slide smoothly on two contacts while they turn faster and faster.

namespace hovercraft {
namespace {

using testing::atRest;
using testing::TestWorld;

constexpr double kLength = 1.0;                // m, of the ladder
constexpr double kThickness = 0.02;            // m
constexpr double kStart = 1.2217304763960306;  // rad: 70 degrees from the floor
constexpr double kPull = 9.81;                 // m/s²

/// A ladder of 1 kg without friction that touches the floor with one corner and the wall with
/// another: x = L/2 cos a + d/2 sin a of its middle from the wall, y = L/2 sin a + d/2 cos a from
/// the floor, a its angle.
struct Ladder {
  double angle;
  double rate;  // rad/s

  /// From (I + x'² + y'²) a'' = -g y' - (x' x'' + y' y'') a'², of 1 kg.
  double acceleration() const {
    const double l = 0.5 * kLength;
    const double d = 0.5 * kThickness;
    const double x1 = -l * std::sin(angle) + d * std::cos(angle);
    const double y1 = l * std::cos(angle) - d * std::sin(angle);
    const double x2 = -l * std::cos(angle) - d * std::sin(angle);
    const double y2 = -l * std::sin(angle) - d * std::cos(angle);
    const double inertia = (kLength * kLength + kThickness * kThickness) / 12.0;
    return (-kPull * y1 - (x1 * x2 + y1 * y2) * rate * rate) / (inertia + x1 * x1 + y1 * y1);
  }
};

/// By the midpoint rule, in steps so short that its error is none.
Ladder ladderAfter(double time) {
  Ladder ladder{kStart, 0.0};
  const int count = 100000;
  const double h = time / count;
  for (int i = 0; i < count; ++i) {
    const Ladder middle{ladder.angle + 0.5 * h * ladder.rate,
                        ladder.rate + 0.5 * h * ladder.acceleration()};
    ladder = {ladder.angle + h * middle.rate, ladder.rate + h * middle.acceleration()};
  }
  return ladder;
}

void lean(TestWorld& world, Integrator integrator, double step) {
  world.config.integrator = integrator;
  world.config.step = step;
  world.gravity = Vector3(0.0, -kPull, 0.0);
  world.planar = true;
  world.watch = false;
  world.addWall(Vector3(20.0, 1.0, 1.0), Vector3(0.0, -0.5, 0.0));
  world.addWall(Vector3(1.0, 6.0, 1.0), Vector3(-0.5, 2.0, 0.0));
  // Its foot goes away from the wall: it lies from the upper left to the lower right.
  const double x = 0.5 * (kLength * std::cos(kStart) + kThickness * std::sin(kStart));
  const double y = 0.5 * (kLength * std::sin(kStart) + kThickness * std::cos(kStart));
  world.addBox(1.0, Vector3(kLength, kThickness, 0.2), Vector3(x, y, 0.0), atRest(),
               Vector3(0.0, 0.0, -kStart));
}

// The pieces of a step ended where a turn at a constant rate ran ahead of a middle that sped up: at
// 10 ms each step was cut off, and time ran at a quarter.
TEST(Sliding, ALadderFallsAtEachStepAsItsEquationSays) {
  const double time = 0.3;  // s
  const Ladder expected = ladderAfter(time);
  for (const Integrator integrator : {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                      Integrator::kHeun, Integrator::kRungeKutta4}) {
    for (const double step : {0.001, 0.005, 0.01, 0.02}) {
      TestWorld world;
      lean(world, integrator, step);
      world.step(static_cast<int>(std::lround(time / step)));
      const Quaternion& q = world.state(0).orientation;
      const double angle = -2.0 * std::atan2(q.v.z(), q.s);
      EXPECT_EQ(world.world().stalls(), 0) << step;
      if (integrator == Integrator::kEuler) continue;  // its flights end faster than they begin
      EXPECT_NEAR(angle, expected.angle, 0.25 * step) << step;
      EXPECT_NEAR(-world.twist(0).w_WB.z(), expected.rate, 2.0 * step) << step;
    }
  }
}

}  // namespace
}  // namespace hovercraft
