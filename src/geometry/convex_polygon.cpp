#include "hovercraft_sim/geometry/convex_polygon.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

namespace hovercraft {
namespace {

[[noreturn]] void refuse(const std::string& reason) {
  throw std::invalid_argument("convex polygon: " + reason);
}

VoronoiPlane plane(const Vector2& normal, const Vector2& point, Feature behind) {
  return {{normal.x, normal.y, 0.0}, dot(normal, point), behind};
}

}  // namespace

ConvexPolygon::ConvexPolygon(std::vector<Vector2> vertices) : vertices_(std::move(vertices)) {
  if (vertices_.size() < 3) {
    refuse(fmt::format("has {} vertices, it takes at least 3", vertices_.size()));
  }
  for (int i = 0; i < vertexCount(); ++i) {
    const Vector2 along = vertex(next(i)) - vertex(i);
    const double length = std::sqrt(dot(along, along));
    if (!(length > 0.0) || !(length < 1e300)) {
      refuse(fmt::format("vertex {} is not finite or is the same as the one before", next(i)));
    }
    edges_.push_back({vertex(i), (1.0 / length) * along, length});
    radius_ = std::max(radius_, std::sqrt(dot(vertex(i), vertex(i))));
  }
  checkTurns();
}

void ConvexPolygon::checkTurns() const {
  double worst = 1.0;
  int worst_vertex = 0;
  int turns_from_down_to_up = 0;  // once around the circle of directions
  for (int i = 0; i < vertexCount(); ++i) {
    const Vector2& before = edge(previous(i)).direction;
    const Vector2& after = edge(i).direction;
    const double turn = cross(before, after);
    if (turn < worst) {
      worst = turn;
      worst_vertex = i;
    }
    const bool was_down = before.y < 0.0 || (before.y == 0.0 && before.x < 0.0);
    const bool is_down = after.y < 0.0 || (after.y == 0.0 && after.x < 0.0);
    if (was_down && !is_down) ++turns_from_down_to_up;
  }
  if (!(worst > 0.0)) {
    refuse(
        fmt::format("is not convex and counter-clockwise: at vertex {} ({}, {}) the sine of the "
                    "turn is {}, it must be positive",
                    worst_vertex, vertex(worst_vertex).x, vertex(worst_vertex).y, worst));
  }
  if (turns_from_down_to_up != 1) {
    refuse(fmt::format("winds {} times around", turns_from_down_to_up));
  }
}

std::vector<VoronoiPlane> ConvexPolygon::voronoiPlanes(Feature feature) const {
  const int i = feature.index;
  if (feature.kind == FeatureKind::kVertex) {
    const Vector2 backward = -1.0 * edge(previous(i)).direction;
    return {plane(backward, vertex(i), {FeatureKind::kEdge, previous(i)}),
            plane(edge(i).direction, vertex(i), {FeatureKind::kEdge, i})};
  }
  const Edge& e = edge(i);
  VoronoiPlane base = plane({-e.direction.y, e.direction.x}, e.p, {});
  base.behind.reset();
  return {plane(-1.0 * e.direction, e.p, {FeatureKind::kVertex, i}),
          plane(e.direction, vertex(next(i)), {FeatureKind::kVertex, next(i)}), base};
}

ConvexPolygon convexHull(std::vector<Vector2> points) {
  const auto less = [](const Vector2& a, const Vector2& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  };
  std::sort(points.begin(), points.end(), less);
  std::vector<Vector2> chain;
  const auto add = [&chain](const Vector2& p, std::size_t floor) {
    while (chain.size() >= floor + 2 &&
           cross(chain.back() - chain[chain.size() - 2], p - chain.back()) <= 0.0) {
      chain.pop_back();
    }
    chain.push_back(p);
  };
  for (const Vector2& p : points) add(p, 0);
  const std::size_t lower = chain.size();
  for (std::size_t i = points.size(); i-- > 0;) add(points[i], lower - 1);
  if (!chain.empty()) chain.pop_back();
  return ConvexPolygon(std::move(chain));
}

}  // namespace hovercraft
