#include "hovercraft_sim/geometry/convex_polygon.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

[[noreturn]] void refuse(const std::string& reason) {
  throw std::invalid_argument("convex polygon: " + reason);
}

/// Squares of coordinates up to here stay far from the largest double.
constexpr double kLargestCoordinate = 1e150;

void checkFinite(const std::vector<Vector2>& points, const char* what) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vector2& p = points[i];
    if (std::abs(p.x) < kLargestCoordinate && std::abs(p.y) < kLargestCoordinate) continue;
    refuse(fmt::format("{} {} at ({}, {}) m is not finite or too large", what, i, p.x, p.y));
  }
}

Vector2 directionOf(const Vector2& along) {
  return (1.0 / std::sqrt(dot(along, along))) * along;
}

/// Whether a polygon keeps its corner q between p and r: it turns left there by the same sine that
/// checkTurns() computes.
bool turnsLeft(const Vector2& p, const Vector2& q, const Vector2& r) {
  return cross(directionOf(q - p), directionOf(r - q)) > 0.0;
}

/// Leaves out the corners that are straight to rounding, also at both ends of the chains.
void dropStraightCorners(std::vector<Vector2>& ring) {
  for (std::size_t i = 0; i < ring.size() && ring.size() > 2;) {
    const Vector2& before = ring[(i + ring.size() - 1) % ring.size()];
    const Vector2& after = ring[(i + 1) % ring.size()];
    const bool goes_on = dot(ring[i] - before, after - ring[i]) > 0.0;  // not the tip of a needle
    if (!goes_on || turnsLeft(before, ring[i], after)) {
      ++i;
      continue;
    }
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;  // its neighbours have turned
  }
}

VoronoiPlane plane(const Vector2& normal, const Vector2& point, Feature behind) {
  return {{normal.x, normal.y, 0.0}, dot(normal, point), behind};
}

}  // namespace

ConvexPolygon::ConvexPolygon(std::vector<Vector2> vertices) : vertices_(std::move(vertices)) {
  const FloatingPointEnvironment environment;
  if (vertices_.size() < 3) {
    refuse(fmt::format("has {} vertices, it takes at least 3", vertices_.size()));
  }
  checkFinite(vertices_, "vertex");
  for (int i = 0; i < vertexCount(); ++i) {
    const Vector2 along = vertex(next(i)) - vertex(i);
    const double length = std::sqrt(dot(along, along));
    if (!(length > 0.0)) {
      refuse(fmt::format("vertices {} and {} are both at ({}, {})", i, next(i), vertex(i).x,
                         vertex(i).y));
    }
    edges_.push_back({vertex(i), directionOf(along), length});
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
  const FloatingPointEnvironment environment;
  checkFinite(points, "point");
  const auto less = [](const Vector2& a, const Vector2& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  };
  const auto same = [](const Vector2& a, const Vector2& b) { return a.x == b.x && a.y == b.y; };
  std::sort(points.begin(), points.end(), less);
  points.erase(std::unique(points.begin(), points.end(), same), points.end());
  if (points.size() < 3) {
    refuse(fmt::format("{} different points have no hull, it takes at least 3", points.size()));
  }
  std::vector<Vector2> chain;
  const auto add = [&chain](const Vector2& p, std::size_t floor) {
    while (chain.size() >= floor + 2 && !turnsLeft(chain[chain.size() - 2], chain.back(), p)) {
      chain.pop_back();
    }
    chain.push_back(p);
  };
  for (const Vector2& p : points) add(p, 0);
  const std::size_t lower = chain.size();
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower - 1);
  chain.pop_back();
  dropStraightCorners(chain);
  if (chain.size() < 3) {
    refuse(fmt::format("the points lie on one line from ({}, {}) to ({}, {})", points.front().x,
                       points.front().y, points.back().x, points.back().y));
  }
  return ConvexPolygon(std::move(chain));
}

}  // namespace hovercraft
