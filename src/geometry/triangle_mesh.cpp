#include "hovercraft_sim/geometry/triangle_mesh.h"

#include <algorithm>
#include <assimp/Importer.hpp>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/geometry/coordinates.h"
#include "hovercraft_sim/geometry/shells.h"
#include "hovercraft_sim/geometry/volume_moments.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& reason) {
  throw std::invalid_argument(name + ": " + reason);
}

/// x -> linear x + shift
struct Affine {
  Matrix3 linear = Matrix3::Identity();
  Vector3 shift = Vector3::Zero();
};

Affine fromAssimp(const aiMatrix4x4& m) {
  Affine result;
  result.linear << m.a1, m.a2, m.a3, m.b1, m.b2, m.b3, m.c1, m.c2, m.c3;
  result.shift << m.a4, m.b4, m.c4;
  return result;
}

/// Collects triangles; vertices at equal positions become one.
class Welder {
 public:
  void add(const std::array<Vector3, 3>& corners) {
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) return;
    std::array<int, 3> triangle{};
    for (std::size_t i = 0; i < 3; ++i) triangle[i] = indexOf(corners[i]);
    mesh_.triangles.push_back(triangle);
  }
  TriangleMesh release() { return std::move(mesh_); }

 private:
  int indexOf(const Vector3& position) {
    const auto [entry, is_new] = indices_.try_emplace({position.x(), position.y(), position.z()},
                                                      static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back(position);
    return entry->second;
  }

  TriangleMesh mesh_;
  std::map<std::array<double, 3>, int> indices_;
};

void addMesh(const aiMesh& source, const Affine& place, const std::string& name, Welder& welder) {
  const bool mirrored = determinant(place.linear) < 0.0;
  for (unsigned f = 0; f < source.mNumFaces; ++f) {
    const aiFace& face = source.mFaces[f];
    if (face.mNumIndices != 3) continue;  // a point or a line: polygons are triangles by now
    std::array<Vector3, 3> corners;
    for (unsigned i = 0; i < 3; ++i) {
      const aiVector3D& p = source.mVertices[face.mIndices[i]];
      corners[i] = times(place.linear, Vector3(p.x, p.y, p.z)) + place.shift;
      if (!corners[i].allFinite()) refuse(name, "not finite: " + coordinates(corners[i]));
    }
    if (mirrored) std::swap(corners[1], corners[2]);
    welder.add(corners);
  }
}

void addNode(const aiScene& scene, const aiNode& node, const Affine& parent,
             const std::string& name, Welder& welder) {
  const Affine local = fromAssimp(node.mTransformation);
  const Affine place{product(parent.linear, local.linear),
                     times(parent.linear, local.shift) + parent.shift};
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    addMesh(*scene.mMeshes[node.mMeshes[i]], place, name, welder);
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    addNode(scene, *node.mChildren[i], place, name, welder);
  }
}

/// One side of a triangle, as an undirected edge with the direction in which the triangle runs.
struct TriangleSide {
  int low;
  int high;
  bool forward;  // from low to high

  friend bool operator<(const TriangleSide& a, const TriangleSide& b) {
    return std::array<int, 3>{a.low, a.high, a.forward ? 1 : 0} <
           std::array<int, 3>{b.low, b.high, b.forward ? 1 : 0};
  }
};

