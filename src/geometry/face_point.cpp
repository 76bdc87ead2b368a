#include "hovercraft_sim/geometry/face_point.h"

#include <cmath>
#include <cstddef>

#include "hovercraft_sim/geometry/convex_polygon.h"

namespace hovercraft {
namespace {

/// The corners of a face along the axis that its normal is nearest to, counter-clockwise.
std::vector<Vector2> projected(const PolygonMesh& mesh, const std::vector<int>& face) {
  const Vector3 normal = twiceArea(mesh, face);
  int axis = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
  }
  const int x = (axis + 1) % 3;
  const int y = (axis + 2) % 3;
  const bool is_mirrored = normal[axis] < 0.0;
  std::vector<Vector2> corners;
  corners.reserve(face.size());
  for (const int v : face) {
    const Vector3& p = mesh.vertices[static_cast<std::size_t>(v)];
    corners.push_back(is_mirrored ? Vector2{p[y], p[x]} : Vector2{p[x], p[y]});
  }
  return corners;
}

bool isBefore(const Vector2& a, const Vector2& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

/// A corner at which the polygon is convex: the lowest one.
std::size_t convexCorner(const std::vector<Vector2>& corners) {
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (isBefore(corners[i], corners[lowest])) lowest = i;
  }
  return lowest;
}

}  // namespace

Vector3 pointInFace(const PolygonMesh& mesh, const std::vector<int>& face) {
  const auto vertex = [&](std::size_t i) -> const Vector3& {
    return mesh.vertices[static_cast<std::size_t>(face[i])];
  };
  const auto middle = [&](std::size_t a, std::size_t b, std::size_t c) -> Vector3 {
    return vertex(a) + ((vertex(b) - vertex(a)) + (vertex(c) - vertex(a))) / 3.0;
  };
  const std::size_t count = face.size();
  if (count == 3) return middle(0, 1, 2);
  const std::vector<Vector2> corners = projected(mesh, face);
  const std::size_t v = convexCorner(corners);
  const std::size_t a = v == 0 ? count - 1 : v - 1;
  const std::size_t b = v + 1 == count ? 0 : v + 1;
  // The corner in the triangle a v b that is farthest from the line through a and b sees v.
  std::size_t nearest = v;
  double farthest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector2& p = corners[i];
    const double from_line = cross(corners[a] - corners[b], p - corners[b]);
    const bool is_in_triangle = from_line > 0.0 &&
                                cross(corners[v] - corners[a], p - corners[a]) >= 0.0 &&
                                cross(corners[b] - corners[v], p - corners[v]) >= 0.0;
    const bool is_corner = i == v || i == a || i == b || face[i] == face[v];
    if (is_corner || !is_in_triangle || from_line <= farthest) continue;
    farthest = from_line;
    nearest = i;
  }
  return nearest == v ? middle(a, v, b) : Vector3(0.5 * (vertex(v) + vertex(nearest)));
}

}  // namespace hovercraft
