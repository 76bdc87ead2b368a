#include <cstddef>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/geometry/obj_reader.h"
#include "hovercraft_sim/geometry/volume_moments.h"

#include "../support/mesh_files.h"
#include "../support/sample_meshes.h"

namespace hovercraft {
namespace {

using testing::boxMesh;
using testing::messageOf;
using testing::messageOfParsing;
using testing::objText;

PolygonMesh read(const std::string& text) {
  return readObj(text, Vector3::Ones(), "it");
}

std::string messageOfReading(const std::string& text) {
  return messageOf([&] { read(text); });
}

const std::string kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// The tetrahedron with its last line replaced.
std::string withLastFace(const std::string& face) {
  return kTetrahedron.substr(0, kTetrahedron.rfind("f ")) + face + "\n";
}

TEST(ObjReader, NumbersAreTheNearestDoubles) {
  const PolygonMesh mesh = read("v 0.1 -7e-1 +1234.567\nv 1.234567e3 .5 5.\nv 1 2 3\nf 1 2 3\n");
  EXPECT_EQ(mesh.vertices[0].x(), 0.1);
  EXPECT_EQ(mesh.vertices[0].y(), -0.7);
  EXPECT_EQ(mesh.vertices[0].z(), 1234.567);
  EXPECT_EQ(mesh.vertices[1].x(), 1234.567);
  EXPECT_EQ(mesh.vertices[1].y(), 0.5);
  EXPECT_EQ(mesh.vertices[1].z(), 5.0);
}

TEST(ObjReader, EveryFormOfACornerNamesItsVertex) {
  for (const char* face : {"f 3 1 4", "f 3/1 1/2 4/3", "f 3//1 1//1 4//1", "f 3/1/1 1/2/1 4/3/1",
                           "f -2 -4 -1", "f -2/-1/-1 -4/1 -1//1", "fo 3 1 4", "f 3/ 1/ 4/",
                           "F 3 1 4", "  f\t3  1\t4  ", "f 3 1 4 # a comment", "f 3 1 4#"}) {
    EXPECT_EQ(messageOfParsing(withLastFace(face), MeshFormat::kObj), "no error") << face;
  }
}

TEST(ObjReader, NegativeIndicesCountFromWhereTheyStand) {
  const PolygonMesh mesh = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\nv 5 5 5\nf -1 -2 -4\n");
  EXPECT_EQ(mesh.faces[0], (std::vector<int>{2, 1, 0}));
  EXPECT_EQ(mesh.faces[1], (std::vector<int>{3, 2, 0}));
}

TEST(ObjReader, AVertexMayFollowTheFaceThatNamesIt) {
  EXPECT_EQ(read("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").faces[0], (std::vector<int>{0, 1, 2}));
}

TEST(ObjReader, LinesEndInEveryWayAndGoOnBehindABackslash) {
  const std::vector<std::string> ends = {"\n", "\r\n", "\r", " \\\n\n", "\\\r\n\r\n"};
  for (const std::string& end : ends) {
    std::string text;
    for (const char c : kTetrahedron) text += c == '\n' ? end : std::string(1, c);
    EXPECT_EQ(messageOfParsing(text, MeshFormat::kObj), "no error") << end;
  }
  EXPECT_EQ(messageOfParsing(withLastFace("f 3 \\\n 1 \\\n\\\n 4"), MeshFormat::kObj), "no error");
  EXPECT_EQ(messageOfParsing(withLastFace("f \\"), MeshFormat::kObj),
            "it: line 8: a face of 0 vertices: must have at least 3");
  EXPECT_EQ(messageOfParsing("# C:\\\n" + kTetrahedron, MeshFormat::kObj), "no error")
      << "a comment does not go on";
  EXPECT_EQ(messageOfParsing("\xef\xbb\xbf" + kTetrahedron, MeshFormat::kObj), "no error");
  EXPECT_EQ(messageOfParsing(kTetrahedron.substr(0, kTetrahedron.size() - 1), MeshFormat::kObj),
            "no error")
      << "the last line has no end";
}

TEST(ObjReader, WhatEnclosesNothingIsPassedOver) {
  EXPECT_EQ(messageOfParsing("mtllib /dev/zero\no name\ng a b\ns off\nusemtl \xc3\xa4\nvt 0 0\n"
                             "vn 0 0 1\nvp 0 1\n" +
                                 kTetrahedron + "l 1 2\np 1\nl\n\n\t\nlod 3\n",
                             MeshFormat::kObj),
            "no error");
}

TEST(ObjReader, AVertexMayHaveAColourAndTheWeightOne) {
  for (const char* more : {"", " 1", " 1.0", " 0.5 0.5 0.5", " 1 0.5 0.5 0.5"}) {
    std::string text;
    for (const std::string v : {"v 0 0 0", "v 1 0 0", "v 0 1 0", "v 0 0 1"})
      text += v + more + "\n";
    text += "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    EXPECT_EQ(messageOfParsing(text, MeshFormat::kObj), "no error") << more;
  }
  EXPECT_EQ(messageOfReading("v 0 0 0 2\n"),
            "it: line 1: '2': a weight that is not 1 belongs to a rational curve or surface, which "
            "is not read");
  for (const char* v : {"v", "v 1", "v 1 2", "v 1 2 3 4 5", "v 1 2 3 4 5 6 7 8"}) {
    EXPECT_EQ(messageOfReading(v).find("it: line 1: v with "), 0U) << v;
  }
}

TEST(ObjReader, BadNumbersAreNamedWithTheirLine) {
  EXPECT_EQ(messageOfReading("\nv 0 nan 0\n"), "it: line 2: 'nan': must be finite");
  EXPECT_EQ(messageOfReading("v 0 0 1e400\n"), "it: line 1: '1e400': must be finite");
  EXPECT_EQ(messageOfReading("v -inf 0 0\n"), "it: line 1: '-inf': must be finite");
  EXPECT_EQ(messageOfReading("v 1,5 0 0\n"), "it: line 1: '1,5': must be a number");
  EXPECT_EQ(messageOfReading("v 0x10 0 0\n"), "it: line 1: '0x10': must be a number");
  EXPECT_EQ(messageOfReading("v 0 0 1e51\n"), "it: line 1: '1e51': must be at most 1e+50 m");
  EXPECT_EQ(messageOfReading("v 0 0 \x01\xff" + std::string(100, 'x') + "\n"),
            "it: line 1: '??xxxxxxxxxxxxxxxxxxxxxx...': must be a number");
}

TEST(ObjReader, BadIndicesAreNamedWithTheirLine) {
  const std::string rule = ": indices must be whole numbers from 1 on, or from -1 on backwards";
  for (const std::string corner :
       {"0", "-0", "x", "1.0", "+", "-", "99999999999999999999", "2147483648", "-2147483648", "1e0",
        "1/0", "1/x", "1//0", "1/1/y", "//1", "/"}) {
    EXPECT_EQ(messageOfReading(withLastFace("f 3 4 " + corner)),
              std::string("it: line 8: '").append(corner).append("'").append(rule));
  }
  EXPECT_EQ(messageOfReading(withLastFace("f 3 1 1/1/1/1")),
            "it: line 8: '1/1/1/1': must be v, v/vt, v//vn or v/vt/vn");
  EXPECT_EQ(messageOfReading(withLastFace("f 3 1 5")), "it: line 8: vertex 5: the file has 4");
  EXPECT_EQ(messageOfReading(withLastFace("f 3 1 2147483647")),
            "it: line 8: vertex 2147483647: the file has 4");
  EXPECT_EQ(messageOfReading(withLastFace("f 3 1 -5")),
            "it: line 8: '-5': there are 4 vertices before it");
}

TEST(ObjReader, AFaceHasAtLeastThreeVertices) {
  for (const std::string face : {"f", "f 1", "f 1 2"}) {
    EXPECT_EQ(messageOfReading(withLastFace(face)).find("it: line 8: a face of "), 0U) << face;
  }
}

TEST(ObjReader, WhatItDoesNotKnowIsRefused) {
  for (const std::string word :
       {"cstype bezier", "deg 3 3", "surf 0 1 0 1 1 2", "curv2 1 2", "end"}) {
    EXPECT_NE(messageOfReading(word).find("curves and surfaces of free form are not read"),
              std::string::npos)
        << word;
  }
  EXPECT_EQ(messageOfReading("csh rm -r x"),
            "it: line 1: 'csh': no other file is read and nothing is run");
  EXPECT_EQ(messageOfReading("call other.obj"),
            "it: line 1: 'call': no other file is read and nothing is run");
  EXPECT_EQ(messageOfReading("ply"), "it: line 1: 'ply': is no statement of OBJ");
  EXPECT_EQ(messageOfReading(std::string("v 0 0 0\n\0", 9)),
            "it: the byte 8 is zero: must be a text");
}

TEST(ObjReader, EveryCutOfAFileEndsInAnErrorOrAMesh) {
  const std::string whole = objText(boxMesh({0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}));
  int meshes = 0;
  for (std::size_t length = 0; length <= whole.size(); ++length) {
    if (messageOfParsing(whole.substr(0, length), MeshFormat::kObj) == "no error") ++meshes;
  }
  EXPECT_EQ(meshes, 2) << "the whole file, and the one without its last line break";
}

// A pyramid over a polygon of 10^5 corners, (i, i²) for i from 0 on, scaled to a unit square: the
// area between the parabola's chords and its longest one is 1/6 (1 - 1/n²) for n chords.
TEST(ObjReader, APolygonMayHaveManyVertices) {
  constexpr int chords = 100000;
  PolygonMesh pyramid;
  std::vector<int> base;
  for (int i = 0; i <= chords; ++i) {
    const double x = static_cast<double>(i) / chords;
    pyramid.vertices.emplace_back(x, x * x, 0.0);
    base.push_back(chords - i);
    pyramid.faces.push_back({i, i < chords ? i + 1 : 0, chords + 1});
  }
  pyramid.vertices.emplace_back(0.5, 0.5, 1.0);
  pyramid.faces.push_back(base);
  const LoadedMesh loaded =
      parseClosedMesh(objText(pyramid), MeshFormat::kObj, Vector3::Ones(), "it");
  EXPECT_NEAR(signedVolume(loaded.mesh), (1.0 - 1e-10) / 18.0, 1e-15);
  EXPECT_TRUE(loaded.notes.empty());
}

TEST(ObjReader, TheScaleIsAlongEachAxis) {
  const PolygonMesh mesh = readObj("v 1 2 3\n", {0.001, 10.0, 0.5}, "it");
  EXPECT_EQ(mesh.vertices[0].x(), 0.001);
  EXPECT_EQ(mesh.vertices[0].y(), 20.0);
  EXPECT_EQ(mesh.vertices[0].z(), 1.5);
}

}  // namespace
}  // namespace hovercraft
