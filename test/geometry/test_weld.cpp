#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/mesh_edges.h"
#include "hovercraft_sim/geometry/volume_moments.h"
#include "hovercraft_sim/geometry/weld.h"
#include "hovercraft_sim/math/tolerances.h"

#include "../support/sample_meshes.h"

namespace hovercraft {
namespace {

using testing::boxMesh;
using testing::kOne;

/// A unit cube each of whose faces has vertices of its own; the sixth one is moved.
PolygonMesh looseCube(const Vector3& shift) {
  const PolygonMesh cube = boxMesh(Vector3::Zero(), kOne);
  PolygonMesh loose;
  for (std::size_t f = 0; f < cube.faces.size(); f += 2) {
    const int quad[] = {cube.faces[f][0], cube.faces[f][1], cube.faces[f][2], cube.faces[f + 1][2]};
    std::vector<int> face;
    for (const int v : quad) {
      face.push_back(static_cast<int>(loose.vertices.size()));
      const Vector3& p = cube.vertices[static_cast<std::size_t>(v)];
      loose.vertices.emplace_back(f == 10 ? Vector3(p + shift) : p);
    }
    loose.faces.push_back(face);
  }
  return loose;
}

TEST(Weld, EqualPositionsBecomeOneVertexInTheOrderOfUse) {
  const PolygonMesh cube = joinedVertices(looseCube(Vector3::Zero()));
  EXPECT_EQ(cube.vertices.size(), 8U);
  EXPECT_TRUE(openVertices(cube).empty());
  EXPECT_EQ(signedVolume(cube), 1.0);
  int next = 0;
  for (const auto& face : cube.faces) {
    for (const int v : face) {
      EXPECT_LE(v, next);
      if (v == next) ++next;
    }
  }
}

TEST(Weld, ZeroWithEitherSignIsOnePosition) {
  PolygonMesh mesh = {{{0.0, 1.0, 0.0}, {-0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}},
                      {{0, 2, 3}, {1, 3, 2}}};
  EXPECT_EQ(joinedVertices(mesh).vertices.size(), 3U);
}

TEST(Weld, AVertexThatFollowsItselfStandsOnceAndWhatIsNoFaceGoes) {
  const PolygonMesh mesh = {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                            {{0, 0, 1, 2, 2, 3, 0}, {0, 1, 1}, {1, 1, 1}, {0, 1, 0}}};
  const PolygonMesh joined = joinedVertices(mesh);
  ASSERT_EQ(joined.faces.size(), 1U);
  EXPECT_EQ(joined.faces[0], (std::vector<int>{0, 1, 2, 3}));
}

TEST(Weld, NearVerticesAreJoinedWhereThatClosesTheSurface) {
  const double gap = 0.9 * kWeldDistance;
  const auto welded = weldedShut(joinedVertices(looseCube({gap, 0.0, 0.0})));
  ASSERT_TRUE(welded.has_value());
  EXPECT_EQ(welded->mesh.vertices.size(), 8U);
  EXPECT_EQ(welded->joined, 4);
  EXPECT_NEAR(welded->farthest, gap, 1e-15);
  EXPECT_EQ(signedVolume(welded->mesh), 1.0);
}

TEST(Weld, WhatIsFartherApartStaysApart) {
  EXPECT_FALSE(weldedShut(joinedVertices(looseCube({1.1 * kWeldDistance, 0.0, 0.0}))).has_value());
  EXPECT_FALSE(weldedShut(boxMesh(Vector3::Zero(), kOne)).has_value());
}

TEST(Weld, ASurfaceThatStaysOpenIsLeftAlone) {
  PolygonMesh mesh = looseCube({0.5 * kWeldDistance, 0.0, 0.0});
  mesh.faces.erase(mesh.faces.begin());
  EXPECT_FALSE(weldedShut(joinedVertices(mesh)).has_value());
}

// A detail finer than the distance, on a closed shell beside the open one.
TEST(Weld, ClosedEdgesKeepTheirVertices) {
  const PolygonMesh open = joinedVertices(looseCube({0.5 * kWeldDistance, 0.0, 0.0}));
  const Vector3 low(0.0, 0.0, 1.5);
  const PolygonMesh fine = boxMesh(low, low + 0.1 * kWeldDistance * kOne);
  const auto welded = weldedShut(testing::joined(open, fine));
  ASSERT_TRUE(welded.has_value());
  EXPECT_EQ(welded->mesh.vertices.size(), 16U);
}

TEST(Weld, TheDistanceIsOfTheSizeWhereverTheSurfaceIs) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    PolygonMesh cube = looseCube({0.9 * kWeldDistance, 0.0, 0.0});
    for (Vector3& p : cube.vertices) p *= size;
    EXPECT_TRUE(weldedShut(joinedVertices(cube)).has_value()) << size;
  }
  // Far away the surface of a cube without its top stays open.
  PolygonMesh open = looseCube(Vector3::Zero());
  open.faces.erase(open.faces.begin() + 1);
  for (Vector3& p : open.vertices) p.x() += 1e7;
  EXPECT_FALSE(weldedShut(joinedVertices(open)).has_value());
}

}  // namespace
}  // namespace hovercraft
