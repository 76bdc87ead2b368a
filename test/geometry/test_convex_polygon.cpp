#include <stdexcept>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/convex_polygon.h"

namespace hovercraft {
namespace {

TEST(ConvexPolygon, RefusesWhatIsNotConvexAndCounterClockwise) {
  EXPECT_THROW(ConvexPolygon({{0, 0}, {1, 0}}), std::invalid_argument);
  EXPECT_THROW(ConvexPolygon({{0, 0}, {0, 1}, {1, 0}}), std::invalid_argument);  // clockwise
  EXPECT_THROW(ConvexPolygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), std::invalid_argument);
  EXPECT_THROW(ConvexPolygon({{0, 0}, {2, 0}, {1, 0.5}, {0, 2}}), std::invalid_argument);
  // A pentagram turns left at every corner and winds around twice.
  EXPECT_THROW(ConvexPolygon({{0, 1}, {-0.6, -0.8}, {0.95, 0.3}, {-0.95, 0.3}, {0.6, -0.8}}),
               std::invalid_argument);
  EXPECT_NO_THROW(ConvexPolygon({{0, 0}, {1, 0}, {0, 1}}));
}

TEST(ConvexPolygon, HullLeavesOutInnerPointsAndPointsOnEdges) {
  const ConvexPolygon hull =
      convexHull(std::vector<Vector2>{{0, 0}, {2, 0}, {1, 0}, {2, 2}, {0, 2}, {1, 1}, {0, 1}});
  EXPECT_EQ(hull.vertexCount(), 4);
  EXPECT_THROW(convexHull(std::vector<Vector2>{{0, 0}, {1, 1}, {2, 2}}), std::invalid_argument);
}

// The source's figure: a vertex owns a cone between two rays, an edge a strip.
TEST(ConvexPolygon, RegionsOfASquareAreConesAndStrips) {
  const ConvexPolygon square({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const auto inside = [&](Feature feature, const Vector3& p) {
    for (const VoronoiPlane& plane : square.voronoiPlanes(feature)) {
      if (dot(plane.normal, p) > plane.offset) return false;
    }
    return true;
  };
  EXPECT_TRUE(inside({FeatureKind::kVertex, 2}, {1.5, 1.2, 0}));
  EXPECT_FALSE(inside({FeatureKind::kVertex, 2}, {0.5, 1.2, 0}));
  EXPECT_TRUE(inside({FeatureKind::kEdge, 2}, {0.5, 1.2, 0}));
  EXPECT_FALSE(inside({FeatureKind::kEdge, 2}, {0.5, 0.8, 0}));
  EXPECT_FALSE(inside({FeatureKind::kEdge, 0}, {0.5, 1.2, 0}));
}

}  // namespace
}  // namespace hovercraft
