#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <random>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/world/roof_ground.h"

namespace hovercraft {
namespace {

GroundSample sampleOf(const Ground& ground, double x, double y, double z, double below,
                      double reach = kNoGround) {
  const GroundPoint point = {x, y, z};
  GroundSample sample;
  ground.sample({&point, 1, below, reach}, &sample);
  return sample;
}

Pose at(double x, double y, double z) {
  return {Matrix3::Identity(), Vector3(x, y, z)};
}

TEST(RoofGround, UpperSideOfABoxIsGroundAndBesideItThereIsNone) {
  RoofGround ground(nullptr);
  ground.add(boxPolyhedron(Vector3(4.0, 2.0, 1.0)), at(0.0, 0.0, -0.5));
  EXPECT_EQ(sampleOf(ground, 1.9, 0.9, 0.003, 0.1).gap, 0.003);
  EXPECT_EQ(sampleOf(ground, 1.9, 0.9, -0.002, 0.1).gap, -0.002);
  EXPECT_EQ(sampleOf(ground, 2.1, 0.9, 0.003, 0.1).gap, kNoGround);
  EXPECT_EQ(sampleOf(ground, 1.9, -1.1, 0.003, 0.1).gap, kNoGround);
}

TEST(RoofGround, RampHasItsSlopesGapAndNormal) {
  RoofGround ground(nullptr);
  const Matrix3 R = rotationFromRpy({0.0, -0.2, 0.5});  // rises along its x
  ground.add(boxPolyhedron(Vector3(4.0, 2.0, 1.0)), {R, Vector3(3.0, 1.0, 0.0)});
  const Vector3 n = R.col(2);
  const Vector3 above = Vector3(3.0, 1.0, 0.0) + times(R, Vector3(0.7, -0.4, 0.5 + 0.004));
  const GroundSample sample = sampleOf(ground, above.x(), above.y(), above.z(), 10.0);
  EXPECT_NEAR(sample.gap, 0.004, 1e-14);
  EXPECT_NEAR(norm(sample.normal() - n), 0.0, 1e-15);
}

TEST(RoofGround, BridgeIsGroundForWhoIsOnItAndNotForWhoIsUnderIt) {
  RoofGround ground(std::make_shared<PlaneGround>(GroundPlane()));
  ground.add(boxPolyhedron(Vector3(1.0, 10.0, 0.1)), at(0.0, 0.0, 1.0));
  EXPECT_NEAR(sampleOf(ground, 0.0, 0.0, 1.06, 1.1).gap, 0.01, 1e-15);
  EXPECT_EQ(sampleOf(ground, 0.0, 0.0, 0.1, 0.15).gap, 0.1);
  EXPECT_EQ(sampleOf(ground, 0.6, 0.0, 0.1, 1.1).gap, 0.1);
}

TEST(RoofGround, HighestOfManyIsTheGroundWhateverTheirOrder) {
  RoofGround ground(std::make_shared<PlaneGround>(GroundPlane{Vector3::UnitZ(), -0.2}));
  ground.add(boxPolyhedron(Vector3(4.0, 4.0, 1.0)), at(0.0, 0.0, -0.5));
  ground.add(boxPolyhedron(Vector3(1.0, 1.0, 0.2)), at(0.0, 0.0, 0.1));
  ground.add(boxPolyhedron(Vector3(2.0, 2.0, 0.2)), at(0.0, 0.0, 0.0));
  EXPECT_NEAR(sampleOf(ground, 0.0, 0.0, 0.3, 1.0).gap, 0.1, 1e-15);
  EXPECT_NEAR(sampleOf(ground, 0.7, 0.0, 0.3, 1.0).gap, 0.2, 1e-15);
  EXPECT_NEAR(sampleOf(ground, 1.7, 0.0, 0.3, 1.0).gap, 0.3, 1e-15);
  EXPECT_NEAR(sampleOf(ground, 2.7, 0.0, 0.3, 1.0).gap, 0.5, 1e-15);
}

TEST(RoofGround, WallIsNoGroundForAPointBesideItsFoot) {
  RoofGround ground(std::make_shared<PlaneGround>(GroundPlane()));
  ground.add(boxPolyhedron(Vector3(1.0, 10.0, 1.0)), at(0.0, 0.0, 0.5));
  EXPECT_EQ(sampleOf(ground, 0.4999, 0.0, 0.003, 0.1, 0.1).gap, 0.003);
  EXPECT_NEAR(sampleOf(ground, 0.4999, 0.0, 0.95, 1.1, 0.1).gap, -0.05, 1e-15);
}

ConvexPolyhedron randomHull(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<Vector3> points(20);
  for (Vector3& point : points) {
    for (Eigen::Index i = 0; i < 3; ++i) point[i] = normal(random);
  }
  return convexHull(points, "hull");
}

/// The height at which the vertical line through (x, y) leaves the hull, the lowest of its upper
/// faces, if it meets the hull.
std::optional<double> topOf(const ConvexPolyhedron& hull, const Pose& X_WO, double x, double y) {
  double enters = -1e9;
  double leaves = 1e9;
  for (int f = 0; f < hull.faceCount(); ++f) {
    const Vector3 n = times(X_WO.R_AB, hull.face(f).normal);
    const double z = (hull.face(f).offset + dot(n, X_WO.p_AB) - n.x() * x - n.y() * y) / n.z();
    if (n.z() > 0.0) leaves = std::min(leaves, z);
    if (n.z() < 0.0) enters = std::max(enters, z);
  }
  if (leaves < enters) return std::nullopt;
  return leaves;
}

/// How far a point of W is outside the hull; 0 on its surface.
double beyond(const ConvexPolyhedron& hull, const Pose& X_WO, const Vector3& p_W) {
  const Vector3 p = inverseTransform(X_WO, p_W);
  double most = -1e9;
  for (int f = 0; f < hull.faceCount(); ++f) {
    most = std::max(most, dot(hull.face(f).normal, p) - hull.face(f).offset);
  }
  return most;
}

TEST(RoofGround, TopOfARandomHullIsWhereAVerticalRayLeavesIt) {
  const unsigned seed = 7;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  int hits = 0;
  for (int trial = 0; trial < 50; ++trial) {
    const ConvexPolyhedron hull = randomHull(random);
    const Pose X_WO = {rotationFromRpy({normal(random), normal(random), normal(random)}),
                       Vector3(normal(random), normal(random), normal(random))};
    RoofGround ground(nullptr);
    ground.add(hull, X_WO);
    for (int i = 0; i < 50; ++i) {
      const double x = X_WO.p_AB.x() + normal(random);
      const double y = X_WO.p_AB.y() + normal(random);
      const GroundSample sample = sampleOf(ground, x, y, 100.0, 1000.0);
      const std::optional<double> top = topOf(hull, X_WO, x, y);
      EXPECT_EQ(sample.gap < kNoGround, top.has_value());
      if (!top) continue;
      ++hits;
      EXPECT_NEAR(sample.gap, (100.0 - *top) * sample.nz, 1e-10);
      EXPECT_NEAR(beyond(hull, X_WO, Vector3(x, y, *top)), 0.0, 1e-12);
    }
  }
  EXPECT_GT(hits, 500);
}

/// Whether eight points that are asked together see what each alone sees. @param held counts those
/// over the block.
void expectAlike(const Ground& ground, const std::array<GroundPoint, 8>& points, int& held) {
  std::array<GroundSample, 8> together;
  ground.sample({points.data(), 8, 0.5, kNoGround}, together.data());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const GroundSample alone = sampleOf(ground, points[i].x, points[i].y, points[i].z, 0.5);
    EXPECT_EQ(together[i].gap, alone.gap);
    EXPECT_EQ(together[i].nx, alone.nx);
    if (alone.gap < 0.5) ++held;
  }
}

// Points within a rectangle that a roof holds are not asked for its walls: in a block that is
// turned, near its sides and across them; of a block on its corner, which has no walls, each is.
TEST(RoofGround, PointsAskedTogetherSeeWhatEachAloneSees) {
  for (const Vector3& rpy : {Vector3(0.0, 0.0, 0.6), Vector3(0.8, 0.6, 0.0)}) {
    RoofGround ground(std::make_shared<PlaneGround>(GroundPlane{Vector3::UnitZ(), -0.3}));
    ground.add(boxPolyhedron(Vector3(2.0, 1.0, 1.0)),
               {rotationFromRpy(rpy), Vector3(0.1, 0.2, -0.4)});
    std::mt19937 random(20261127);
    std::uniform_real_distribution<double> place(-1.2, 1.2);
    std::uniform_real_distribution<double> offset(-0.2, 0.2);
    int mixed = 0;
    for (int n = 0; n < 2000 && !::testing::Test::HasFailure(); ++n) {
      const double x = place(random);
      const double y = place(random);
      std::array<GroundPoint, 8> points;
      for (GroundPoint& point : points) point = {x + offset(random), y + offset(random), 0.4};
      int held = 0;
      expectAlike(ground, points, held);
      if (held > 0 && held < 8) ++mixed;
    }
    EXPECT_GT(mixed, 100);
  }
}

}  // namespace
}  // namespace hovercraft
