#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/polygon_mesh.h"
#include "hovercraft_sim/geometry/volume_moments.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/math/tolerances.h"

#include "../support/sample_meshes.h"

namespace hovercraft {
namespace {

using testing::boxMesh;
using testing::joined;
using testing::kOne;
using testing::moved;
using testing::starMesh;
using testing::turnedOver;

PolygonMesh unitCube() {
  return boxMesh(Vector3::Zero(), kOne);
}

std::string messageOfChecking(const PolygonMesh& mesh) {
  try {
    checkClosed(mesh, "mesh");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(PolygonMesh, AnOpenSurfaceIsRefusedWithItsEdges) {
  PolygonMesh cube = unitCube();
  cube.faces.pop_back();
  EXPECT_EQ(messageOfChecking(cube),
            "mesh: not closed: 3 open edges, the first from (1, 0, 0) to (1, 0, 1) m: each edge "
            "must belong to two faces");
  cube.faces.clear();
  EXPECT_EQ(messageOfChecking(cube), "mesh: no faces");
}

// A unit cube at a distance d has the uncertainty 6 m² * d * 5.97e-8 in single precision: 1 % at
// d = 27900 m. In double precision, 1e-15, it is 1.7e12 m.
TEST(PolygonMesh, OneTooFarFromItsOriginIsRefused) {
  const auto cube_at = [](double d, double rounding) {
    PolygonMesh cube = boxMesh({d, 0.0, 0.0}, {d + 1.0, 1.0, 1.0});
    cube.rounding = rounding;
    return messageOfChecking(cube);
  };
  EXPECT_EQ(cube_at(27000.0, kSingleRounding), "no error");
  EXPECT_NE(cube_at(28500.0, kSingleRounding).find("must be known to 1 %"), std::string::npos);
  EXPECT_EQ(cube_at(1.6e12, kDoubleRounding), "no error");
  EXPECT_NE(cube_at(1.8e12, kDoubleRounding).find("must be known to 1 %"), std::string::npos);
}

TEST(PolygonMesh, OneWithoutVolumeIsRefusedHoweverSmall) {
  for (const double size : {1.0, 1e-120}) {
    const Vector3 a(size, 0.0, 0.0);
    const Vector3 b(0.0, size, 0.0);
    const PolygonMesh flat = {{Vector3::Zero(), a, a + b, b}, {{0, 1, 2, 3}, {3, 2, 1, 0}}};
    EXPECT_NE(messageOfChecking(flat).find("mesh: volume = 0 m^3 with an uncertainty of "),
              std::string::npos)
        << messageOfChecking(flat);
  }
}

// Found by the fuzzer of meshes: a polygon that goes there and back closes itself. It has no
// surface, and what is summed as its volume is rounding alone.
TEST(PolygonMesh, OneWhoseVolumeIsRoundingAloneIsRefused) {
  const PolygonMesh folded = {
      {{0.05, 29.38268, 1234.567}, {0.05, 1.4, 1234.567}, {0.15, 1.4, 2345678.34657}},
      {{0, 1, 0, 2}}};
  EXPECT_NE(messageOfChecking(folded).find("must be known to 1 %"), std::string::npos)
      << messageOfChecking(folded);
}

/// Six times the volume of a tetrahedron, in the widest numbers, from differences of vertices.
long double sixVolumes(const std::vector<Vector3>& p) {
  std::array<std::array<long double, 3>, 3> e{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const auto axis = static_cast<Eigen::Index>(j);
      e[i][j] = static_cast<long double>(p[i + 1][axis]) - static_cast<long double>(p[0][axis]);
    }
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) +
         e[0][1] * (e[1][2] * e[2][0] - e[1][0] * e[2][2]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

// Tetrahedra from plump to thinner than rounding, near their middle and far from it: the volume of
// those that pass is known to 1 %.
TEST(PolygonMesh, WhatPassesHasTheVolumeThatIsPromised) {
  std::mt19937 engine(23);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  int passed = 0;
  constexpr int kTetrahedra = 20000;
  for (int n = 0; n < kTetrahedra; ++n) {
    const double thickness = std::pow(10.0, -9.0 + 9.0 * uniform(engine));
    const double width = n % 2 == 0 ? 1.0 : thickness;  // slivers, and needles
    const Vector3 along(uniform(engine), uniform(engine), uniform(engine));
    PolygonMesh mesh = {{}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
    for (int v = 0; v < 4; ++v) {
      mesh.vertices.push_back(uniform(engine) * along +
                              width * uniform(engine) * Vector3(along.y(), -along.x(), 0.0) +
                              thickness * Vector3(uniform(engine), uniform(engine), 0.0));
    }
    if (messageOfChecking(mesh) != "no error") continue;
    ++passed;
    const long double volume = sixVolumes(mesh.vertices) / 6.0L;
    EXPECT_LE(std::abs(static_cast<long double>(signedVolume(mesh)) - volume),
              static_cast<long double>(kMeshVolume) * volume)
        << "sample " << n << ", thickness " << thickness;
  }
  EXPECT_GT(passed, kTetrahedra / 5);
  EXPECT_LT(passed, kTetrahedra / 2);  // half are inside out
}

TEST(PolygonMesh, AVertexThatIsNotFiniteIsRefused) {
  PolygonMesh cube = unitCube();
  cube.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(messageOfChecking(cube), "mesh: vertex 3 is not finite: (1, nan, 0)");
}

TEST(PolygonMesh, AFaceWithoutItsVerticesIsOurOwnBug) {
  PolygonMesh cube = unitCube();
  cube.faces[0][0] = 8;
  EXPECT_THROW(checkClosed(cube, "mesh"), std::logic_error);
  cube = unitCube();
  cube.faces[0].pop_back();
  EXPECT_THROW(checkClosed(cube, "mesh"), std::logic_error);
}

TEST(PolygonMesh, ACavityPassesWhenItsWallFacesInwards) {
  const PolygonMesh outer = boxMesh(-2.0 * kOne, 2.0 * kOne);
  const PolygonMesh wall = boxMesh(-1.0 * kOne, kOne);
  EXPECT_EQ(messageOfChecking(joined(outer, turnedOver(wall))), "no error");
  EXPECT_EQ(messageOfChecking(joined(outer, wall)),
            "mesh: the shell with the vertex (-1, -1, -1) m has the volume 8 m^3 and lies inside "
            "another: a shell must face outwards, the wall of a cavity inwards");
}

TEST(PolygonMesh, ABodyInACavityFacesOutwardsAgain) {
  const PolygonMesh hollow =
      joined(boxMesh(-2.0 * kOne, 2.0 * kOne), turnedOver(boxMesh(-1.0 * kOne, kOne)));
  const PolygonMesh core = boxMesh(-0.5 * kOne, 0.5 * kOne);
  EXPECT_EQ(messageOfChecking(joined(hollow, core)), "no error");
  EXPECT_NE(messageOfChecking(joined(hollow, turnedOver(core))), "no error");
}

// The sum of the volumes is positive, so that only the part by itself shows it.
TEST(PolygonMesh, APartThatIsInsideOutBesideASoundOneIsRefused) {
  const PolygonMesh large = boxMesh(Vector3::Zero(), 2.0 * kOne);
  const PolygonMesh small = boxMesh({3.0, 0.0, 0.0}, {4.0, 1.0, 1.0});
  EXPECT_EQ(messageOfChecking(joined(large, small)), "no error");
  const std::string message = messageOfChecking(joined(large, turnedOver(small)));
  EXPECT_NE(message.find("has the volume -1 m^3 and lies in no other"), std::string::npos)
      << message;
}

/// An L of height 1, [0,3]x[0,1] and [0,1]x[1,2] in the plane, moved: concave hexagons as its ends.
PolygonMesh angle(const Vector3& p) {
  PolygonMesh mesh;
  for (const double z : {0.0, 1.0}) {
    for (const auto& [x, y] : {std::pair{0.0, 0.0}, std::pair{3.0, 0.0}, std::pair{3.0, 1.0},
                               std::pair{1.0, 1.0}, std::pair{1.0, 2.0}, std::pair{0.0, 2.0}}) {
      mesh.vertices.push_back(p + Vector3(x, y, z));
    }
  }
  mesh.faces = {{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
  for (int i = 0; i < 6; ++i) mesh.faces.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i});
  return mesh;
}

// The parts lie in the corner of the L, beside it, and within a cavity of its own shape.
TEST(PolygonMesh, ShellsOfConcavePolygonsAreToldApart) {
  const PolygonMesh outer = angle(Vector3::Zero());
  const PolygonMesh corner = boxMesh({1.25, 1.25, 0.25}, {1.75, 1.75, 0.75});
  const PolygonMesh core = boxMesh({0.25, 0.25, 0.25}, {0.75, 1.75, 0.75});
  for (int turn = 0; turn < 6; ++turn) {
    PolygonMesh turned = outer;
    for (auto& face : turned.faces) {
      std::rotate(face.begin(), face.begin() + turn % static_cast<int>(face.size()), face.end());
    }
    EXPECT_EQ(messageOfChecking(joined(turned, corner)), "no error") << turn;
    EXPECT_NE(messageOfChecking(joined(turned, turnedOver(corner))), "no error") << turn;
    EXPECT_EQ(messageOfChecking(joined(turned, turnedOver(core))), "no error") << turn;
    EXPECT_NE(messageOfChecking(joined(turned, core)), "no error") << turn;
  }
  PolygonMesh hollow = joined(boxMesh({-1.0, -1.0, -1.0}, {4.0, 3.0, 2.0}), turnedOver(outer));
  EXPECT_EQ(messageOfChecking(hollow), "no error");
  EXPECT_EQ(messageOfChecking(joined(hollow, core)), "no error");
  EXPECT_NE(messageOfChecking(joined(hollow, turnedOver(core))), "no error");
}

// 1 um thick, beside a cube: thinner than the depth at which the shells of files are compared.
TEST(PolygonMesh, AFoilThatIsInsideOutIsRefused) {
  const PolygonMesh cube = unitCube();
  const PolygonMesh foil = boxMesh({2.0, 0.0, 0.0}, {3.0, 1.0, 1e-6});
  EXPECT_EQ(messageOfChecking(joined(cube, foil)), "no error");
  EXPECT_NE(messageOfChecking(joined(cube, turnedOver(foil))).find("lies in no other"),
            std::string::npos);
}

TEST(PolygonMesh, MoreShellsThanCanBeComparedAreRefused) {
  PolygonMesh boxes;
  for (std::size_t n = 0; n <= kMostShells; ++n) {
    const Vector3 low(2.0 * static_cast<double>(n), 0.0, 0.0);
    for (const Vector3& p : unitCube().vertices) boxes.vertices.push_back(p + low);
    for (std::vector<int> face : unitCube().faces) {
      for (int& v : face) v += static_cast<int>(8 * n);
      boxes.faces.push_back(face);
    }
  }
  EXPECT_EQ(messageOfChecking(boxes), "mesh: 20001 shells: must be at most 20000");
}

// Turned and rounded as in a file, the common face is not common to the last bit: the parts overlap
// or part there by a rounding.
TEST(PolygonMesh, PartsMayTouch) {
  std::mt19937 engine(13);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  const PolygonMesh large = boxMesh(Vector3::Zero(), 2.0 * kOne);
  const PolygonMesh on_top = boxMesh({0.5, 0.5, 2.0}, {1.5, 1.5, 3.0});
  for (int n = 0; n < 50; ++n) {
    const double roll = angle(engine);
    const double pitch = angle(engine);
    const Matrix3 R = rotationFromRpy({roll, pitch, angle(engine)});
    PolygonMesh both = moved(joined(on_top, large), R, {1.0, 2.0, 3.0});
    for (Vector3& vertex : both.vertices) vertex = vertex.cast<float>().cast<double>();
    EXPECT_EQ(messageOfChecking(both), "no error") << "sample " << n;
  }
}

TEST(PolygonMesh, RandomConcaveBodiesPass) {
  std::mt19937 engine(11);
  for (int n = 0; n < 20; ++n) {
    PolygonMesh star = starMesh(engine);
    EXPECT_EQ(messageOfChecking(star), "no error") << "sample " << n;
    star.faces.erase(star.faces.begin() + n);
    EXPECT_NE(messageOfChecking(star), "no error") << "sample " << n;
  }
}

}  // namespace
}  // namespace hovercraft
