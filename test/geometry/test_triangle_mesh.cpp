#include <limits>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/triangle_mesh.h"
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

TriangleMesh unitCube() {
  return boxMesh(Vector3::Zero(), kOne);
}

std::string messageOfLoading(const std::string& path) {
  try {
    loadTriangleMesh(path);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

std::string messageOfChecking(const TriangleMesh& mesh) {
  try {
    checkClosed(mesh, "mesh");
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(TriangleMesh, QuadsOfAnObjFileBecomeTriangles) {
  const TriangleMesh cube = loadTriangleMesh("test/data/cube.obj");
  EXPECT_EQ(cube.vertices.size(), 8U);
  EXPECT_EQ(cube.triangles.size(), 12U);
  EXPECT_EQ(signedVolume(cube), 1.0);
}

// A polygon of n corners makes n - 2 triangles: two hexagons and six quads make 2 * 4 + 6 * 2.
TEST(TriangleMesh, ConcavePolygonsBecomeTriangles) {
  const TriangleMesh shape = loadTriangleMesh("test/data/l_shape.obj");
  EXPECT_EQ(shape.vertices.size(), 12U);
  EXPECT_EQ(shape.triangles.size(), 20U);
  EXPECT_EQ(signedVolume(shape), 2.0);
}

// STL writes the three corners of each triangle: 12 positions, of which 4 differ.
TEST(TriangleMesh, VerticesThatStlRepeatsBecomeOne) {
  const TriangleMesh tetrahedron = loadTriangleMesh("test/data/tetrahedron.stl");
  EXPECT_EQ(tetrahedron.vertices.size(), 4U);
  EXPECT_EQ(tetrahedron.triangles.size(), 4U);
}

TEST(TriangleMesh, ObjectsOfAFileAreJoinedAndAMissingMaterialIsIgnored) {
  const TriangleMesh boxes = loadTriangleMesh("test/data/two_boxes.obj");
  EXPECT_EQ(boxes.vertices.size(), 16U);
  EXPECT_EQ(boxes.triangles.size(), 24U);
  EXPECT_NEAR(signedVolume(boxes), 1.0 + 2.0, 1e-15);
}

// A facet of which two corners coincide lies in an edge: without it the edge's two triangles meet.
TEST(TriangleMesh, TrianglesWithCoincidingCornersAreDropped) {
  const TriangleMesh mesh = loadTriangleMesh("test/data/needle.stl");
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.triangles.size(), 4U);
}

// nodes.dae: the unit cube at (10, 0, 0), twice as large; and below that node, mirrored in x, 5
// (there: 10) higher. Both have the volume 8; the middles are (11, 1, 1) and (9, 1, 11).
TEST(TriangleMesh, TransformsOfNodesAreAppliedAlsoThoseThatMirror) {
  const VolumeMoments moments = volumeMoments(loadTriangleMesh("test/data/nodes.dae"));
  EXPECT_NEAR(moments.volume, 16.0, 1e-14);
  EXPECT_LT(norm(moments.centroid - Vector3(10.0, 1.0, 6.0)), 1e-14);
}

// decimals.obj: a cube from (0.1, 0.7, 1234.567) on, written in three styles.
TEST(TriangleMesh, CoordinatesAreAsExactAsStated) {
  const TriangleMesh mesh = loadTriangleMesh("test/data/decimals.obj");
  const Vector3 low(0.1, 0.7, 1234.567);
  const Vector3 high(0.3, 12.34567, 2345.678);
  for (const Vector3& vertex : mesh.vertices) {
    for (int i = 0; i < 3; ++i) {
      const double exact = vertex(i) < 0.5 * (low(i) + high(i)) ? low(i) : high(i);
      EXPECT_NEAR(vertex(i), exact, kMeshCoordinate * exact);
      EXPECT_NE(vertex(i), exact) << "single precision has no such number";
    }
  }
}

TEST(TriangleMesh, AMissingFileIsNamed) {
  EXPECT_EQ(messageOfLoading("test/data/nowhere.obj"),
            "mesh file 'test/data/nowhere.obj': does not exist or cannot be read");
}

TEST(TriangleMesh, AFileThatIsNoMeshIsNamedInOneLine) {
  for (const char* path : {"test/data/broken.stl", "test/data", "package.xml"}) {
    const std::string message = messageOfLoading(path);
    EXPECT_EQ(message.find("mesh file '" + std::string(path) + "': not a mesh that assimp reads: "),
              0U)
        << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST(TriangleMesh, AFileWithoutFacesHasNoTriangles) {
  EXPECT_EQ(messageOfLoading("test/data/line.obj"), "mesh file 'test/data/line.obj': no triangles");
}

// Without its top the cube has the four open edges of that face.
TEST(TriangleMesh, AnOpenSurfaceIsRefusedWithItsEdges) {
  EXPECT_EQ(messageOfLoading("test/data/open_cube.obj"),
            "mesh file 'test/data/open_cube.obj': not closed: 4 open edges, the first from (1, 0, "
            "1) to (0, 0, 1) m: each edge must belong to two triangles");
  TriangleMesh cube = unitCube();
  cube.triangles.pop_back();
  EXPECT_EQ(messageOfChecking(cube).find("mesh: not closed: 3 open edges, "), 0U)
      << messageOfChecking(cube);
}

TEST(TriangleMesh, AFaceThatIsTurnedOverIsRefused) {
  EXPECT_EQ(messageOfLoading("test/data/twisted_cube.obj"),
            "mesh file 'test/data/twisted_cube.obj': inconsistent orientation: 4 one-way edges, "
            "the first from (0, 1, 1) to (1, 1, 1) m: its two triangles must run through it in "
            "opposite directions");
}

TEST(TriangleMesh, AnEdgeOfFourTrianglesIsRefused) {
  EXPECT_EQ(messageOfLoading("test/data/fin_cube.obj"),
            "mesh file 'test/data/fin_cube.obj': not a simple surface: 1 crowded edge, the first "
            "from (1, 0, 0) to (1, 0, 1) m, which belongs to 4 triangles: each edge must belong to "
            "two");
}

TEST(TriangleMesh, ASurfaceThatIsInsideOutIsRefused) {
  EXPECT_EQ(messageOfLoading("test/data/inside_out_cube.obj"),
            "mesh file 'test/data/inside_out_cube.obj': inside out: its volume is -1 m^3: seen "
            "from outside, the vertices of each face must run counter-clockwise");
}

TEST(TriangleMesh, ASurfaceWithoutVolumeIsRefused) {
  EXPECT_EQ(messageOfLoading("test/data/flat.obj"),
            "mesh file 'test/data/flat.obj': volume = 0 m^3 with an uncertainty of 4e-07 m^3, as "
            "coordinates of 1 m are rounded to 2e-07 of themselves: must be known to 1 %");
}

// A unit cube at a distance d has the uncertainty 6 m² * d * 2e-7: 1 % at d = 8333 m.
TEST(TriangleMesh, AMeshTooFarFromItsOriginIsRefused) {
  const Vector3 near(8000.0, 0.0, 0.0);
  const Vector3 far(8500.0, 0.0, 0.0);
  EXPECT_EQ(messageOfChecking(boxMesh(near, near + kOne)), "no error");
  EXPECT_NE(messageOfChecking(boxMesh(far, far + kOne)).find("must be known to 1 %"),
            std::string::npos);
}

TEST(TriangleMesh, AVertexThatIsNotFiniteIsRefused) {
  TriangleMesh cube = unitCube();
  cube.vertices[3].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(messageOfChecking(cube), "mesh: vertex 3 is not finite: (1, nan, 0)");
}

TEST(TriangleMesh, ATriangleWithoutAVertexIsOurOwnBug) {
  TriangleMesh cube = unitCube();
  cube.triangles[0][0] = 8;
  EXPECT_THROW(checkClosed(cube, "mesh"), std::logic_error);
}

TEST(TriangleMesh, ACavityPassesWhenItsWallFacesInwards) {
  const TriangleMesh outer = boxMesh(-2.0 * kOne, 2.0 * kOne);
  const TriangleMesh wall = boxMesh(-1.0 * kOne, kOne);
  EXPECT_EQ(messageOfChecking(joined(outer, turnedOver(wall))), "no error");
  EXPECT_EQ(messageOfChecking(joined(outer, wall)),
            "mesh: the shell with the vertex (-1, -1, -1) m has the volume 8 m^3 and lies inside "
            "another: a shell must face outwards, the wall of a cavity inwards");
}

TEST(TriangleMesh, ABodyInACavityFacesOutwardsAgain) {
  const TriangleMesh hollow =
      joined(boxMesh(-2.0 * kOne, 2.0 * kOne), turnedOver(boxMesh(-1.0 * kOne, kOne)));
  const TriangleMesh core = boxMesh(-0.5 * kOne, 0.5 * kOne);
  EXPECT_EQ(messageOfChecking(joined(hollow, core)), "no error");
  EXPECT_NE(messageOfChecking(joined(hollow, turnedOver(core))), "no error");
}

// The sum of the volumes is positive, so that only the part by itself shows it.
TEST(TriangleMesh, APartThatIsInsideOutBesideASoundOneIsRefused) {
  const TriangleMesh large = boxMesh(Vector3::Zero(), 2.0 * kOne);
  const TriangleMesh small = boxMesh({3.0, 0.0, 0.0}, {4.0, 1.0, 1.0});
  EXPECT_EQ(messageOfChecking(joined(large, small)), "no error");
  const std::string message = messageOfChecking(joined(large, turnedOver(small)));
  EXPECT_NE(message.find("has the volume -1 m^3 and lies in no other"), std::string::npos)
      << message;
}

// Turned and rounded as in a file, the common face is not common to the last bit: the parts overlap
// or part there by a rounding.
TEST(TriangleMesh, PartsMayTouch) {
  std::mt19937 engine(13);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  const TriangleMesh large = boxMesh(Vector3::Zero(), 2.0 * kOne);
  const TriangleMesh on_top = boxMesh({0.5, 0.5, 2.0}, {1.5, 1.5, 3.0});
  for (int n = 0; n < 50; ++n) {
    const double roll = angle(engine);
    const double pitch = angle(engine);
    const Matrix3 R = rotationFromRpy({roll, pitch, angle(engine)});
    TriangleMesh both = moved(joined(on_top, large), R, {1.0, 2.0, 3.0});
    for (Vector3& vertex : both.vertices) vertex = vertex.cast<float>().cast<double>();
    EXPECT_EQ(messageOfChecking(both), "no error") << "sample " << n;
  }
}

TEST(TriangleMesh, RandomConcaveBodiesPass) {
  std::mt19937 engine(11);
  for (int n = 0; n < 20; ++n) {
    TriangleMesh star = starMesh(engine);
    EXPECT_EQ(messageOfChecking(star), "no error") << "sample " << n;
    star.triangles.erase(star.triangles.begin() + n);
    EXPECT_NE(messageOfChecking(star), "no error") << "sample " << n;
  }
}

}  // namespace
}  // namespace hovercraft
