#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/geometry/mesh_file.h"

#include "../collision/random_bodies.h"
#include "../support/files.h"

namespace hovercraft {
namespace {

/// Numbers the corners of the squares that the faces of a cube are cut into.
class CubeGrid {
 public:
  explicit CubeGrid(int n) : n_(n) {}

  /// The vertex at the place i, j of the face across an axis.
  int corner(std::size_t axis, bool top, int i, int j) {
    std::array<int, 3> cell{};
    cell[axis] = top ? n_ : 0;
    cell[(axis + 1) % 3] = top ? i : j;  // the other way round seen from outside
    cell[(axis + 2) % 3] = top ? j : i;
    const auto [entry, is_new] = indices_.try_emplace(cell, static_cast<int>(vertices_.size()));
    if (is_new) {
      vertices_.emplace_back(Vector3(cell[0], cell[1], cell[2]) / n_ - Vector3(0.5, 0.5, 0.5));
    }
    return entry->second;
  }
  const std::vector<Vector3>& vertices() const { return vertices_; }

 private:
  int n_;
  std::map<std::array<int, 3>, int> indices_;
  std::vector<Vector3> vertices_;
};

/// The unit cube around the origin, each face of n x n squares of two triangles.
PolygonMesh tessellatedCube(int n) {
  PolygonMesh mesh;
  CubeGrid grid(n);
  for (int square = 0; square < 6 * n * n; ++square) {
    const auto axis = static_cast<std::size_t>(square / (2 * n * n));
    const bool top = square / (n * n) % 2 == 1;
    const int i = square / n % n;
    const int j = square % n;
    const int a = grid.corner(axis, top, i, j);
    const int b = grid.corner(axis, top, i + 1, j);
    const int c = grid.corner(axis, top, i + 1, j + 1);
    const int d = grid.corner(axis, top, i, j + 1);
    mesh.faces.push_back({a, b, c});
    mesh.faces.push_back({a, c, d});
  }
  mesh.vertices = grid.vertices();
  return mesh;
}

// Whatever order qhull finds them in: it is another one on processors that fuse multiply and add.
TEST(ConvexHull, FacesAreInTheOrderOfTheirVertices) {
  RandomBodies random(17);
  const ConvexPolyhedron hull = random.ellipsoidHull(60, {1.0, 0.7, 0.4});
  std::vector<std::int32_t> before;
  for (int f = 0; f < hull.faceCount(); ++f) {
    const std::vector<std::int32_t> ring = hull.verticesOf({FeatureKind::kFace, f});
    EXPECT_EQ(ring.front(), *std::min_element(ring.begin(), ring.end()));
    EXPECT_LT(before, ring);
    before = ring;
  }
}

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

// Noise leaves slivers between the points of an edge, and near 1e-14 facets that qhull does not
// merge although their points have no plane of their own.
TEST(ConvexHull, TakesNoisyGridsOnATurnedCube) {
  RandomBodies random(13);
  for (const double noise : {5e-15, 1e-14, 1e-13, 1e-12, 1e-10, 1e-7}) {
    for (int sample = 0; sample < 40; ++sample) {
      const Matrix3 R = rotationMatrix(random.orientation());
      std::vector<Vector3> points = tessellatedCube(5).vertices;
      for (Vector3& p : points)
        p = times(R, p) + random.uniform(-noise, noise) * random.unitVector();
      EXPECT_NO_THROW({
        const ConvexPolyhedron hull = convexHull(points, "grid");
        for (const Vector3& p : points) {
          for (int f = 0; f < hull.faceCount(); ++f) {
            EXPECT_LE(dot(hull.face(f).normal, p) - hull.face(f).offset, 1e-13);
          }
        }
      }) << "noise "
         << noise << ", sample " << sample;
    }
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
  const PolygonMesh mesh = loadClosedMesh("test/data/cube.obj").mesh;
  const ConvexPolyhedron cube = polyhedronFromMesh(mesh, NonConvexMesh::kRefuse, "cube");
  EXPECT_EQ(cube.vertexCount(), 8);
  EXPECT_EQ(cube.faceCount(), 6);
}

// As an OBJ of six decimals keeps it.
TEST(PolyhedronFromMesh, TakesATurnedTessellatedCubeOfSixDecimals) {
  RandomBodies random(14);
  for (const int n : {1, 6, 12}) {
    for (int sample = 0; sample < 20; ++sample) {
      const Matrix3 R = rotationMatrix(random.orientation());
      PolygonMesh mesh = tessellatedCube(n);
      for (Vector3& p : mesh.vertices) {
        p = times(R, p);
        for (int axis = 0; axis < 3; ++axis) {
          p[axis] = static_cast<float>(std::round(1e6 * p[axis]) / 1e6);
        }
      }
      EXPECT_NO_THROW(polyhedronFromMesh(mesh, NonConvexMesh::kRefuse, "cube"))
          << n << " squares, sample " << sample;
    }
  }
}

/// The tessellated cube with one inner vertex of its top (the one that is nearest its middle)
/// moved to a height.
PolygonMesh dented(int n, double z) {
  PolygonMesh mesh = tessellatedCube(n);
  const auto squared = [](const Vector3& p) { return squaredNorm(p - Vector3(0, 0, 0.5)); };
  auto nearest = mesh.vertices.begin();
  for (auto p = mesh.vertices.begin(); p != mesh.vertices.end(); ++p) {
    if (squared(*p) < squared(*nearest)) nearest = p;
  }
  nearest->z() = z;
  return mesh;
}

/// The unit cube with a pit in the middle of its top, 2 mm wide and 0.8 m deep.
PolygonMesh cubeWithAPit() {
  PolygonMesh mesh = tessellatedCube(1);
  std::array<int, 4> corners{};  // of the top, counter-clockwise
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vector3& p = mesh.vertices[v];
    if (p.z() < 0.0) continue;
    const std::size_t quarter = p.y() < 0.0 ? (p.x() < 0.0 ? 0 : 1) : (p.x() < 0.0 ? 3 : 2);
    corners[quarter] = static_cast<int>(v);
  }
  const auto in_top = [&](int v) { return mesh.vertices[static_cast<std::size_t>(v)].z() > 0.0; };
  auto& triangles = mesh.faces;
  triangles.erase(
      std::remove_if(triangles.begin(), triangles.end(),
                     [&](const auto& t) { return in_top(t[0]) && in_top(t[1]) && in_top(t[2]); }),
      triangles.end());
  mesh.vertices.insert(mesh.vertices.end(), {{-1e-3, -1e-3, 0.5},
                                             {1e-3, -1e-3, 0.5},
                                             {1e-3, 1e-3, 0.5},
                                             {-1e-3, 1e-3, 0.5},
                                             {0.0, 0.0, -0.3}});
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    const int a = corners[static_cast<std::size_t>(i)];
    const int b = corners[static_cast<std::size_t>(next)];
    triangles.push_back({a, b, 8 + next});
    triangles.push_back({a, 8 + next, 8 + i});
    triangles.push_back({8 + i, 8 + next, 12});
  }
  return mesh;
}

// The pit takes 0.8 * 4e-6 / 3 = 1.1e-6 m^3, which 2e-7 m over the surface of the cube would: less
// than the rounding of a mesh file. A dent of one vertex is rounding up to kMeshDentDepth of the
// greatest coordinate, 2e-6 m here.
TEST(PolyhedronFromMesh, RefusesADeepNarrowDent) {
  const auto message = [](const PolygonMesh& mesh) -> std::string {
    EXPECT_NO_THROW(checkClosed(mesh, "mesh"));
    return testing::messageOf([&] { polyhedronFromMesh(mesh, NonConvexMesh::kRefuse, "pit"); });
  };
  EXPECT_NE(message(cubeWithAPit()).find("is not convex: vertex "), std::string::npos);
  EXPECT_NE(message(dented(40, 0.5 - 1e-5)).find("is not convex: vertex "), std::string::npos);
  EXPECT_EQ(message(dented(40, 0.5 - 1e-6)), "nothing was thrown");
  EXPECT_EQ(message(dented(40, 0.5)), "nothing was thrown");
  // A groove of 1 mm along an edge of the cube: all its vertices are on the surface of the hull.
  const double g = 0.5 - 1e-3;
  PolygonMesh groove;
  for (const double x : {-0.5, 0.5}) {
    for (const auto& yz : std::vector<std::array<double, 2>>{
             {-0.5, -0.5}, {0.5, -0.5}, {0.5, g}, {g, g}, {g, 0.5}, {-0.5, 0.5}}) {
      groove.vertices.emplace_back(x, yz[0], yz[1]);
    }
  }
  for (int i = 0; i < 6; ++i) {
    const int next = (i + 1) % 6;
    groove.faces.push_back({i, next, 6 + next});
    groove.faces.push_back({i, 6 + next, 6 + i});
  }
  for (const int i : {0, 1, 4, 5}) {  // from the inner corner, which sees all others
    const int next = (i + 1) % 6;
    groove.faces.push_back({3, next, i});
    groove.faces.push_back({9, 6 + i, 6 + next});
  }
  EXPECT_NE(message(groove).find("is not convex: vertex "), std::string::npos);
}

TEST(PolyhedronFromMesh, RefusesANonConvexMeshOrTakesItsHull) {
  const PolygonMesh mesh = loadClosedMesh("test/data/l_shape.obj").mesh;
  try {
    polyhedronFromMesh(mesh, NonConvexMesh::kRefuse, "l_shape");
    FAIL() << "an L was taken for convex";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("l_shape: is not convex: vertex "), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("hull: true"), std::string::npos);
  }
  EXPECT_GE(polyhedronFromMesh(mesh, NonConvexMesh::kTakeHull, "l_shape").vertexCount(), 8);
  EXPECT_THROW(polyhedronFromMesh(loadClosedMesh("test/data/two_boxes.obj").mesh,
                                  NonConvexMesh::kRefuse, "two boxes"),
               std::invalid_argument);
}

}  // namespace
}  // namespace hovercraft
