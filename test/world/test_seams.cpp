#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "../support/test_world.h"

/// What is built of pieces behaves as one piece.

namespace hovercraft {
namespace {

using testing::TestWorld;

/// Where a craft is that slid along a wall, and what it met.
struct Slide {
  Vector3 p;
  Twist twist;
  std::size_t impacts = 0;
};

struct SlideCase {
  double step = 0.001;
  bool planar = true;
  ContactMaterial law;
  Vector3 p_WB;
  Twist twist;
};

/// A craft of 0.6 m by 0.4 m along a wall of 4 m whose upper side is y = -0.2, for 1 s.
Slide slideAlong(const SlideCase& run, int pieces) {
  TestWorld world;
  world.planar = run.planar;
  world.config.step = run.step;
  world.material() = run.law;
  const double length = 4.0 / pieces;
  for (int i = 0; i < pieces; ++i) {
    world.addWall(Vector3(length, 0.2, 0.5), Vector3(-1.0 + (i + 0.5) * length, -0.3, 0.0));
  }
  world.addBox(5.0, Vector3(0.6, 0.4, 0.12), run.p_WB, run.twist);
  world.watch = false;
  world.step(static_cast<int>(std::lround(1.0 / run.step)));
  return {world.state(0).p_WB, world.twist(0), world.records.size()};
}

// The scene of the fault: thrown off with v = (0.55, 0.45) and w = 1.03 where two boxes meet.
TEST(Seams, ACraftWithoutFrictionSlidesOverOne) {
  SlideCase run;
  run.p_WB = Vector3(0.0, 0.01, 0.0);
  run.twist = {Vector3(1.0, -0.1, 0.0), Vector3::Zero()};
  const Slide slide = slideAlong(run, 4);
  EXPECT_LT(norm(slide.twist.v_WB - Vector3(1.0, 0.0, 0.0)), 1e-12);
  EXPECT_LT(norm(slide.twist.w_WB), 1e-12);
}

// A wall of 1, 4 and 40 pieces: the same motion, from random starts, planar and spatial, at any
// step and with any law.
TEST(Seams, AWallOfPiecesIsOneWall) {
  std::mt19937 generator(11);  // NOLINT(cert-msc32-c,cert-msc51-cpp)
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 24; ++trial) {
    SlideCase run;
    run.step = trial % 3 == 0 ? 0.0005 : trial % 3 == 1 ? 0.001 : 0.01;
    run.planar = trial % 2 == 0;
    run.law = {trial % 4 == 3 ? 0.5 : 0.0, trial % 5 == 4 ? 0.3 : 0.0, false};
    run.p_WB = Vector3(0.3 * uniform(generator), 1e-3 + 0.02 * uniform(generator), 0.0);
    run.twist = {Vector3(0.5 + uniform(generator), -0.05 - 0.1 * uniform(generator), 0.0),
                 Vector3::Zero()};
    const Slide whole = slideAlong(run, 1);
    for (const int pieces : {4, 40}) {
      const Slide slide = slideAlong(run, pieces);
      EXPECT_LT(norm(slide.p - whole.p), 2e-6) << trial << " " << pieces;
      EXPECT_LT(norm(slide.twist.v_WB - whole.twist.v_WB), 1e-6) << trial << " " << pieces;
      EXPECT_LT(norm(slide.twist.w_WB - whole.twist.w_WB), 1e-6) << trial << " " << pieces;
    }
  }
}

}  // namespace
}  // namespace hovercraft
