#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <random>
#include <string>
#include <sys/stat.h>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/geometry/volume_moments.h"
#include "hovercraft_sim/math/parse_number.h"

#include "../support/mesh_files.h"
#include "../support/sample_meshes.h"

namespace hovercraft {
namespace {

using testing::boxMesh;
using testing::contentOf;
using testing::messageOf;
using testing::objText;
using testing::stlBytes;
using testing::TestFolder;

std::string messageOfLoading(const std::string& path) {
  return messageOf([&] { loadClosedMesh(path); });
}

LoadedMesh parsedObj(const PolygonMesh& mesh) {
  return parseClosedMesh(objText(mesh), MeshFormat::kObj, Vector3::Ones(), "it");
}

TEST(MeshFile, PolygonsOfAnObjFileStayPolygons) {
  const PolygonMesh cube = loadClosedMesh("test/data/cube.obj").mesh;
  EXPECT_EQ(cube.vertices.size(), 8U);
  EXPECT_EQ(cube.faces.size(), 6U);
  EXPECT_EQ(signedVolume(cube), 1.0);
}

TEST(MeshFile, PolygonsMayBeConcave) {
  const PolygonMesh shape = loadClosedMesh("test/data/l_shape.obj").mesh;
  EXPECT_EQ(shape.vertices.size(), 12U);
  EXPECT_EQ(shape.faces.size(), 8U);
  EXPECT_EQ(signedVolume(shape), 2.0);
}

// STL writes the three corners of each triangle: 12 positions, of which 4 differ.
TEST(MeshFile, VerticesThatStlRepeatsBecomeOne) {
  const PolygonMesh tetrahedron = loadClosedMesh("test/data/tetrahedron.stl").mesh;
  EXPECT_EQ(tetrahedron.vertices.size(), 4U);
  EXPECT_EQ(tetrahedron.faces.size(), 4U);
}

TEST(MeshFile, ObjectsAreJoinedAndAMissingMaterialIsIgnored) {
  const PolygonMesh boxes = loadClosedMesh("test/data/two_boxes.obj").mesh;
  EXPECT_EQ(boxes.vertices.size(), 16U);
  EXPECT_EQ(boxes.faces.size(), 12U);
  EXPECT_NEAR(signedVolume(boxes), 1.0 + 2.0, 1e-15);
}

// A facet of which two corners coincide lies in an edge: without it the edge's two triangles meet.
TEST(MeshFile, TrianglesWithCoincidingCornersAreDropped) {
  const PolygonMesh mesh = loadClosedMesh("test/data/needle.stl").mesh;
  EXPECT_EQ(mesh.vertices.size(), 4U);
  EXPECT_EQ(mesh.faces.size(), 4U);
}

// decimals.obj: a box from (0.1, 0.7, 1234.567) to (0.3, 12.34567, 2345.678), in three styles.
TEST(MeshFile, CoordinatesAreTheNearestDoubles) {
  const PolygonMesh mesh = loadClosedMesh("test/data/decimals.obj").mesh;
  const Vector3 low(0.1, 0.7, 1234.567);
  const Vector3 high(0.3, 12.34567, 2345.678);
  for (const Vector3& vertex : mesh.vertices) {
    for (int i = 0; i < 3; ++i) EXPECT_TRUE(vertex(i) == low(i) || vertex(i) == high(i));
  }
  EXPECT_NEAR(signedVolume(mesh), 0.2 * 11.64567 * 1111.111, 1e-11);
}

TEST(MeshFile, ABodyThatIsWrittenAndReadHasTheSameMomentsToTheLastBit) {
  std::mt19937 engine(17);
  for (int n = 0; n < 20; ++n) {
    const PolygonMesh star = testing::starMesh(engine);
    const VolumeMoments written = volumeMoments(star);
    const VolumeMoments read = volumeMoments(parsedObj(star).mesh);
    EXPECT_EQ(read.volume, written.volume) << "sample " << n;
    EXPECT_EQ(read.centroid, written.centroid) << "sample " << n;
    EXPECT_EQ(read.second_about_centroid, written.second_about_centroid) << "sample " << n;
  }
}

double rounded5(double x) {
  return std::round(x * 1e5) / 1e5;
}

/// A unit cube whose side y = 1 is cut at x = round5(1 - i/14), i = 1 to 13, with single polygons
/// as its ends; their rings begin at vertex `first`.
PolygonMesh cutPrism(int first) {
  PolygonMesh prism;
  std::vector<Vector3> outline = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  for (int i = 1; i <= 13; ++i) outline.emplace_back(rounded5(1.0 - i / 14.0), 1.0, 0.0);
  outline.emplace_back(0.0, 1.0, 0.0);
  const auto count = static_cast<int>(outline.size());
  prism.vertices = outline;
  for (const Vector3& p : outline) prism.vertices.emplace_back(p.x(), p.y(), 1.0);
  std::vector<int> low;
  std::vector<int> high;
  for (int i = 0; i < count; ++i) {
    low.push_back((first + count - i) % count);
    high.push_back(count + (first + i) % count);
    prism.faces.push_back({i, (i + 1) % count, count + (i + 1) % count, count + i});
  }
  prism.faces.push_back(low);
  prism.faces.push_back(high);
  return prism;
}

// A cube of 1 m³: 1/12 of it about each axis of its middle.
TEST(MeshFile, CollinearVerticesOfAPolygonLeaveItClosed) {
  for (int first = 0; first < 17; ++first) {
    const LoadedMesh loaded = parsedObj(cutPrism(first));
    EXPECT_TRUE(loaded.notes.empty());
    const VolumeMoments moments = volumeMoments(loaded.mesh);
    EXPECT_NEAR(moments.volume, 1.0, 1e-15) << first;
    EXPECT_LT(norm(moments.centroid - Vector3(0.5, 0.5, 0.5)), 1e-15) << first;
    const Matrix3 error = moments.second_about_centroid - Matrix3::Identity() / 12.0;
    EXPECT_LT(error.cwiseAbs().maxCoeff(), 1e-15) << first;
  }
}

// A plate of 2 x 2 x 1 with a hole of 1 x 1: its ends are one polygon each, slit from the outline
// to the hole, so that an edge belongs to one face twice.
TEST(MeshFile, APolygonMayBeSlitToAHole) {
  PolygonMesh plate;
  for (const double z : {0.0, 1.0}) {
    for (const double r : {1.0, 0.5}) {
      plate.vertices.insert(plate.vertices.end(), {{-r, -r, z}, {r, -r, z}, {r, r, z}, {-r, r, z}});
    }
  }
  plate.faces = {{0, 4, 5, 6, 7, 4, 0, 3, 2, 1}, {8, 9, 10, 11, 8, 12, 15, 14, 13, 12}};
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    plate.faces.push_back({i, next, 8 + next, 8 + i});
    plate.faces.push_back({4 + next, 4 + i, 12 + i, 12 + next});
  }
  EXPECT_NEAR(signedVolume(parsedObj(plate).mesh), 3.0, 1e-15);
}

// The unit cube with a corner of its top lifted by h: the top is cut along the diagonal from its
// first vertex. Two triangles of base 1/2: V = 1 + h/6 if the lifted corner is not on the diagonal,
// 1 + 2 h/6 if it is. The two sides at that corner stay plane.
TEST(MeshFile, APolygonThatIsNotPlaneIsCutFromItsFirstVertexAndThatIsSaid) {
  const double h = 0.25;
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1.25\nv 0 1 1\n"
      "f 1 4 3 2\nf 1 2 6 5\nf 3 4 8 7\nf 2 3 7 6\nf 4 1 5 8\n";
  for (const auto& [top, volume] :
       {std::pair{"f 5 6 7 8\n", 1.0 + h / 3.0}, std::pair{"f 6 7 8 5\n", 1.0 + h / 6.0}}) {
    const LoadedMesh loaded = parseClosedMesh(text + top, MeshFormat::kObj, Vector3::Ones(), "it");
    EXPECT_NEAR(signedVolume(loaded.mesh), volume, 1e-15) << top;
    EXPECT_EQ(loaded.mesh.faces.size(), 7U);
    ASSERT_EQ(loaded.notes.size(), 1U);
    EXPECT_EQ(loaded.notes[0].find("it: polygons that are not plane: 1, the worst by 0.06"), 0U)
        << loaded.notes[0];
  }
}

// Moved by half a unit of the sixth decimal, as printing does.
TEST(MeshFile, APolygonThatIsPlaneUpToPrintedDigitsStaysOne) {
  PolygonMesh cube = loadClosedMesh("test/data/cube.obj").mesh;
  cube.vertices[0].z() += 5e-7;
  const LoadedMesh loaded = parsedObj(cube);
  EXPECT_EQ(loaded.mesh.faces.size(), 6U);
  EXPECT_TRUE(loaded.notes.empty());
}

TEST(MeshFile, NearVerticesAreJoinedAndThatIsSaid) {
  std::string text = contentOf("test/data/tetrahedron.stl");
  const std::string vertex = "vertex 1 0 0";
  text.replace(text.find(vertex), vertex.size(), "vertex 1.00001 0 0");
  const LoadedMesh loaded = parseClosedMesh(text, MeshFormat::kStl, Vector3::Ones(), "it");
  EXPECT_EQ(loaded.mesh.vertices.size(), 4U);
  ASSERT_EQ(loaded.notes.size(), 1U);
  EXPECT_EQ(loaded.notes[0],
            "it: closed by joining vertices on open edges: 1, up to 1e-05 m apart");
  EXPECT_EQ(parseSurface(text, MeshFormat::kStl, Vector3::Ones(), "it").mesh.vertices.size(), 5U);
  text.replace(text.find("vertex 1.00001 0 0"), 14, "vertex 1.00011");
  EXPECT_NE(testing::messageOfParsing(text, MeshFormat::kStl).find("it: not closed: "),
            std::string::npos);
}

TEST(MeshFile, TheEndOfTheNameSaysTheFormatInAnyCase) {
  const TestFolder folder;
  const PolygonMesh box = boxMesh({0.0, 0.0, 0.0}, {1.0, 2.0, 3.0});
  for (const char* name : {"a.stl", "a.STL", "a.b.Stl"}) {
    EXPECT_EQ(signedVolume(loadClosedMesh(folder.write(name, stlBytes(box))).mesh), 6.0) << name;
  }
  for (const char* name : {"a.obj", "a.OBJ"}) {
    EXPECT_EQ(signedVolume(loadClosedMesh(folder.write(name, objText(box))).mesh), 6.0) << name;
  }
}

TEST(MeshFile, OtherFormatsAreRefusedWithAWayToConvertThem) {
  for (const char* path :
       {"a.dae", "a.ply", "a.off", "a.step", "a", "obj", ".stl/a", "test/data"}) {
    const std::string message = messageOfLoading(path);
    EXPECT_EQ(message.find("mesh file '" + std::string(path) +
                           "': its name must end in .obj or .stl: write a mesh of another format "
                           "as one of these, for instance in Blender "),
              0U)
        << message;
  }
}

TEST(MeshFile, AMissingFileIsNamed) {
  EXPECT_EQ(messageOfLoading("test/data/nowhere.obj"),
            "mesh file 'test/data/nowhere.obj': does not exist or cannot be read");
}

TEST(MeshFile, WhatIsNoRegularFileIsRefusedAtOnce) {
  const TestFolder folder;
  const std::string path = folder.file("a.obj");
  ASSERT_EQ(mkfifo(path.c_str(), 0600), 0);
  EXPECT_EQ(messageOfLoading(path), "mesh file '" + path + "': is a FIFO: must be a regular file");
  const std::string link = folder.file("zero.stl");
  std::filesystem::create_symlink("/dev/zero", link);
  EXPECT_EQ(messageOfLoading(link),
            "mesh file '" + link + "': is a device: must be a regular file");
  const std::string sparse = folder.write("large.stl", "");
  std::filesystem::resize_file(sparse, kMostMeshBytes + 1);
  EXPECT_EQ(messageOfLoading(sparse),
            "mesh file '" + sparse + "': has 268435457 bytes: must have at most 268435456");
}

TEST(MeshFile, AFileThatIsNoMeshIsNamedInOneLine) {
  const std::string message = messageOfLoading("test/data/broken.stl");
  EXPECT_EQ(message.find("mesh file 'test/data/broken.stl': no STL: "), 0U) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(MeshFile, OneWithoutFacesIsRefused) {
  EXPECT_EQ(messageOfLoading("test/data/line.obj"), "mesh file 'test/data/line.obj': no faces");
}

// Without its top the cube has the four open edges of that face.
TEST(MeshFile, AnOpenSurfaceIsRefusedWithItsEdges) {
  EXPECT_EQ(messageOfLoading("test/data/open_cube.obj"),
            "mesh file 'test/data/open_cube.obj': not closed: 4 open edges, the first from (1, 0, "
            "1) to (0, 0, 1) m: each edge must belong to two faces");
}

TEST(MeshFile, AFaceThatIsTurnedOverIsRefused) {
  EXPECT_EQ(messageOfLoading("test/data/twisted_cube.obj"),
            "mesh file 'test/data/twisted_cube.obj': inconsistent orientation: 4 one-way edges, "
            "the first from (0, 1, 1) to (1, 1, 1) m: its two faces must run through it in "
            "opposite directions");
}

TEST(MeshFile, AnEdgeOfFourFacesIsRefused) {
  EXPECT_EQ(messageOfLoading("test/data/fin_cube.obj"),
            "mesh file 'test/data/fin_cube.obj': not a simple surface: 1 crowded edge, the first "
            "from (1, 0, 0) to (1, 0, 1) m, which belongs to 4 faces: each edge must belong to "
            "two");
}

TEST(MeshFile, ASurfaceThatIsInsideOutIsRefused) {
  EXPECT_EQ(messageOfLoading("test/data/inside_out_cube.obj"),
            "mesh file 'test/data/inside_out_cube.obj': inside out: its volume is -1 m^3: seen "
            "from outside, the vertices of each face must run counter-clockwise");
}

TEST(MeshFile, ASurfaceWithoutVolumeIsRefused) {
  EXPECT_EQ(messageOfLoading("test/data/flat.obj"),
            "mesh file 'test/data/flat.obj': volume = 0 m^3 with an uncertainty of 2e-15 m^3, as "
            "coordinates of 1 m are rounded to 1e-15 of themselves: must be known to 1 %");
}

// A corner tetrahedron of edge 10^power: beyond 1e50 m sums would overflow, below 1e-100 m the
// volume is no normal number.
TEST(MeshFile, EverySizeHasItsVolumeOrAnError) {
  for (int power = -320; power <= 308; ++power) {
    const std::string text = fmt::format(
        "v 0 0 0\nv 1e{0} 0 0\nv 0 1e{0} 0\nv 0 0 1e{0}\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n",
        power);
    const std::string message = testing::messageOfParsing(text, MeshFormat::kObj);
    if (power > 50) {
      EXPECT_NE(message.find("must be at most 1e+50 m"), std::string::npos) << power << message;
    } else if (power >= -100) {
      const double size = parseNumber(fmt::format("1e{}", power)).value;
      const LoadedMesh loaded = parseClosedMesh(text, MeshFormat::kObj, Vector3::Ones(), "it");
      EXPECT_NEAR(volumeMoments(loaded.mesh).volume / (size * size * size), 1.0 / 6.0, 1e-14);
    } else if (power < -108) {
      EXPECT_NE(message.find("must be known to 1 %"), std::string::npos) << power << message;
    }
  }
}

}  // namespace
}  // namespace hovercraft
