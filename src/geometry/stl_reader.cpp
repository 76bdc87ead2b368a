#include "hovercraft_sim/geometry/stl_reader.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "hovercraft_sim/geometry/mesh_text.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

constexpr std::size_t kHeaderBytes = 80;
constexpr std::size_t kCountBytes = 4;
constexpr std::size_t kTriangleBytes = 50;  // a normal, three vertices, an attribute of two bytes
constexpr std::size_t kNormalBytes = 12;

static_assert(std::numeric_limits<float>::is_iec559, "binary STL holds IEEE 754 numbers");

/// Four bytes, the lowest first.
std::uint32_t word32(const std::string& content, std::size_t position) {
  std::uint32_t word = 0;
  for (std::size_t i = 4; i-- > 0;) {
    word = (word << 8U) | static_cast<unsigned char>(content[position + i]);
  }
  return word;
}

float singleAt(const std::string& content, std::size_t position) {
  const std::uint32_t bits = word32(content, position);
  float number = 0.0F;
  std::memcpy(&number, &bits, sizeof(number));
  return number;
}

void addTriangle(PolygonMesh& mesh) {
  const auto count = static_cast<int>(mesh.vertices.size());
  mesh.faces.push_back({count - 3, count - 2, count - 1});
}

StlContent readBinary(const std::string& content, const Vector3& scale, const std::string& name) {
  const std::size_t count = word32(content, kHeaderBytes);
  StlContent stl;
  stl.mesh.rounding = kSingleRounding;
  stl.mesh.vertices.reserve(3 * count);
  stl.mesh.faces.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    std::size_t position = kHeaderBytes + kCountBytes + t * kTriangleBytes + kNormalBytes;
    for (int corner = 0; corner < 3; ++corner) {
      Vector3 p;
      for (int i = 0; i < 3; ++i) {
        p[i] = static_cast<double>(singleAt(content, position)) * scale[i];
        position += sizeof(float);
        if (std::abs(p[i]) <= kMostMeshCoordinate) continue;
        throw std::invalid_argument(
            fmt::format("{}: triangle {}: a coordinate is {:g} m: must be finite, at most {:g} m",
                        name, t + 1, p[i], kMostMeshCoordinate));
      }
      stl.mesh.vertices.push_back(p);
    }
    addTriangle(stl.mesh);
  }
  stl.trailing_bytes = content.size() - (kHeaderBytes + kCountBytes + count * kTriangleBytes);
  return stl;
}

class TextReader {
 public:
  TextReader(const std::string& content, const Vector3& scale, const std::string& name)
      : text_(content, name), scale_(scale) {}

  PolygonMesh read() {
    while (hasWord()) {
      expect("solid");
      words_.clear();  // the name
      while (!next("facet or endsolid").is("endsolid")) readFacet();
      words_.clear();
    }
    return std::move(mesh_);
  }

 private:
  /// Whether another word follows; then it is words_[position_].
  bool hasWord() {
    while (position_ >= words_.size()) {
      words_.clear();
      position_ = 0;
      if (text_.appendLine(words_, false) == MeshText::LineEnd::kEndOfFile) return false;
    }
    return true;
  }

  const MeshWord& next(const char* expected) {
    if (!hasWord()) text_.refuse(fmt::format("the file ends here: {} must follow", expected));
    return words_[position_++];
  }

  void expect(const char* expected) {
    const MeshWord word = next(expected);
    if (!word.is(expected)) {
      text_.refuse(fmt::format("{}: {} must stand here", quoted(word), expected));
    }
  }

  /// After its first word, which is in words_ still.
  void readFacet() {
    const MeshWord facet = words_[position_ - 1];
    if (!facet.is("facet")) {
      text_.refuse(quoted(facet) + ": facet or endsolid must stand here");
    }
    // "normal" and three numbers, which may also be no numbers where a triangle has no area.
    int count = 0;
    while (!next("outer loop").is("outer")) {
      if (++count > 4) text_.refuse("outer loop must follow the three numbers of the normal");
    }
    expect("loop");
    for (int corner = 0; corner < 3; ++corner) {
      expect("vertex");
      Vector3 p;
      for (int i = 0; i < 3; ++i) p[i] = text_.coordinate(next("three numbers"), scale_[i]);
      mesh_.vertices.push_back(p);
    }
    expect("endloop");
    expect("endfacet");
    addTriangle(mesh_);
  }

  MeshText text_;
  Vector3 scale_;
  std::vector<MeshWord> words_;  // of the line
  std::size_t position_ = 0;     // of the next one
  PolygonMesh mesh_;
};

bool beginsWithSolid(const std::string& content) {
  const std::string blank = " \t\r\n\xef\xbb\xbf";
  const std::size_t begin = content.find_first_not_of(blank);
  constexpr std::size_t length = 5;
  return begin != std::string::npos && content.size() - begin >= length &&
         MeshWord{&content[begin], length}.is("solid");
}

}  // namespace

StlContent readStl(const std::string& content, const Vector3& scale, const std::string& name) {
  const FloatingPointEnvironment environment;
  constexpr std::size_t start = kHeaderBytes + kCountBytes;
  const std::size_t count = content.size() >= start ? word32(content, kHeaderBytes) : 0;
  const std::size_t length = start + count * kTriangleBytes;
  if (content.size() >= length && content.size() < length + kTriangleBytes) {
    return readBinary(content, scale, name);
  }
  if (beginsWithSolid(content) && content.find('\0') == std::string::npos) {
    return {TextReader(content, scale, name).read(), 0};
  }
  if (content.size() < start) {
    throw std::invalid_argument(fmt::format(
        "{}: no STL: {} bytes that do not begin with 'solid': a binary file has at least {}", name,
        content.size(), start));
  }
  throw std::invalid_argument(
      fmt::format("{}: no STL: the {} triangles that its header counts take {} bytes, it has {}; "
                  "and as text it "
                  "would begin with 'solid' and have no zero byte",
                  name, count, length, content.size()));
}

}  // namespace hovercraft
