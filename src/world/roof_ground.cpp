#include "hovercraft_sim/world/roof_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

/// Vertical share (-) of a face's normal up to which the face is upright: over a metre it hides
/// 1 nm of height, and its height over (x, y) would be as steep as a billion to one.
constexpr double kUpright = 1e-9;

/// Share (-) of the numbers of a wall's test that its rounding, some 4e-16 of them, never reaches.
constexpr double kWithinShare = 1e-12;

constexpr double kFar = std::numeric_limits<double>::max();

}  // namespace

void RoofGround::add(const ConvexPolyhedron& body, const Pose& X_WO) {
  const FloatingPointEnvironment environment;
  Roof roof = {{kFar, kFar, -kFar, -kFar}, {}, {}, {}};
  Rectangle& around = roof.around;
  for (int i = 0; i < body.vertexCount(); ++i) {
    const Vector3 p = transform(X_WO, body.vertex(i));
    around.low_x = std::min(around.low_x, p.x());
    around.low_y = std::min(around.low_y, p.y());
    around.high_x = std::max(around.high_x, p.x());
    around.high_y = std::max(around.high_y, p.y());
  }
  for (int i = 0; i < body.faceCount(); ++i) {
    const PolyhedronData::Face& face = body.face(i);
    const Vector3 n = times(X_WO.R_AB, face.normal);
    const double offset = face.offset + dot(n, X_WO.p_AB);
    if (std::abs(n.z()) <= kUpright) {
      roof.walls.push_back({n.x(), n.y(), offset});
      continue;
    }
    const Slope slope = {offset / n.z(), -n.x() / n.z(), -n.y() / n.z()};
    if (n.z() > 0.0) {
      roof.tops.push_back({slope, n.x(), n.y(), n.z()});
    } else {
      roof.bottoms.push_back(slope);
    }
  }
  roofs_.push_back(std::move(roof));
}

bool RoofGround::holds(const Roof& roof, const GroundPoint& point) {
  const Rectangle& around = roof.around;
  if (point.x < around.low_x || point.x > around.high_x || point.y < around.low_y ||
      point.y > around.high_y) {
    return false;
  }
  return std::all_of(roof.walls.begin(), roof.walls.end(), [&](const Wall& wall) {
    return wall.nx * point.x + wall.ny * point.y <= wall.offset;
  });
}

/// Whether the roof holds every point of a rectangle, so that none needs to be asked by itself: so
/// far within each wall that rounding decides nothing.
bool RoofGround::holdsAll(const Roof& roof, const Rectangle& points) {
  const Rectangle& around = roof.around;
  if (points.low_x < around.low_x || points.high_x > around.high_x || points.low_y < around.low_y ||
      points.high_y > around.high_y) {
    return false;
  }
  return std::all_of(roof.walls.begin(), roof.walls.end(), [&](const Wall& wall) {
    const double x = wall.nx * (wall.nx > 0.0 ? points.high_x : points.low_x);
    const double y = wall.ny * (wall.ny > 0.0 ? points.high_y : points.low_y);
    const double size = std::abs(x) + std::abs(y) + std::abs(wall.offset);
    return x + y < wall.offset - kWithinShare * size;
  });
}

/// The face of the roof above or below a point of (x, y) that it holds; none where it hangs above
/// `below`. @param height of it, m.
const RoofGround::Top* RoofGround::topUnder(const Roof& roof, const GroundPoint& point,
                                            double below, double& height) {
  const Top* lowest = nullptr;
  height = kFar;
  for (const Top& top : roof.tops) {
    const double z = top.slope.at(point);
    if (z >= height) continue;
    height = z;
    lowest = &top;
  }
  double underside = -kFar;
  for (const Slope& bottom : roof.bottoms) underside = std::max(underside, bottom.at(point));
  return height >= underside && underside < below ? lowest : nullptr;
}

/// Takes the roof where it is higher than what was found. @param holds_all whether it holds all
/// points of the query.
void RoofGround::lift(const Roof& roof, const GroundQuery& query, bool holds_all,
                      GroundSample* samples) {
  for (int i = 0; i < query.count; ++i) {
    const GroundPoint& point = query.points[i];
    if (!holds_all && !holds(roof, point)) continue;
    double height = 0.0;
    const Top* top = topUnder(roof, point, query.below, height);
    if (top == nullptr) continue;
    const double above = point.z - height;
    if (above < -query.reach) continue;
    GroundSample& sample = samples[i];
    if (sample.gap < above * sample.nz) continue;
    sample = {above * top->nz, top->nx, top->ny, top->nz};
  }
}

void RoofGround::sample(const GroundQuery& query, GroundSample* samples) const {
  if (base_ != nullptr) {
    base_->sample(query, samples);
  } else {
    std::fill_n(samples, query.count, kOverNothing);
  }
  Rectangle points = {kFar, kFar, -kFar, -kFar};
  for (int i = 0; i < query.count; ++i) {
    const GroundPoint& point = query.points[i];
    points.low_x = std::min(points.low_x, point.x);
    points.low_y = std::min(points.low_y, point.y);
    points.high_x = std::max(points.high_x, point.x);
    points.high_y = std::max(points.high_y, point.y);
  }
  for (const Roof& roof : roofs_) {
    const Rectangle& around = roof.around;
    if (around.high_x < points.low_x || around.low_x > points.high_x ||
        around.high_y < points.low_y || around.low_y > points.high_y) {
      continue;
    }
    lift(roof, query, holdsAll(roof, points), samples);
  }
}

}  // namespace hovercraft
