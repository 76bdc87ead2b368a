#include <random>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/shells.h"
#include "hovercraft_sim/geometry/volume_moments.h"

#include "../support/sample_meshes.h"

namespace hovercraft {
namespace {

using testing::boxMesh;
using testing::joined;
using testing::kOne;
using testing::starMesh;
using testing::tetrahedronMesh;
using testing::turnedOver;

TEST(Shells, PartsComeBackInTheOrderOfTheirFirstTriangles) {
  const TriangleMesh a = boxMesh(Vector3::Zero(), kOne);
  const TriangleMesh b = boxMesh({2.0, 0.0, 0.0}, {5.0, 1.0, 1.0});
  const std::vector<TriangleMesh> shells = shellsOf(joined(a, b));
  ASSERT_EQ(shells.size(), 2U);
  EXPECT_EQ(shells[0].triangles.size(), 12U);
  EXPECT_EQ(shells[0].vertices.size(), 8U);
  EXPECT_NEAR(signedVolume(shells[0]), 1.0, 1e-15);
  EXPECT_NEAR(signedVolume(shells[1]), 3.0, 1e-15);
}

TEST(Shells, AConnectedMeshIsOneShell) {
  std::mt19937 engine(3);
  EXPECT_EQ(shellsOf(starMesh(engine)).size(), 1U);
}

// The sides 0-1 and 2-3 come first in two triangles each: the others must join them as well.
TEST(Shells, EverySideOfATriangleJoins) {
  TriangleMesh mesh = tetrahedronMesh({Vector3(0.0, 0.0, 0.0), Vector3(1.0, 0.0, 0.0),
                                       Vector3(0.0, 1.0, 0.0), Vector3(0.0, 0.0, 1.0)});
  mesh.triangles = {{1, 0, 2}, {0, 1, 3}, {2, 3, 1}, {3, 2, 0}};
  EXPECT_EQ(shellsOf(mesh).size(), 1U);
}

TEST(Shells, WindingNumberIsOneInsideZeroOutsideAndAHalfOnAFace) {
  const TriangleMesh cube = boxMesh(Vector3::Zero(), kOne);
  EXPECT_NEAR(windingNumber(cube, {0.2, 0.9, 0.5}), 1.0, 1e-15);
  EXPECT_NEAR(windingNumber(cube, {0.2, 1.1, 0.5}), 0.0, 1e-15);
  EXPECT_NEAR(windingNumber(cube, {0.2, 0.3, 1.0}), 0.5, 1e-15);
  EXPECT_NEAR(windingNumber(turnedOver(cube), {0.2, 0.9, 0.5}), -1.0, 1e-15);
}

// The origin sees the whole surface of a star-shaped body; no point beyond 1.5 is inside.
TEST(Shells, WindingNumberOfAConcaveBody) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int n = 0; n < 50; ++n) {
    const TriangleMesh star = starMesh(engine);
    const Vector3 direction(number(engine), number(engine), number(engine));
    const Vector3 unit = direction / norm(direction);
    EXPECT_NEAR(windingNumber(star, 0.2 * unit), 1.0, 1e-13) << "sample " << n;
    EXPECT_NEAR(windingNumber(star, 1.6 * unit), 0.0, 1e-13) << "sample " << n;
  }
}

}  // namespace
}  // namespace hovercraft
