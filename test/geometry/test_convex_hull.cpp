#include <array>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/convex_hull.h"

#include "../collision/random_bodies.h"

namespace hovercraft {
namespace {

// A grid of 5^3 points of a turned cube: eight corners, six square faces.
TEST(ConvexHull, MergesCoplanarFacetsAndLeavesOutPointsOnThem) {
  RandomBodies random(11);
  for (int sample = 0; sample < 20; ++sample) {
    const Matrix3 R = rotationMatrix(random.orientation());
    std::vector<Vector3> points;
    points.reserve(125);
    for (int x = 0; x < 5; ++x) {
      for (int y = 0; y < 5; ++y) {
        for (int z = 0; z < 5; ++z) points.push_back(times(R, Vector3(x, y, z)));
      }
    }
    const ConvexPolyhedron hull = convexHull(points, "grid");
    EXPECT_EQ(hull.vertexCount(), 8);
    EXPECT_EQ(hull.edgeCount(), 12);
    EXPECT_EQ(hull.faceCount(), 6);
  }
}

TEST(ConvexHull, HoldsEveryPointAndKeepsTheirOrder) {
  RandomBodies random(12);
  for (int sample = 0; sample < 30; ++sample) {
    std::vector<Vector3> points;
    points.reserve(100);
    for (int i = 0; i < 100; ++i) points.push_back(random.uniform(0.1, 1.0) * random.unitVector());
    const ConvexPolyhedron hull = convexHull(points, "cloud");
    for (const Vector3& p : points) {
      for (int f = 0; f < hull.faceCount(); ++f) {
        EXPECT_LE(dot(hull.face(f).normal, p) - hull.face(f).offset, 1e-14);
      }
    }
    std::size_t next = 0;
    for (int v = 0; v < hull.vertexCount(); ++v) {
      while (next < points.size() && points[next] != hull.vertex(v)) ++next;
      EXPECT_LT(next, points.size());
    }
  }
}

TEST(ConvexHull, RefusesPointsWithoutVolume) {
  EXPECT_THROW(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "few"), std::invalid_argument);
  EXPECT_THROW(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}}, "flat"),
               std::invalid_argument);
  EXPECT_THROW(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}, "nan"),
               std::invalid_argument);
}

TEST(PolyhedronFromMesh, MergesTheTrianglesOfACube) {
  const TriangleMesh mesh = loadTriangleMesh("test/data/cube.obj");
  const ConvexPolyhedron cube = polyhedronFromMesh(mesh, NonConvexMesh::kRefuse, "cube");
  EXPECT_EQ(cube.vertexCount(), 8);
  EXPECT_EQ(cube.faceCount(), 6);
}

TEST(PolyhedronFromMesh, RefusesANonConvexMeshOrTakesItsHull) {
  const TriangleMesh mesh = loadTriangleMesh("test/data/l_shape.obj");
  try {
    polyhedronFromMesh(mesh, NonConvexMesh::kRefuse, "l_shape");
    FAIL() << "an L was taken for convex";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("l_shape: is not convex: vertex "), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("hull: true"), std::string::npos);
  }
  EXPECT_GE(polyhedronFromMesh(mesh, NonConvexMesh::kTakeHull, "l_shape").vertexCount(), 8);
  EXPECT_THROW(polyhedronFromMesh(loadTriangleMesh("test/data/two_boxes.obj"),
                                  NonConvexMesh::kRefuse, "two boxes"),
               std::invalid_argument);
}

}  // namespace
}  // namespace hovercraft
