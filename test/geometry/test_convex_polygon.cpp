#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/convex_polygon.h"

#include "../support/files.h"

namespace hovercraft {
namespace {

using testing::messageOf;

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

// Points on the sides leave them by rounding, to either side.
TEST(ConvexPolygon, HullTakesTurnedGrids) {
  for (int sample = 0; sample < 2000; ++sample) {
    const double c = std::cos(0.00314 * sample);
    const double s = std::sin(0.00314 * sample);
    std::vector<Vector2> points;
    for (int x = 0; x < 5; ++x) {
      for (int y = 0; y < 5; ++y) points.push_back({c * x - s * y, s * x + c * y});
    }
    ConvexPolygon hull({{0, 0}, {1, 0}, {0, 1}});
    ASSERT_NO_THROW(hull = convexHull(points)) << "sample " << sample;
    for (const Vector2& p : points) {
      for (int i = 0; i < hull.vertexCount(); ++i) {
        EXPECT_GE(cross(hull.edge(i).direction, p - hull.edge(i).p), -1e-14) << "sample " << sample;
      }
    }
  }
}

TEST(ConvexPolygon, SaysWhatIsWrongWithPoints) {
  const double nan = std::nan("");
  const auto has = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  has(messageOf([&] { ConvexPolygon({{nan, 0}, {1, 0}, {0, 1}}); }), "vertex 0 at (nan, 0) m");
  has(messageOf([&] { ConvexPolygon({{0, 0}, {1, 0}, {0, INFINITY}}); }), "vertex 2 at (0, inf) m");
  has(messageOf([&] { ConvexPolygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}}); }), "vertices 1 and 2 are");
  has(messageOf([&] {
        convexHull(std::vector<Vector2>{{0, 0}, {1, 0}, {0, nan}, {1, 1}});
      }),
      "point 2 at (0, nan) m");
  has(messageOf([&] {
        convexHull(std::vector<Vector2>{{0, 0}, {1, 1}, {3, 3}, {2, 2}});
      }),
      "the points lie on one line from (0, 0) to (3, 3)");
  has(messageOf([&] {
        convexHull(std::vector<Vector2>{{0, 0}, {1, 1}, {0, 0}});
      }),
      "2 different points");
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
