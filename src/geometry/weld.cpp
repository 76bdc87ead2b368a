#include "hovercraft_sim/geometry/weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "hovercraft_sim/geometry/mesh_edges.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

bool isLess(const Vector3& a, const Vector3& b) {
  if (a.x() != b.x()) return a.x() < b.x();
  if (a.y() != b.y()) return a.y() < b.y();
  return a.z() < b.z();
}

/// For each vertex the one with the lowest index at its position.
std::vector<int> firstAtPosition(const std::vector<Vector3>& vertices) {
  std::vector<int> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  const auto position = [&](int v) -> const Vector3& {
    return vertices[static_cast<std::size_t>(v)];
  };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    if (isLess(position(a), position(b))) return true;
    return !isLess(position(b), position(a)) && a < b;
  });
  std::vector<int> first(vertices.size());
  int current = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int v = order[i];
    if (i == 0 || isLess(position(current), position(v))) current = v;
    first[static_cast<std::size_t>(v)] = current;
  }
  return first;
}

/// The corners of a face, each replaced by `target`, without those that are like the one before.
std::vector<int> replacedCorners(const std::vector<int>& face, const std::vector<int>& target) {
  std::vector<int> corners;
  corners.reserve(face.size());
  for (const int v : face) {
    const int replacement = target[static_cast<std::size_t>(v)];
    if (corners.empty() || corners.back() != replacement) corners.push_back(replacement);
  }
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

/// The mesh with each vertex replaced by `target`.
PolygonMesh replaced(const PolygonMesh& mesh, const std::vector<int>& target) {
  constexpr int none = -1;
  PolygonMesh result;
  result.rounding = mesh.rounding;
  result.faces.reserve(mesh.faces.size());
  std::vector<int> new_index(mesh.vertices.size(), none);
  for (const std::vector<int>& face : mesh.faces) {
    std::vector<int> corners = replacedCorners(face, target);
    if (corners.size() < 3) continue;
    for (int& v : corners) {
      int& index = new_index[static_cast<std::size_t>(v)];
      if (index == none) {
        index = static_cast<int>(result.vertices.size());
        result.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
      }
      v = index;
    }
    result.faces.push_back(std::move(corners));
  }
  return result;
}

/// Points that were met, to be found by their position: in cells twice as long as the reach, so
/// that what is near a point lies in its cell or in one of those on its nearer sides.
class Neighbourhood {
 public:
  /// @param reach along each axis, m.
  Neighbourhood(const PolygonMesh& mesh, double reach)
      : vertices_(mesh.vertices), origin_(mesh.vertices.front()), reach_(reach) {}

  /// The first point within reach of vertex v, or v itself, which is then remembered.
  int firstNear(int v) {
    const Vector3& p = vertices_[static_cast<std::size_t>(v)];
    Cell cell{};
    Cell beside{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto axis = static_cast<Eigen::Index>(i);
      const double place = (p[axis] - origin_[axis]) / (2.0 * reach_);
      cell[i] = static_cast<std::int64_t>(std::floor(place));
      beside[i] = cell[i] + (place - std::floor(place) < 0.5 ? -1 : 1);
    }
    int first = v;
    for (unsigned n = 0; n < 8; ++n) {
      first = std::min(
          first, firstIn({(n & 1U) != 0 ? beside[0] : cell[0], (n & 2U) != 0 ? beside[1] : cell[1],
                          (n & 4U) != 0 ? beside[2] : cell[2]},
                         v));
    }
    if (first == v) points_[cell].push_back(v);
    return first;
  }

 private:
  using Cell =
      std::array<std::int64_t, 3>;  // at most 1 / (2 kWeldDistance) from that of the origin

  /// The first point of the cell within reach of vertex v, or v.
  int firstIn(const Cell& cell, int v) const {
    const auto entry = points_.find(cell);
    if (entry == points_.end()) return v;
    int first = v;
    for (const int other : entry->second) {
      const Vector3 apart =
          vertices_[static_cast<std::size_t>(other)] - vertices_[static_cast<std::size_t>(v)];
      if (apart.cwiseAbs().maxCoeff() <= reach_) first = std::min(first, other);
    }
    return first;
  }

  const std::vector<Vector3>& vertices_;
  Vector3 origin_;
  double reach_;
  std::map<Cell, std::vector<int>> points_;
};

}  // namespace

PolygonMesh joinedVertices(const PolygonMesh& mesh) {
  return replaced(mesh, firstAtPosition(mesh.vertices));
}

std::optional<WeldedMesh> weldedShut(const PolygonMesh& mesh) {
  const FloatingPointEnvironment environment;
  const std::vector<int> candidates = openVertices(mesh);
  if (candidates.empty()) return std::nullopt;
  const double reach = kWeldDistance * extentOf(mesh);
  if (!(reach > 0.0)) return std::nullopt;
  std::vector<int> target(mesh.vertices.size());
  std::iota(target.begin(), target.end(), 0);
  Neighbourhood neighbourhood(mesh, reach);
  WeldedMesh welded;
  for (const int v : candidates) {
    const int other = neighbourhood.firstNear(v);
    if (other == v) continue;
    target[static_cast<std::size_t>(v)] = other;
    ++welded.joined;
    welded.farthest =
        std::max(welded.farthest, norm(mesh.vertices[static_cast<std::size_t>(other)] -
                                       mesh.vertices[static_cast<std::size_t>(v)]));
  }
  if (welded.joined == 0) return std::nullopt;
  welded.mesh = replaced(mesh, target);
  if (!openVertices(welded.mesh).empty()) return std::nullopt;
  return welded;
}

}  // namespace hovercraft
