#include "hovercraft_sim/geometry/mesh_edges.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/geometry/coordinates.h"
#include "hovercraft_sim/math/demand.h"

namespace hovercraft {
namespace {

bool isSameEdge(const MeshSide& a, const MeshSide& b) {
  return a.low == b.low && a.high == b.high;
}

/// Edges that break one rule: how many, the first of them, and to how many faces that belongs.
struct BadEdges {
  int count = 0;
  MeshSide first{};
  int faces_at_first = 0;

  void add(const MeshSide& edge, int faces) {
    if (count == 0) {
      first = edge;
      faces_at_first = faces;
    }
    ++count;
  }
};

struct EdgeReport {
  BadEdges open;     // of one face
  BadEdges crowded;  // of more than two
  BadEdges one_way;  // of two that run through it in the same direction

  /// An edge as it comes from the mesh: `forward` of its `faces` run from low to high.
  void add(const MeshSide& edge, int faces, int forward) {
    if (faces == 1) {
      open.add(edge, faces);
    } else if (faces > 2) {
      crowded.add(edge, faces);
    } else if (forward != 1) {
      one_way.add(edge, faces);
    }
  }
};

EdgeReport reportOnEdges(const PolygonMesh& mesh) {
  EdgeReport report;
  const std::vector<MeshSide> sides = sortedSides(mesh);
  for (std::size_t begin = 0; begin < sides.size();) {
    std::size_t end = begin;
    int forward = 0;
    while (end < sides.size() && isSameEdge(sides[end], sides[begin])) {
      forward += sides[end].forward ? 1 : 0;
      ++end;
    }
    report.add(sides[begin], static_cast<int>(end - begin), forward);
    begin = end;
  }
  return report;
}

std::string describe(const PolygonMesh& mesh, const BadEdges& bad, const char* kind) {
  return fmt::format("{} {} edge{}, the first from {} to {} m", bad.count, kind,
                     bad.count == 1 ? "" : "s",
                     coordinates(mesh.vertices[static_cast<std::size_t>(bad.first.low)]),
                     coordinates(mesh.vertices[static_cast<std::size_t>(bad.first.high)]));
}

}  // namespace

void refuseSurface(const std::string& name, const std::string& reason) {
  throw std::invalid_argument(name + ": " + reason);
}

std::vector<MeshSide> sortedSides(const PolygonMesh& mesh) {
  std::size_t count = 0;
  for (const std::vector<int>& face : mesh.faces) count += face.size();
  std::vector<MeshSide> sides;
  sides.reserve(count);
  for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<int>& face = mesh.faces[f];
    demand(face.size() >= 3, "a face has fewer than three vertices");
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int from = face[i];
      const int to = face[i + 1 < face.size() ? i + 1 : 0];
      demand(from >= 0 && static_cast<std::size_t>(from) < mesh.vertices.size() && from != to,
             "a face has a wrong vertex");
      sides.push_back({std::min(from, to), std::max(from, to), from < to, static_cast<int>(f)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const MeshSide& a, const MeshSide& b) {
    if (a.low != b.low) return a.low < b.low;
    if (a.high != b.high) return a.high < b.high;
    return a.forward != b.forward ? b.forward : a.face < b.face;
  });
  return sides;
}

std::vector<int> openVertices(const PolygonMesh& mesh) {
  const std::vector<MeshSide> sides = sortedSides(mesh);
  std::vector<int> open;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    if (i > 0 && isSameEdge(sides[i - 1], sides[i])) continue;
    if (i + 1 < sides.size() && isSameEdge(sides[i + 1], sides[i])) continue;
    open.insert(open.end(), {sides[i].low, sides[i].high});
  }
  std::sort(open.begin(), open.end());
  open.erase(std::unique(open.begin(), open.end()), open.end());
  return open;
}

void checkEdges(const PolygonMesh& mesh, const std::string& name) {
  const EdgeReport report = reportOnEdges(mesh);
  if (report.open.count > 0) {
    refuseSurface(name, "not closed: " + describe(mesh, report.open, "open") +
                            ": each edge must belong to two faces");
  }
  if (report.crowded.count > 0) {
    refuseSurface(
        name,
        fmt::format("not a simple surface: {}, which belongs to {} faces: each edge must belong "
                    "to two",
                    describe(mesh, report.crowded, "crowded"), report.crowded.faces_at_first));
  }
  if (report.one_way.count > 0) {
    refuseSurface(name, "inconsistent orientation: " + describe(mesh, report.one_way, "one-way") +
                            ": its two faces must run through it in opposite directions");
  }
}

}  // namespace hovercraft
