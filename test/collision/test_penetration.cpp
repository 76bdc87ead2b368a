#include <gtest/gtest.h>

#include "hovercraft_sim/collision/penetration.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"

#include "check_query.h"
#include "random_bodies.h"

namespace hovercraft {
namespace {

// Two unit cubes, one 0.9 along x: the least way out is 0.1 along x.
TEST(LeastOverlap, OfTwoCubesIsAlongTheThinnestSide) {
  const ConvexPolyhedron cube = boxPolyhedron(Vector3(1, 1, 1));
  const Pose X_WB{Matrix3::Identity(), Vector3(0.9, 0.3, -0.2)};
  const LeastOverlap least = leastOverlap(cube, Pose(), cube, X_WB);
  EXPECT_NEAR(least.overlap, 0.1, 1e-15);
  EXPECT_EQ(least.nhat_AB_W, Vector3(1, 0, 0));
}

// Two square rods that cross at right angles, edge on edge: A has an edge along y at z = h below,
// B one along x; they overlap by 0.01 there and nowhere else.
TEST(LeastOverlap, OfTwoCrossedEdgesIsAlongTheirCommonNormal) {
  const double half_diagonal = std::sqrt(0.5);
  const ConvexPolyhedron rod_Y = boxPolyhedron(Vector3(1, 10, 1));
  const ConvexPolyhedron rod_X = boxPolyhedron(Vector3(10, 1, 1));
  const Pose X_WA{rotationMatrix(quaternionFromRpy({0, 0.78539816339744830962, 0})),
                  Vector3(0, 0, 0)};
  const Pose X_WB{rotationMatrix(quaternionFromRpy({0.78539816339744830962, 0, 0})),
                  Vector3(0.1, 0.2, 2 * half_diagonal - 0.01)};
  const LeastOverlap least = leastOverlap(rod_Y, X_WA, rod_X, X_WB);
  EXPECT_NEAR(least.overlap, 0.01, 1e-14);
  EXPECT_NEAR(least.nhat_AB_W.z(), 1.0, 1e-14);
  EXPECT_EQ(least.feature_a.kind, FeatureKind::kEdge);
  EXPECT_EQ(least.feature_b.kind, FeatureKind::kEdge);
  EXPECT_NEAR(least.p_WCa.x(), 0.0, 1e-14);
  EXPECT_NEAR(least.p_WCa.y(), 0.2, 1e-14);
}

TEST(LeastOverlap, AgreesWithEveryFaceNormalAndEveryCrossProductOfEdges) {
  RandomBodies random(77);
  int overlapping = 0;
  for (int i = 0; i < 400; ++i) {
    const ConvexPolyhedron A = random.ellipsoidHull(random.integer(4, 25), {1.0, 0.6, 0.3});
    const ConvexPolyhedron B = random.ellipsoidHull(random.integer(4, 25), {0.5, 0.9, 0.2});
    const Pose X_WA = random.pose(1.0);
    const Pose X_WB = random.pose(random.uniform(0.0, 1.0));
    const LeastOverlap least = leastOverlap(A, X_WA, B, X_WB);
    const brute_force::Body a = brute_force::place(A, X_WA, Vector3(0, 0, 0));
    const brute_force::Body b = brute_force::place(B, X_WB, Vector3(0, 0, 0));
    const auto expected = static_cast<double>(brute_force::leastOverlap(a, b));
    if (expected > 0.0) {
      ++overlapping;
      ASSERT_NEAR(least.overlap, expected, 1e-14) << "seed 77, sample " << i;
    } else {  // some direction parts them: then so does the normal of a face
      ASSERT_LT(least.overlap, 0.0) << "seed 77, sample " << i;
    }
  }
  EXPECT_GT(overlapping, 50);
}

// Moved by the depth along the normal, the bodies touch and no more.
TEST(LeastOverlap, PartsTheBodies) {
  RandomBodies random(78);
  for (int i = 0; i < 200; ++i) {
    const ConvexPolyhedron A = random.ellipsoidHull(30, {1.0, 0.6, 0.3});
    const ConvexPolyhedron B = random.ellipsoidHull(30, {0.5, 0.9, 0.2});
    Pose X_WB = random.pose(0.3);
    const LeastOverlap least = leastOverlap(A, Pose(), B, X_WB);
    ASSERT_GT(least.overlap, 0.0);
    X_WB.p_AB += (least.overlap + 1e-9) * least.nhat_AB_W;
    FeaturePair last;
    const ClosestFeatures c = closestFeatures(A, Pose(), B, X_WB, last);
    EXPECT_EQ(c.status, Proximity::kSeparated);
    EXPECT_NEAR(c.distance, 1e-9, 1e-14);
  }
}

}  // namespace
}  // namespace hovercraft
