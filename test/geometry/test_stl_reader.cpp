#include <cctype>
#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/geometry/stl_reader.h"
#include "hovercraft_sim/geometry/volume_moments.h"

#include "../support/mesh_files.h"
#include "../support/sample_meshes.h"

namespace hovercraft {
namespace {

using testing::boxMesh;
using testing::contentOf;
using testing::messageOfParsing;
using testing::stlBytes;

PolygonMesh box() {
  return boxMesh({0.0, 0.0, 0.0}, {1.0, 2.0, 3.0});
}

std::string tetrahedron() {
  return contentOf("test/data/tetrahedron.stl");
}

std::string withReplaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t place = text.find(part);
  EXPECT_NE(place, std::string::npos) << part;
  return text.replace(place, part.size(), by);
}

/// A box as bytes of which four are replaced.
std::string withWord(std::size_t position, const std::string& word) {
  return stlBytes(box()).replace(position, word.size(), word);
}

LoadedMesh parsed(const std::string& content) {
  return parseClosedMesh(content, MeshFormat::kStl, Vector3::Ones(), "it");
}

TEST(StlReader, ABinaryFileIsToldByItsLengthWhateverItsHeader) {
  for (const char* header : {"", "solid", "SOLID of a program", "solid\nfacet normal 0 0 1\n"}) {
    const LoadedMesh loaded = parsed(stlBytes(box(), header));
    EXPECT_EQ(loaded.mesh.vertices.size(), 8U) << header;
    EXPECT_EQ(signedVolume(loaded.mesh), 6.0) << header;
    EXPECT_TRUE(loaded.notes.empty()) << header;
  }
}

TEST(StlReader, FewerThanFiftyBytesMayFollowAndThatIsSaid) {
  for (const std::size_t count : {1U, 17U, 49U}) {
    const LoadedMesh loaded = parsed(stlBytes(box()) + std::string(count, 'x'));
    EXPECT_EQ(signedVolume(loaded.mesh), 6.0);
    ASSERT_EQ(loaded.notes.size(), 1U);
    EXPECT_EQ(loaded.notes[0], "it: bytes left out behind its triangles: " + std::to_string(count));
  }
  EXPECT_EQ(messageOfParsing(stlBytes(box()) + std::string(50, 'x'), MeshFormat::kStl),
            "it: no STL: the 12 triangles that its header counts take 684 bytes, it has 734; and "
            "as text it would begin with 'solid' and have no zero byte");
}

TEST(StlReader, ACountThatLiesIsRefused) {
  for (const std::string& count : {std::string("\x0d\0\0\0", 4), std::string("\xff\xff\xff\xff"),
                                   std::string("\x01\0\0\0", 4), std::string("\0\0\0\0", 4)}) {
    EXPECT_NE(messageOfParsing(withWord(80, count), MeshFormat::kStl).find("it: no STL: the "),
              std::string::npos);
  }
  PolygonMesh none = box();
  none.faces.clear();
  EXPECT_EQ(messageOfParsing(stlBytes(none), MeshFormat::kStl), "it: no faces");
}

TEST(StlReader, EveryCutOfABinaryFileIsRefused) {
  const std::string whole = stlBytes(box(), "solid");
  for (std::size_t length = 0; length < whole.size(); ++length) {
    EXPECT_NE(messageOfParsing(whole.substr(0, length), MeshFormat::kStl), "no error") << length;
  }
}

TEST(StlReader, EveryCutOfATextIsRefused) {
  const std::string whole = tetrahedron();
  const std::size_t end = whole.rfind("endsolid") + std::string("endsolid").size();
  for (std::size_t length = 0; length < end; ++length) {
    EXPECT_NE(messageOfParsing(whole.substr(0, length), MeshFormat::kStl), "no error") << length;
  }
  EXPECT_EQ(messageOfParsing(whole.substr(0, end), MeshFormat::kStl), "no error");
}

// 84 + 50 t + 12 is where the vertices of triangle t begin.
TEST(StlReader, ANumberOfABinaryFileThatIsNotFiniteIsNamedWithItsTriangle) {
  EXPECT_EQ(messageOfParsing(withWord(84 + 100 + 12 + 8, std::string("\0\0\x80\x7f", 4)),
                             MeshFormat::kStl),
            "it: triangle 3: a coordinate is inf m: must be finite, at most 1e+50 m");
  EXPECT_NE(messageOfParsing(withWord(84 + 12, std::string("\0\0\xc0\x7f", 4)), MeshFormat::kStl)
                .find("it: triangle 1: a coordinate is nan m: "),
            std::string::npos);
  EXPECT_EQ(messageOfParsing(withWord(84, std::string("\0\0\xc0\x7f", 4)), MeshFormat::kStl),
            "no error")
      << "a normal is passed over";
}

TEST(StlReader, ATextMayBeInCapitalsAndEndItsLinesInEveryWay) {
  std::string capitals;
  for (const char c : tetrahedron()) {
    capitals += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  for (const std::string& text : {tetrahedron(), capitals}) {
    for (const std::string end : {"\n", "\r\n", "\r", "\n\n\t"}) {
      std::string changed;
      for (const char c : text) changed += c == '\n' ? end : std::string(1, c);
      EXPECT_EQ(messageOfParsing(changed, MeshFormat::kStl), "no error") << changed;
      EXPECT_EQ(messageOfParsing("\xef\xbb\xbf \n" + changed, MeshFormat::kStl), "no error");
    }
  }
}

TEST(StlReader, NamesMayBeAnythingAndMissing) {
  for (const char* name : {"solid", "solid a b", "solid facet normal", "Solid \xc3\xa4 endsolid"}) {
    std::string text = tetrahedron();
    text = name + text.substr(text.find('\n'));
    EXPECT_EQ(messageOfParsing(text, MeshFormat::kStl), "no error") << name;
  }
}

// tetrahedron.stl has the volume 1; the other one lies beside it.
TEST(StlReader, AFileMayHoldSeveralSolids) {
  std::string text = tetrahedron();
  const double volume = signedVolume(parsed(text).mesh);
  const std::string other =
      "solid other\n"
      "facet normal 0 0 -1 outer loop vertex 9 0 0 vertex 9 1 0 vertex 10 0 0 endloop endfacet\n"
      "facet normal 0 -1 0 outer loop vertex 9 0 0 vertex 10 0 0 vertex 9 0 1 endloop endfacet\n"
      "facet normal -1 0 0 outer loop vertex 9 0 0 vertex 9 0 1 vertex 9 1 0 endloop endfacet\n"
      "facet normal nan nan(ind) -nan outer loop vertex 10 0 0 vertex 9 1 0 vertex 9 0 1 endloop\n"
      "endfacet endsolid\n";
  EXPECT_NEAR(signedVolume(parsed(text + other).mesh), volume + 1.0 / 6.0, 1e-15);
}

TEST(StlReader, WhatIsWrongInATextIsNamedWithItsLine) {
  const std::string text = tetrahedron();
  const auto message = [&](const std::string& part, const std::string& by) {
    return messageOfParsing(withReplaced(text, part, by), MeshFormat::kStl);
  };
  EXPECT_EQ(message("vertex 0 0 0", "vertex 0 0 1e400"), "it: line 4: '1e400': must be finite");
  EXPECT_EQ(message("vertex 0 0 0", "vertex 0 0"), "it: line 5: 'vertex': must be a number");
  EXPECT_EQ(message("vertex 0 0 0", "vertex 0 0 0 0"), "it: line 4: '0': vertex must stand here");
  EXPECT_EQ(message("endloop", "vertex 1 1 1\nendloop"),
            "it: line 7: 'vertex': endloop must stand here");
  EXPECT_EQ(message("outer loop", "outer"), "it: line 4: 'vertex': loop must stand here");
  EXPECT_EQ(message("outer loop", "1 2 outer loop"),
            "it: line 3: outer loop must follow the three numbers of the normal");
  EXPECT_EQ(message("endfacet", "endface"), "it: line 8: 'endface': endfacet must stand here");
  EXPECT_EQ(messageOfParsing(text + "rubbish", MeshFormat::kStl),
            "it: line 31: 'rubbish': solid must stand here");
  EXPECT_EQ(messageOfParsing("solid\nendsolid\n", MeshFormat::kStl), "it: no faces");
  EXPECT_EQ(messageOfParsing("solid\n", MeshFormat::kStl),
            "it: line 1: the file ends here: facet or endsolid must follow");
}

TEST(StlReader, WhatIsNoStlIsSaid) {
  EXPECT_EQ(messageOfParsing("this is no mesh\n", MeshFormat::kStl),
            "it: no STL: 16 bytes that do not begin with 'solid': a binary file has at least 84");
  EXPECT_NE(messageOfParsing(std::string(200, 'x'), MeshFormat::kStl)
                .find("it: no STL: the 2021161080 triangles that its header counts take "),
            std::string::npos);
  EXPECT_NE(messageOfParsing("solid" + std::string(1, '\0') + tetrahedron(), MeshFormat::kStl)
                .find("have no zero byte"),
            std::string::npos);
}

// The uncertainty of a unit cube so far away is 6 m² * 28500 m * 5.97e-8 = 1.02 % of it in single
// precision.
TEST(StlReader, ABinaryFileIsKnownToSinglePrecisionOnly) {
  const PolygonMesh far = boxMesh({28500.0, 0.0, 0.0}, {28501.0, 1.0, 1.0});
  EXPECT_NE(messageOfParsing(stlBytes(far), MeshFormat::kStl).find("must be known to 1 %"),
            std::string::npos);
  EXPECT_EQ(messageOfParsing(testing::objText(far), MeshFormat::kObj), "no error");
}

TEST(StlReader, TheScaleIsAlongEachAxis) {
  const StlContent stl = readStl(stlBytes(box()), {2.0, 0.5, 10.0}, "it");
  EXPECT_EQ(signedVolume(stl.mesh), 60.0);
}

}  // namespace
}  // namespace hovercraft
