#include "hovercraft_sim/geometry/obj_reader.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <fmt/format.h>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <vector>

#include "hovercraft_sim/geometry/mesh_text.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/parse_number.h"

namespace hovercraft {
namespace {

constexpr std::int64_t kMostIndex = 1LL << 31;  // beyond what a file of kMostMeshBytes can hold

constexpr const char* kPassedOver[] = {"vn",       "vt",     "vp",         "p",        "l",
                                       "g",        "s",      "mg",         "o",        "mtllib",
                                       "usemtl",   "maplib", "usemap",     "bevel",    "c_interp",
                                       "d_interp", "lod",    "shadow_obj", "trace_obj"};

constexpr const char* kFreeForm[] = {"cstype", "deg",   "bmat", "step", "curv", "curv2", "surf",
                                     "parm",   "trim",  "hole", "scrv", "sp",   "end",   "con",
                                     "ctech",  "stech", "bsp",  "bzp",  "cdc",  "cdp",   "res"};

template <std::size_t size>
bool isOneOf(const MeshWord& word, const char* const (&names)[size]) {
  return std::any_of(std::begin(names), std::end(names),
                     [&word](const char* name) { return word.is(name); });
}

class ObjReader {
 public:
  ObjReader(const std::string& content, const Vector3& scale, const std::string& name)
      : text_(content, name), scale_(scale), name_(name) {}

  PolygonMesh read() {
    std::vector<MeshWord> words;
    while (nextStatement(words)) {
      if (!words.empty()) take(words);
    }
    if (greatest_index_ > vertexCount()) {
      throw std::invalid_argument(fmt::format("{}: line {}: vertex {}: the file has {}", name_,
                                              line_of_greatest_, greatest_index_, vertexCount()));
    }
    return std::move(mesh_);
  }

 private:
  std::int64_t vertexCount() const { return static_cast<std::int64_t>(mesh_.vertices.size()); }

  bool nextStatement(std::vector<MeshWord>& words) {
    words.clear();
    auto end = text_.appendLine(words, true);
    const bool is_there = end != MeshText::LineEnd::kEndOfFile;
    while (end == MeshText::LineEnd::kContinued) end = text_.appendLine(words, true);
    return is_there;
  }

  void take(const std::vector<MeshWord>& words) {
    const MeshWord& statement = words.front();
    if (statement.is("v")) return takeVertex(words);
    if (statement.is("f") || statement.is("fo")) return takeFace(words);
    if (isOneOf(statement, kPassedOver)) return;
    if (isOneOf(statement, kFreeForm)) {
      text_.refuse(quoted(statement) +
                   ": curves and surfaces of free form are not read: write them as polygons");
    }
    if (statement.is("call") || statement.is("csh")) {
      text_.refuse(quoted(statement) + ": no other file is read and nothing is run");
    }
    text_.refuse(quoted(statement) + ": is no statement of OBJ");
  }

  void takeVertex(const std::vector<MeshWord>& words) {
    const std::size_t count = words.size() - 1;
    if (count != 3 && count != 4 && count != 6 && count != 7) {
      text_.refuse(fmt::format(
          "v with {} numbers: must be x y z, and then nothing, a weight of 1, or a colour of 3 or "
          "4 numbers",
          count));
    }
    if (count == 4 && parseNumber(words[4].text()).value != 1.0) {
      text_.refuse(quoted(words[4]) +
                   ": a weight that is not 1 belongs to a rational curve or surface, which is not "
                   "read");
    }
    Vector3 p;
    for (int i = 0; i < 3; ++i) {
      p[i] = text_.coordinate(words[static_cast<std::size_t>(i) + 1], scale_[i]);
    }
    mesh_.vertices.push_back(p);
  }

  void takeFace(const std::vector<MeshWord>& words) {
    if (words.size() < 4) {
      text_.refuse(fmt::format("a face of {} vertices: must have at least 3", words.size() - 1));
    }
    std::vector<int> face;
    face.reserve(words.size() - 1);
    for (std::size_t i = 1; i < words.size(); ++i) face.push_back(vertexOf(words[i]));
    mesh_.faces.push_back(std::move(face));
  }

  /// The vertex, from 0, of v, v/vt, v//vn or v/vt/vn.
  int vertexOf(const MeshWord& corner) {
    MeshWord part{corner.begin, 0};
    const char* const end = corner.begin + corner.length;
    std::int64_t vertex = 0;
    for (int number = 0; number < 3; ++number) {
      const char* const slash = std::find(part.begin, end, '/');
      part.length = static_cast<std::size_t>(slash - part.begin);
      if (part.length > 0 || number == 0) {
        const std::int64_t index = indexOf(part, corner);
        if (number == 0) vertex = index;
      }
      if (slash == end) return checked(vertex, corner);
      part.begin = slash + 1;
    }
    text_.refuse(quoted(corner) + ": must be v, v/vt, v//vn or v/vt/vn");
  }

  std::int64_t indexOf(const MeshWord& word, const MeshWord& corner) const {
    const bool is_signed = word.length > 0 && (*word.begin == '-' || *word.begin == '+');
    std::int64_t index = 0;
    for (std::size_t i = is_signed ? 1 : 0; i < word.length; ++i) {
      if (!isDigit(word.begin[i])) index = kMostIndex;
      index = std::min(10 * index + (word.begin[i] - '0'), kMostIndex);
    }
    if (index == 0 || index >= kMostIndex) {
      text_.refuse(quoted(corner) +
                   ": indices must be whole numbers from 1 on, or from -1 on backwards");
    }
    return *word.begin == '-' ? -index : index;
  }

  int checked(std::int64_t vertex, const MeshWord& corner) {
    if (vertex < -vertexCount()) {
      text_.refuse(
          fmt::format("{}: there are {} vertices before it", quoted(corner), vertexCount()));
    }
    if (vertex < 0) return static_cast<int>(vertexCount() + vertex);
    if (vertex > greatest_index_) {
      greatest_index_ = vertex;
      line_of_greatest_ = text_.line();
    }
    return static_cast<int>(vertex - 1);
  }

  MeshText text_;
  Vector3 scale_;
  std::string name_;
  PolygonMesh mesh_;
  std::int64_t greatest_index_ = 0;  // in a face; vertices may follow it
  int line_of_greatest_ = 0;
};

}  // namespace

PolygonMesh readObj(const std::string& content, const Vector3& scale, const std::string& name) {
  const FloatingPointEnvironment environment;
  return ObjReader(content, scale, name).read();
}

}  // namespace hovercraft
