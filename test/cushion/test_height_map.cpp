#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/height_map.h"

namespace hovercraft {
namespace {

GroundSample sampleOf(const Ground& ground, double x, double y, double z) {
  const GroundPoint point = {x, y, z};
  GroundSample sample;
  ground.sample({&point, 1, z, kNoGround}, &sample);
  return sample;
}

/// z = 0.3 + 0.1 x - 0.2 y + 0.4 x y on a grid: bilinear, so that a map of one mesh is exact.
double warped(double x, double y) {
  return 0.3 + 0.1 * x - 0.2 * y + 0.4 * x * y;
}

TEST(HeightMapGround, IsBilinearWithTheNormalOfItsSurface) {
  HeightGrid grid = {3, 4, 0.5, -1.0, 2.0, {}};
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      grid.heights.push_back(
          warped(-1.0 + 0.5 * static_cast<double>(column), 2.0 + 0.5 * static_cast<double>(row)));
    }
  }
  const HeightMapGround ground(grid);
  const unsigned seed = 3;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const double x = -1.0 + share(random);
    const double y = 2.0 + 1.5 * share(random);
    const double z = 3.0 * share(random);
    const GroundSample sample = sampleOf(ground, x, y, z);
    const Vector3 up(-(0.1 + 0.4 * y), -(-0.2 + 0.4 * x), 1.0);
    EXPECT_NEAR(norm(sample.normal() - up / norm(up)), 0.0, 1e-14);
    EXPECT_NEAR(sample.gap, (z - warped(x, y)) / norm(up), 1e-14);
  }
}

TEST(HeightMapGround, BeyondItsEdgesTheHeightsOfTheEdgeGoOn) {
  const HeightMapGround ground({2, 2, 1.0, 0.0, 0.0, {0.0, 1.0, 2.0, 3.0}});
  EXPECT_EQ(sampleOf(ground, -5.0, -5.0, 10.0).gap, 10.0);
  EXPECT_EQ(sampleOf(ground, 1e30, 1e30, 10.0).gap, 7.0);
  const GroundSample beside = sampleOf(ground, 7.0, 0.5, 10.0);  // falls along y only
  EXPECT_NEAR(beside.gap, 8.0 / std::sqrt(5.0), 1e-15);
  EXPECT_EQ(beside.nx, 0.0);
  EXPECT_NEAR(beside.ny, -2.0 / std::sqrt(5.0), 1e-15);
}

}  // namespace
}  // namespace hovercraft
