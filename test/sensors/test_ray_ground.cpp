#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/sensors/ray_ground.h"

namespace hovercraft {
namespace {

BeamFan oneBeam() {
  return {{1.0}, {0.0}};
}

/// The range of one beam along the x axis of a frame at p, turned by rpy.
double rangeOf(const RayGround& ground, const Vector3& p, const Vector3& rpy,
               double farthest = 100.0) {
  double range = std::numeric_limits<double>::infinity();
  ground.cast(oneBeam(), {rotationFromRpy(rpy), p}, farthest, &range);
  return range;
}

HeightGrid gridOf(std::size_t columns, std::size_t rows, double spacing) {
  HeightGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  grid.spacing = spacing;
  grid.x = -1.0;
  grid.y = -2.0;
  grid.heights.assign(columns * rows, 0.0);
  return grid;
}

// 1 m over a plane, 30 degrees down: 2 m.
TEST(RayGround, APlaneIsHitWhereTheBeamComesDown) {
  const RayGround plane(GroundPlane{Vector3::UnitZ(), 0.5});
  EXPECT_NEAR(rangeOf(plane, {7.0, 3.0, 1.5}, {0.0, std::asin(0.5), 1.0}), 2.0, 1e-12);
  EXPECT_EQ(rangeOf(plane, {7.0, 3.0, 1.5}, {0.0, -0.1, 1.0}),
            std::numeric_limits<double>::infinity());
  EXPECT_EQ(rangeOf(plane, {7.0, 3.0, 0.4}, {0.0, -0.1, 1.0}), 0.0);
}

// Heights of the plane z = 0.2 x + 0.1 y: bilinear is exact, and beyond the edge it is level.
TEST(RayGround, AMapOfASlopeIsTheSlope) {
  HeightGrid grid = gridOf(9, 11, 0.5);
  for (std::size_t row = 0; row < grid.rows; ++row) {
    for (std::size_t column = 0; column < grid.columns; ++column) {
      grid.heights[row * grid.columns + column] =
          0.2 * (grid.x + 0.5 * static_cast<double>(column)) +
          0.1 * (grid.y + 0.5 * static_cast<double>(row));
    }
  }
  const RayGround map(grid);
  const Vector3 normal = Vector3(-0.2, -0.1, 1.0).normalized();
  const RayGround plane(GroundPlane{normal, 0.0});
  for (const double yaw : {0.0, 0.7, 2.0, -2.5, 3.1}) {
    for (const double pitch : {0.6, 0.9, 1.5}) {
      const Vector3 from(1.0, 0.3, 0.9);
      EXPECT_NEAR(rangeOf(map, from, {0.0, pitch, yaw}), rangeOf(plane, from, {0.0, pitch, yaw}),
                  1e-12)
          << yaw << " " << pitch;
    }
  }
  // The edge at x = 3, y = 0: 0.6 m high from there on; from 1.6 m, 45 degrees down.
  EXPECT_NEAR(rangeOf(map, {5.0, 0.0, 1.6}, {0.0, 0.25 * 3.14159265358979, 0.0}), std::sqrt(2.0),
              1e-9);
}

// Against a march of a tenth of a millimetre on random heights.
TEST(RayGround, AgreesWithAMarchAlongTheBeam) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  HeightGrid grid = gridOf(7, 6, 0.7);
  for (double& height : grid.heights) height = 0.4 * unit(random);
  const RayGround map(grid);
  const HeightMapGround ground(grid);
  const auto above = [&](const Vector3& p) {
    const GroundPoint point = {p.x(), p.y(), p.z()};
    GroundQuery query;
    query.points = &point;
    query.count = 1;
    GroundSample sample = kOverNothing;
    ground.sample(query, &sample);
    return sample.gap;
  };
  int hits = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3 p(1.0 + 3.0 * unit(random), 3.0 * unit(random), 0.3 + 0.3 * unit(random));
    const Vector3 rpy(0.0, 0.2 * unit(random), 3.0 * unit(random));
    const double range = rangeOf(map, p, rpy, 6.0);
    const Vector3 d = times(rotationFromRpy(rpy), Vector3::UnitX());
    if (range <= 6.0) {
      ++hits;
      EXPECT_NEAR(std::min(above(p), 0.0) * (range == 0.0 ? 0.0 : 1.0), 0.0, 1e-12);
      if (range > 0.0) {
        EXPECT_NEAR(above(p + range * d), 0.0, 1e-9) << trial;
      }
    }
    for (double t = 0.0; t < std::min(range, 6.0) - 1e-6; t += 1e-3) {
      ASSERT_GT(above(p + t * d), -1e-9) << trial << " " << t << " of " << range;
    }
  }
  EXPECT_GT(hits, 60);
}

}  // namespace
}  // namespace hovercraft
