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

constexpr double kFar = std::numeric_limits<double>::max();

}  // namespace

void RoofGround::add(const ConvexPolyhedron& body, const Pose& X_WO) {
  const FloatingPointEnvironment environment;
  Roof roof = {kFar, kFar, -kFar, -kFar, {}, {}, {}};
  for (int i = 0; i < body.vertexCount(); ++i) {
    const Vector3 p = transform(X_WO, body.vertex(i));
    roof.low_x = std::min(roof.low_x, p.x());
    roof.low_y = std::min(roof.low_y, p.y());
    roof.high_x = std::max(roof.high_x, p.x());
    roof.high_y = std::max(roof.high_y, p.y());
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
  if (point.x < roof.low_x || point.x > roof.high_x || point.y < roof.low_y ||
      point.y > roof.high_y) {
    return false;
  }
  return std::all_of(roof.walls.begin(), roof.walls.end(), [&](const Wall& wall) {
    return wall.nx * point.x + wall.ny * point.y <= wall.offset;
  });
}

/// The face of the roof above or below a point of (x, y); none where the roof does not reach, or
/// hangs above `below`. @param height of it, m.
const RoofGround::Top* RoofGround::topUnder(const Roof& roof, const GroundPoint& point,
                                            double below, double& height) {
  if (!holds(roof, point)) return nullptr;
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

/// Takes the roof where it is higher than what was found.
void RoofGround::lift(const Roof& roof, const GroundQuery& query, GroundSample* samples) const {
  for (int i = 0; i < query.count; ++i) {
    const GroundPoint& point = query.points[i];
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
  double low_x = kFar;
  double low_y = kFar;
  double high_x = -kFar;
  double high_y = -kFar;
  for (int i = 0; i < query.count; ++i) {
    const GroundPoint& point = query.points[i];
    low_x = std::min(low_x, point.x);
    low_y = std::min(low_y, point.y);
    high_x = std::max(high_x, point.x);
    high_y = std::max(high_y, point.y);
  }
  for (const Roof& roof : roofs_) {
    if (roof.high_x < low_x || roof.low_x > high_x || roof.high_y < low_y || roof.low_y > high_y) {
      continue;
    }
    lift(roof, query, samples);
  }
}

}  // namespace hovercraft
