#include <cmath>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"

#include "../collision/random_bodies.h"

namespace hovercraft {
namespace {

using Rings = std::vector<std::vector<std::int32_t>>;

const std::vector<Vector3> kCubeVertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                            {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
const Rings kCubeRings = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                          {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

std::string refusal(const std::vector<Vector3>& vertices, const Rings& rings) {
  try {
    const ConvexPolyhedron body(vertices, rings);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

void expectRefused(const std::vector<Vector3>& vertices, const Rings& rings, const char* word) {
  const std::string message = refusal(vertices, rings);
  EXPECT_NE(message.find(word), std::string::npos) << "'" << message << "' lacks '" << word << "'";
}

TEST(ConvexPolyhedron, OfACubeHasItsFeatures) {
  const ConvexPolyhedron cube(kCubeVertices, kCubeRings);
  EXPECT_EQ(cube.vertexCount(), 8);
  EXPECT_EQ(cube.edgeCount(), 12);
  EXPECT_EQ(cube.faceCount(), 6);
  EXPECT_EQ(cube.verticesOf({FeatureKind::kFace, 1}), (std::vector<std::int32_t>{4, 5, 6, 7}));
  for (int v = 0; v < 8; ++v) {
    EXPECT_EQ(cube.voronoiPlanes({FeatureKind::kVertex, v}).size(), 3U);
  }
}

TEST(ConvexPolyhedron, RefusesWhatIsNotAClosedConvexSurface) {
  Rings open = kCubeRings;
  open.pop_back();
  expectRefused(kCubeVertices, open, "two faces");
  Rings turned = kCubeRings;
  turned[2] = {4, 5, 1, 0};
  expectRefused(kCubeVertices, turned, "opposite directions");
  Rings inside_out = kCubeRings;
  for (auto& ring : inside_out) ring = {ring[3], ring[2], ring[1], ring[0]};
  expectRefused(kCubeVertices, inside_out, "outward");
  Rings missing = kCubeRings;
  missing[0][1] = 8;
  expectRefused(kCubeVertices, missing, "names vertex 8 of 8");
  std::vector<Vector3> twice = kCubeVertices;
  twice[6] = twice[2];
  expectRefused(twice, kCubeRings, "vertices 2 and 6");
  std::vector<Vector3> infinite = kCubeVertices;
  infinite[3].x() = std::nan("");
  expectRefused(infinite, kCubeRings, "vertex 3 is not finite");
  std::vector<Vector3> bent = kCubeVertices;
  bent[6].z() = 1.1;
  expectRefused(bent, kCubeRings, "face 1 is not plane: vertex ");
  expectRefused(bent, kCubeRings, " m from its plane, at most ");
  expectRefused({kCubeVertices[0]}, {}, "at least 4");
}

TEST(ConvexPolyhedron, RefusesAFlatBodyOfManyVertices) {
  std::vector<Vector3> circle;
  Rings both(2);
  for (int i = 0; i < 300; ++i) {
    const double angle = 0.02 * i;
    circle.emplace_back(std::cos(angle), std::sin(angle), 0.5);
    both[0].push_back(i);
    both[1].push_back(299 - i);
  }
  expectRefused(circle, both, "the body is flat: no vertex lies more than ");
}

// A prism whose long side is bent inward at vertex 1, by 0.1 m over 1 m: the line from vertex 0 to
// 1 passes vertex 2 at 0.2 / sqrt(1.01) m.
TEST(ConvexPolyhedron, RefusesAFaceThatIsNotAConvexPolygonAndSaysByHowMuch) {
  std::vector<Vector3> vertices;
  for (const double z : {1.0, 0.0}) {
    for (const Vector3& p : {Vector3(0, 0, z), Vector3(1, 0.1, z), Vector3(2, 0, z),
                             Vector3(2, 2, z), Vector3(0, 2, z)}) {
      vertices.push_back(p);
    }
  }
  Rings rings = {{0, 1, 2, 3, 4}, {9, 8, 7, 6, 5}};
  for (std::int32_t i = 0; i < 5; ++i) rings.push_back({5 + i, 5 + (i + 1) % 5, (i + 1) % 5, i});
  expectRefused(vertices, rings, "face 0 is not a convex polygon: vertex ");
  expectRefused(vertices, rings, " lies 0.19900743");
  expectRefused(vertices, rings, " m beyond its side between vertices ");
}

TEST(ConvexPolyhedron, NeighboursOfALargeOneLieNearEachOtherInMemory) {
  RandomBodies random(5);
  const ConvexPolyhedron body = random.ellipsoidHull(2000, {1.0, 0.7, 0.4});
  // Of all vertices; in the order in which random points came it would be a third of the array.
  double apart = 0.0;
  for (const auto& vertex : body.data().vertices) {
    const std::int32_t fan_end = vertex.fan_begin + vertex.fan_count;
    for (std::int32_t i = vertex.fan_begin; i < fan_end; ++i) {
      const std::int32_t half = body.data().fan_edge[static_cast<std::size_t>(i)];
      const std::int32_t other = body.data().fan_vertex[static_cast<std::size_t>(i)];
      ASSERT_EQ(other, body.edge(half / 2).vertex[1 - half % 2]);
      const auto& end = body.data().vertices[static_cast<std::size_t>(other)];
      apart += std::abs(end.fan_begin - vertex.fan_begin);
    }
  }
  const auto fan = static_cast<double>(body.data().fan.size());
  EXPECT_LT(apart / fan, 0.1 * fan);
}

/// Corners of a body, turned.
std::vector<Vector3> turned(std::vector<Vector3> points, RandomBodies& random) {
  const Matrix3 R = rotationMatrix(random.orientation());
  for (Vector3& p : points) p = times(R, p);
  return points;
}

// In double the normal of a side of width e is off by 1e-16 / e, over the length 1 of the body far
// more than the slack of 1e-13.
TEST(ConvexPolyhedron, TakesTurnedNeedlesAndSheets) {
  RandomBodies random(21);
  for (const double e : {1e-3, 1e-5, 1e-6, 1e-7}) {
    for (int sample = 0; sample < 50; ++sample) {
      EXPECT_EQ(refusal(turned({{0, 0, 0}, {1, 0, 0}, {0.5, e, 0}, {0.5, 0, e}}, random),
                        {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}),
                "")
          << "e " << e << ", sample " << sample;
      for (const Vector3& size : {Vector3(1, e, e), Vector3(1, 1, e)}) {
        std::vector<Vector3> box = kCubeVertices;
        for (Vector3& p : box) p = p.cwiseProduct(size);
        EXPECT_EQ(refusal(turned(box, random), kCubeRings), "")
            << "size " << size.transpose() << ", sample " << sample;
      }
    }
  }
}

// A cube whose top is a pit: the bottom of the pit is vertex 8. From (0.5, 0.5, 0.75) each wall
// rises to its own edge at z = 1, with the normal (0, 1, 2) / sqrt(5) and the like; the farthest
// vertices are those of the edge opposite, 1 / sqrt(5) m outside.
TEST(ConvexPolyhedron, NamesTheWorstVertexOfADent) {
  std::vector<Vector3> vertices = kCubeVertices;
  vertices.emplace_back(0.5, 0.5, 0.75);
  Rings rings = kCubeRings;
  rings.erase(rings.begin() + 1);
  for (const auto& side : {std::array<int, 2>{4, 5}, {5, 6}, {6, 7}, {7, 4}}) {
    rings.push_back({side[0], side[1], 8});
  }
  const std::string message = refusal(vertices, rings);
  EXPECT_NE(message.find("is not convex: vertex 6 at (1, 1, 1) lies 0.447213595"),
            std::string::npos)
      << message;
}

// Points on either side of a plane fall into different regions, and the feature behind the plane
// has the same plane from its side.
TEST(ConvexPolyhedron, NeighbouringVoronoiRegionsShareTheirPlane) {
  RandomBodies random(3);
  const ConvexPolyhedron body = random.ellipsoidHull(40, {1.0, 0.6, 0.3});
  int planes = 0;
  const auto check = [&](Feature feature) {
    for (const VoronoiPlane& plane : body.voronoiPlanes(feature)) {
      EXPECT_NEAR(norm(plane.normal), 1.0, 1e-15);
      if (!plane.behind) continue;
      ++planes;
      bool found = false;
      for (const VoronoiPlane& other : body.voronoiPlanes(*plane.behind)) {
        found = found || (other.behind == feature && norm(other.normal + plane.normal) < 1e-14 &&
                          std::abs(other.offset + plane.offset) < 1e-14);
      }
      EXPECT_TRUE(found);
    }
  };
  for (int i = 0; i < body.vertexCount(); ++i) check({FeatureKind::kVertex, i});
  for (int i = 0; i < body.edgeCount(); ++i) check({FeatureKind::kEdge, i});
  for (int i = 0; i < body.faceCount(); ++i) check({FeatureKind::kFace, i});
  EXPECT_EQ(planes, 8 * body.edgeCount());  // four boundaries at each edge, from both sides
}

TEST(ConvexPolyhedron, SupportVertexIsTheFarthestOfAll) {
  RandomBodies random(4);
  for (const int n : {4, 10, 100, 1000}) {
    const ConvexPolyhedron body = random.ellipsoidHull(n, {1.0, 0.6, 0.3});
    for (int i = 0; i < 300; ++i) {
      const Vector3 direction = random.unitVector();
      double farthest = -1e300;
      for (int v = 0; v < n; ++v) farthest = std::max(farthest, dot(body.vertex(v), direction));
      EXPECT_EQ(dot(body.vertex(body.supportVertex(direction)), direction), farthest);
      EXPECT_EQ(dot(body.vertex(body.supportVertexFrom(0, direction)), direction), farthest);
    }
  }
}

TEST(ConvexPolyhedron, TakesLessThanOneKibibyteAVertex) {
  RandomBodies random(6);
  for (const int n : {128, 8192}) {
    const ConvexPolyhedron body = random.ellipsoidHull(n, {1.0, 0.7, 0.4});
    EXPECT_LE(body.memory(), 1024U * static_cast<unsigned>(n));
  }
}

TEST(PolyhedronShapes, HaveTheirFeaturesAndRefuseBadSizes) {
  const ConvexPolyhedron box = boxPolyhedron(Vector3(1, 2, 4));
  EXPECT_EQ(box.faceCount(), 6);
  EXPECT_EQ(box.vertex(box.supportVertex(Vector3(1, 1, 1))), Vector3(0.5, 1, 2));
  const ConvexPolyhedron cylinder = cylinderPolyhedron(2.0, 3.0, 12);
  EXPECT_EQ(cylinder.vertexCount(), 24);
  EXPECT_EQ(cylinder.edgeCount(), 36);
  EXPECT_EQ(cylinder.faceCount(), 14);
  EXPECT_THROW(boxPolyhedron(Vector3(1, 0, 1)), std::invalid_argument);
  EXPECT_THROW(cylinderPolyhedron(1.0, 1.0, 2), std::invalid_argument);
  EXPECT_THROW(cylinderPolyhedron(-1.0, 1.0, 8), std::invalid_argument);
}

}  // namespace
}  // namespace hovercraft
