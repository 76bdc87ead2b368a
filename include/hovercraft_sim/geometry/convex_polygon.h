#pragma once

#include <vector>

#include "hovercraft_sim/geometry/feature.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// A point or direction of the plane, m or without unit.
struct Vector2 {
  double x = 0.0;  // m, or without unit
  double y = 0.0;  // likewise
};

/// Component by component; a dot product.
inline Vector2 operator+(const Vector2& a, const Vector2& b) {
  return {a.x + b.x, a.y + b.y};
}
inline Vector2 operator-(const Vector2& a, const Vector2& b) {
  return {a.x - b.x, a.y - b.y};
}
inline Vector2 operator*(double factor, const Vector2& a) {
  return {factor * a.x, factor * a.y};
}
inline double dot(const Vector2& a, const Vector2& b) {
  return a.x * b.x + a.y * b.y;
}
/// Positive where b lies to the left of a.
inline double cross(const Vector2& a, const Vector2& b) {
  return a.x * b.y - a.y * b.x;
}

/// A convex polygon, counter-clockwise; edge i runs from vertex i to vertex i + 1. Invariants,
/// checked when made: at least three vertices, none twice, every corner turns left, once around.
class HOVERCRAFT_PUBLIC ConvexPolygon {
 public:
  struct Edge {
    Vector2 p;          // its first vertex
    Vector2 direction;  // unit
    double length;      // m
  };

  /// @throws std::invalid_argument naming the worst vertex. Coordinates are finite, below 1e150 m.
  explicit ConvexPolygon(std::vector<Vector2> vertices);

  int vertexCount() const { return static_cast<int>(vertices_.size()); }  // how many
  /// m, counter-clockwise.
  const Vector2& vertex(int index) const { return vertices_[static_cast<std::size_t>(index)]; }
  /// From vertex(index) to the next one.
  const Edge& edge(int index) const { return edges_[static_cast<std::size_t>(index)]; }
  /// Index of the vertex after it.
  int next(int index) const { return index + 1 < vertexCount() ? index + 1 : 0; }
  /// Index of the vertex before it.
  int previous(int index) const { return index > 0 ? index - 1 : vertexCount() - 1; }
  double radius() const { return radius_; }  // m, greatest distance of a vertex from the origin

  /// The rays that bound the Voronoi region of a vertex or an edge (z components are 0).
  std::vector<VoronoiPlane> voronoiPlanes(Feature feature) const;

 private:
  /// Once around, to the left at every vertex; throws if not.
  void checkTurns() const;

  std::vector<Vector2> vertices_;
  std::vector<Edge> edges_;
  double radius_ = 0.0;
};

/// The convex hull of points of the plane (monotone chain, Andrew 1979), without points on its
/// edges. @throws std::invalid_argument if they are not finite or lie on one line.
HOVERCRAFT_PUBLIC ConvexPolygon convexHull(std::vector<Vector2> points);

}  // namespace hovercraft