std::vector<TriangleSide> sortedTriangleSides(const TriangleMesh& mesh) {
  std::vector<TriangleSide> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int from = triangle[i];
      const int to = triangle[(i + 1) % 3];
      demand(from >= 0 && static_cast<std::size_t>(from) < mesh.vertices.size() && from != to,
             "a triangle has a wrong vertex");
      sides.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Edges that break one rule: how many, the first of them, and to how many triangles that belongs.
struct BadEdges {
  int count = 0;
  TriangleSide first{};
  int triangles_at_first = 0;

  void add(const TriangleSide& edge, int triangles) {
    if (count == 0) {
      first = edge;
      triangles_at_first = triangles;
    }
    ++count;
  }
};

struct EdgeReport {
  BadEdges open;     // of one triangle
  BadEdges crowded;  // of more than two
  BadEdges one_way;  // of two that run through it in the same direction

  /// An edge as it comes from the mesh: `forward` of its `triangles` run from low to high.
  void add(const TriangleSide& edge, int triangles, int forward) {
    if (triangles == 1) {
      open.add(edge, triangles);
    } else if (triangles > 2) {
      crowded.add(edge, triangles);
    } else if (forward != 1) {
      one_way.add(edge, triangles);
    }
  }
};

EdgeReport reportOnEdges(const TriangleMesh& mesh) {
  EdgeReport report;
  const std::vector<TriangleSide> sides = sortedTriangleSides(mesh);
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin;
    int forward = 0;
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high) {
      forward += sides[end].forward ? 1 : 0;
      ++end;
    }
    report.add(sides[begin], static_cast<int>(end - begin), forward);
    begin = end;
  }
  return report;
}

std::string describe(const TriangleMesh& mesh, const BadEdges& bad, const char* kind) {
  return fmt::format("{} {} edge{}, the first from {} to {} m", bad.count, kind,
                     bad.count == 1 ? "" : "s",
                     coordinates(mesh.vertices[static_cast<std::size_t>(bad.first.low)]),
                     coordinates(mesh.vertices[static_cast<std::size_t>(bad.first.high)]));
}

void checkEdges(const TriangleMesh& mesh, const std::string& name) {
  const EdgeReport report = reportOnEdges(mesh);
  if (report.open.count > 0) {
    refuse(name, "not closed: " + describe(mesh, report.open, "open") +
                     ": each edge must belong to two triangles");
  }
  if (report.crowded.count > 0) {
    refuse(name, fmt::format("not a simple surface: {}, which belongs to {} triangles: each edge "
                             "must belong to two",
                             describe(mesh, report.crowded, "crowded"),
                             report.crowded.triangles_at_first));
  }
  if (report.one_way.count > 0) {
    refuse(name, "inconsistent orientation: " + describe(mesh, report.one_way, "one-way") +
                     ": its two triangles must run through it in opposite directions");
  }
}

/// How far behind the surface a shell is compared with the others, in roundings of the largest
/// coordinate (-): beyond what rounding does to the common face of touching parts, but within the
/// thinnest shell that passes, which is 2 / kMeshVolume roundings thick.
constexpr double kSampleDepth = 10.0;

/// What a shell encloses, and the box around it.
struct Solid {
  double volume = 0.0;       // m³
  double uncertainty = 0.0;  // m³: the surface times the rounding of the largest coordinate
  double largest = 0.0;      // the largest coordinate, m
  Vector3 low;               // corners of the box, m
  Vector3 high;
  Vector3 sample = Vector3::Zero();  // a point of the body, just behind its largest triangle, m
};

Solid measure(const TriangleMesh& mesh) {
  Solid solid;
  solid.volume = signedVolume(mesh);
  solid.low = solid.high = mesh.vertices.front();
  for (const Vector3& p : mesh.vertices) {
    solid.low = solid.low.cwiseMin(p);
    solid.high = solid.high.cwiseMax(p);
    solid.largest = std::max(solid.largest, p.cwiseAbs().maxCoeff());
  }
  double surface = 0.0;
  double largest_area = 0.0;
  for (const auto& triangle : mesh.triangles) {
    const Vector3& a = mesh.vertices[static_cast<std::size_t>(triangle[0])];
    const Vector3& b = mesh.vertices[static_cast<std::size_t>(triangle[1])];
    const Vector3& c = mesh.vertices[static_cast<std::size_t>(triangle[2])];
    const Vector3 normal = cross(b - a, c - a);
    const double area = 0.5 * norm(normal);
    surface += area;
    if (area <= largest_area) continue;
    largest_area = area;
    solid.sample = a + ((b - a) + (c - a)) / 3.0 -
                   (kSampleDepth * kMeshCoordinate * solid.largest / (2.0 * area)) * normal;
  }
  solid.uncertainty = surface * solid.largest * kMeshCoordinate;
  return solid;
}

