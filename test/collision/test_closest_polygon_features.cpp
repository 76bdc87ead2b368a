#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "hovercraft_sim/collision/closest_polygon_features.h"

#include "random_bodies.h"

namespace hovercraft {
namespace {

double length(const Vector2& v) {
  return std::sqrt(dot(v, v));
}

ConvexPolygon randomPolygon(RandomBodies& random, double size) {
  std::vector<Vector2> points;
  const int n = random.integer(3, 12);
  points.reserve(static_cast<std::size_t>(n) + 3);
  for (int i = 0; i < n + 3; ++i) {
    points.push_back({size * random.uniform(-1, 1), size * random.uniform(-1, 1)});
  }
  return convexHull(points);
}

Vector2 place(const PlanarPose& X, const Vector2& p) {
  return Vector2{X.cosine * p.x - X.sine * p.y, X.sine * p.x + X.cosine * p.y} + X.p_AB;
}

PlanarPose randomPose(RandomBodies& random, double reach) {
  const double angle = random.uniform(0.0, 6.3);
  return {std::cos(angle),
          std::sin(angle),
          {reach * random.uniform(-1, 1), reach * random.uniform(-1, 1)}};
}

/// The distance of all pairs of vertex and edge, and the least overlap along all edge normals.
struct Expected {
  double distance = std::numeric_limits<double>::infinity();
  double gap = -std::numeric_limits<double>::infinity();  // largest over the normals
};

void look(const ConvexPolygon& A, const PlanarPose& X, const ConvexPolygon& B, const PlanarPose& Y,
          Expected& result) {
  for (int i = 0; i < A.vertexCount(); ++i) {
    const Vector2 p = place(X, A.vertex(i));
    const Vector2 along = place(X, A.vertex(A.next(i))) - p;
    const double square = dot(along, along);
    double low = std::numeric_limits<double>::infinity();
    for (int k = 0; k < B.vertexCount(); ++k) {
      const Vector2 w = place(Y, B.vertex(k)) - p;
      const double t = std::min(1.0, std::max(0.0, dot(w, along) / square));
      const Vector2 u = w - t * along;
      result.distance = std::min(result.distance, std::sqrt(dot(u, u)));
      low = std::min(low, -cross(along, w) / std::sqrt(square));
    }
    result.gap = std::max(result.gap, low);
  }
}

TEST(ClosestPolygonFeatures, AgreeWithAllPairsOfVerticesAndEdges) {
  RandomBodies random(61);
  int apart = 0;
  int overlapping = 0;
  FeaturePair last;
  for (int i = 0; i < 5000; ++i) {
    const ConvexPolygon A = randomPolygon(random, 1.0);
    const ConvexPolygon B = randomPolygon(random, std::pow(10.0, random.uniform(-2, 1)));
    const PlanarPose X_WA = randomPose(random, 1.0);
    const PlanarPose X_WB = randomPose(random, 4.0);
    last = FeaturePair{};
    const ClosestPolygonFeatures c = closestFeatures(A, X_WA, B, X_WB, last);
    Expected expected;
    look(A, X_WA, B, X_WB, expected);
    look(B, X_WB, A, X_WA, expected);
    if (expected.gap > 0.0) {
      ++apart;
      ASSERT_EQ(c.status, Proximity::kSeparated) << "seed 61, sample " << i;
      ASSERT_NEAR(c.distance, expected.distance, 2e-14) << "seed 61, sample " << i;
      ASSERT_LE(c.excess, 2e-14);
    } else {
      ++overlapping;
      ASSERT_EQ(c.status, Proximity::kPenetrating) << "seed 61, sample " << i;
      ASSERT_NEAR(c.distance, expected.gap, 2e-14) << "seed 61, sample " << i;
    }
    ASSERT_NEAR(dot(c.p_WCb - c.p_WCa, c.nhat_AB_W), c.distance, 2e-14);
  }
  EXPECT_GT(apart, 1000);
  EXPECT_GT(overlapping, 500);
}

// Theorem 1 and 2, from the rays that the polygons hand out.
TEST(ClosestPolygonFeatures, EachPointLiesInTheRegionOfTheOthersFeature) {
  RandomBodies random(62);
  for (int i = 0; i < 1000; ++i) {
    const ConvexPolygon A = randomPolygon(random, 1.0);
    const ConvexPolygon B = randomPolygon(random, 1.0);
    const PlanarPose X_WB{1.0, 0.0, {random.uniform(2.5, 4.0), random.uniform(-4.0, 4.0)}};
    FeaturePair last;
    const ClosestPolygonFeatures c = closestFeatures(A, PlanarPose(), B, X_WB, last);
    ASSERT_EQ(c.status, Proximity::kSeparated);
    for (const VoronoiPlane& plane : A.voronoiPlanes(c.feature_a)) {
      EXPECT_LE(dot(plane.normal, {c.p_WCb.x, c.p_WCb.y, 0.0}) - plane.offset, 1e-13);
    }
    const Vector2 a = c.p_WCa - X_WB.p_AB;
    for (const VoronoiPlane& plane : B.voronoiPlanes(c.feature_b)) {
      EXPECT_LE(dot(plane.normal, {a.x, a.y, 0.0}) - plane.offset, 1e-13);
    }
    EXPECT_EQ(closestFeatures(A, PlanarPose(), B, X_WB, last).steps, 1);
  }
}

/// A box in the plane.
ConvexPolygon boxPolygon(double x, double y) {
  return ConvexPolygon({{-x, -y}, {x, -y}, {x, y}, {-x, y}});
}

// A needle and a box that are parallel but for the last bits: the two walks go round in a circle.
TEST(ClosestPolygonFeatures, AreFoundWhereRoundingHidesTheTilt) {
  const ConvexPolygon A = boxPolygon(0.12127750694535437, 3.4890806805021455e-07);
  const ConvexPolygon B = boxPolygon(0.045380431567683059, 0.0087437578332597472);
  FeaturePair last;
  const ClosestPolygonFeatures c = closestFeatures(
      A, PlanarPose(), B, {1.0, 2.3736576326669561e-13, {0.23448967096431159, 0.0}}, last);
  EXPECT_EQ(c.status, Proximity::kSeparated);
  EXPECT_NEAR(c.distance, 0.23448967096431159 - 0.12127750694535437 - 0.045380431567683059, 1e-14);
  EXPECT_LE(c.excess, 1e-12);
}

// Needles, 1e-6 to 1e6 in size, gaps down to 1e-9 of it, tilts that rounding hides, foreign starts.
TEST(ClosestPolygonFeatures, OfDegenerateBoxesAgreeWithAllPairs) {
  RandomBodies random(63);
  FeaturePair last;
  for (int i = 0; i < 20000; ++i) {
    const auto half = [&] { return std::pow(10.0, random.uniform(-6, 0)); };
    const double unit = std::pow(10.0, random.uniform(-6, 6));
    const ConvexPolygon A = boxPolygon(unit * half(), unit * half());
    const ConvexPolygon B = boxPolygon(unit * half(), unit * half());
    const double reach = A.radius() + B.radius();
    const double tilt = std::pow(10.0, random.uniform(-16, 0));
    PlanarPose X_WB{std::cos(tilt), std::sin(tilt), {}};
    const double gap = reach * std::pow(10.0, random.uniform(-9, 0));
    X_WB.p_AB = i % 2 == 0 ? Vector2{reach + gap, random.uniform(-1, 1) * B.radius()}
                           : Vector2{random.uniform(-1, 1) * A.radius(), reach + gap};
    last.known = true;
    last.a = {i % 3 == 0 ? FeatureKind::kVertex : FeatureKind::kEdge, random.integer(0, 3)};
    last.b = {i % 5 == 0 ? FeatureKind::kVertex : FeatureKind::kEdge, random.integer(0, 3)};
    const ClosestPolygonFeatures c = closestFeatures(A, PlanarPose(), B, X_WB, last);
    Expected expected;
    look(A, PlanarPose(), B, X_WB, expected);
    look(B, X_WB, A, PlanarPose(), expected);
    ASSERT_EQ(c.status, Proximity::kSeparated) << "seed 63, sample " << i;
    ASSERT_NEAR(c.distance, expected.distance, 1e-14 * (reach + length(X_WB.p_AB)))
        << "seed 63, sample " << i;
  }
}

TEST(ClosestPolygonFeatures, OfParallelSquaresAreAnEdgeAndAVertex) {
  const ConvexPolygon square({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  FeaturePair last;
  const ClosestPolygonFeatures c =
      closestFeatures(square, PlanarPose(), square, {1.0, 0.0, {3.0, 0.5}}, last);
  EXPECT_EQ(c.status, Proximity::kSeparated);
  EXPECT_EQ(c.distance, 1.0);
  const ClosestPolygonFeatures touching =
      closestFeatures(square, PlanarPose(), square, {1.0, 0.0, {2.0, 0.5}}, last);
  EXPECT_EQ(touching.status, Proximity::kTouching);
}

}  // namespace
}  // namespace hovercraft