void checkVolume(const Solid& solid, const std::string& name) {
  if (solid.volume < -solid.uncertainty) {
    refuse(name,
           fmt::format("inside out: its volume is {:.12g} m^3: seen from outside, the vertices of "
                       "each face must run counter-clockwise",
                       solid.volume));
  }
  if (!(solid.uncertainty <= kMeshVolume * solid.volume)) {
    refuse(
        name,
        fmt::format(
            "volume = {:.12g} m^3 with an uncertainty of {:.12g} m^3, as coordinates of {:.12g} m "
            "are rounded to {:g} of themselves: must be known to {:g} %",
            solid.volume, solid.uncertainty, solid.largest, kMeshCoordinate, 100.0 * kMeshVolume));
  }
}

bool contains(const Solid& solid, const Vector3& point) {
  return (solid.low.array() <= point.array()).all() && (point.array() <= solid.high.array()).all();
}

/// Checks that a shell in no other one faces outwards and a shell in another one (a cavity)
/// inwards, and so on for what is in a cavity.
void checkShells(const TriangleMesh& mesh, const std::string& name) {
  const std::vector<TriangleMesh> shells = shellsOf(mesh);
  if (shells.size() == 1) return;
  std::vector<Solid> solids;
  solids.reserve(shells.size());
  for (const TriangleMesh& shell : shells) solids.push_back(measure(shell));
  for (std::size_t i = 0; i < shells.size(); ++i) {
    if (std::abs(solids[i].volume) <= solids[i].uncertainty) continue;  // adds nothing
    double winding = 0.0;  // of all others around this one
    for (std::size_t j = 0; j < shells.size(); ++j) {
      if (j == i || !contains(solids[j], solids[i].sample)) continue;
      winding += windingNumber(shells[j], solids[i].sample);
    }
    const bool is_inside = winding > 0.5;
    if (is_inside == (solids[i].volume < 0.0)) continue;
    refuse(name,
           fmt::format(
               "the shell with the vertex {} m has the volume {:.12g} m^3 and lies {}: a shell "
               "must face outwards, the wall of a cavity inwards",
               coordinates(shells[i].vertices.front()), solids[i].volume,
               is_inside ? "inside another" : "in no other"));
  }
}

}  // namespace

void checkClosed(const TriangleMesh& mesh, const std::string& name) {
  const FloatingPointEnvironment environment;
  if (mesh.triangles.empty()) refuse(name, "no triangles");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
    if (mesh.vertices[i].allFinite()) continue;
    refuse(name, fmt::format("vertex {} is not finite: {}", i, coordinates(mesh.vertices[i])));
  }
  checkEdges(mesh, name);
  checkVolume(measure(mesh), name);
  checkShells(mesh, name);
}

TriangleMesh loadSurface(const std::string& path) {
  const FloatingPointEnvironment environment;
  const std::string name = "mesh file '" + path + "'";
  if (!std::ifstream(path)) refuse(name, "does not exist or cannot be read");
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (scene == nullptr || scene->mRootNode == nullptr) {
    const std::string reason = importer.GetErrorString();
    refuse(name, "not a mesh that assimp reads: " + reason.substr(0, reason.find('\n')));
  }
  Welder welder;
  addNode(*scene, *scene->mRootNode, Affine{}, name, welder);
  TriangleMesh mesh = welder.release();
  if (mesh.triangles.empty()) refuse(name, "no triangles");
  return mesh;
}

TriangleMesh loadTriangleMesh(const std::string& path) {
  const FloatingPointEnvironment environment;
  TriangleMesh mesh = loadSurface(path);
  checkClosed(mesh, "mesh file '" + path + "'");
  return mesh;
}

}  // namespace hovercraft
