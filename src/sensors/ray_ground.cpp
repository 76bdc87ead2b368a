#include "hovercraft_sim/sensors/ray_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace hovercraft {
namespace {

constexpr double kMiss = std::numeric_limits<double>::infinity();

/// Where along one axis a ray crosses the next line of a grid.
struct LineWalk {
  double next = kMiss;  // m along the ray
  double step = kMiss;  // from line to line

  /// @param place in spacings from the first line. @param speed spacings per m of the ray.
  LineWalk(double place, double speed, double last) {
    if (speed == 0.0) return;
    step = 1.0 / std::abs(speed);
    double line = speed > 0.0 ? std::floor(place) + 1.0 : std::ceil(place) - 1.0;
    if (speed > 0.0) line = std::max(line, 0.0);
    if (speed < 0.0) line = std::min(line, last);
    const bool is_on_grid = line >= 0.0 && line <= last;
    if (is_on_grid) next = (line - place) / speed;
    remaining_ = speed > 0.0 ? last - line : line;
  }

  void advance() {
    remaining_ -= 1.0;
    next = remaining_ >= 0.0 ? next + step : kMiss;
  }

 private:
  double remaining_ = 0.0;  // lines behind the next one
};

/// The least s in [0, 1] at which the quadratic through f0 (s = 0), fm (1/2) and f1 (1) is 0 or
/// less; none: more than 1. @param f0 > 0.
double firstZero(double f0, double fm, double f1) {
  const double a = 2.0 * f0 - 4.0 * fm + 2.0 * f1;
  const double b = -3.0 * f0 + 4.0 * fm - f1;
  const double square = b * b - 4.0 * a * f0;
  if (square < 0.0) return kMiss;
  // Without cancellation: one root is q/a, the other f0/q.
  const double q = -0.5 * (b + (b < 0.0 ? -std::sqrt(square) : std::sqrt(square)));
  double first = kMiss;
  for (const double root : {a != 0.0 ? q / a : kMiss, q != 0.0 ? f0 / q : kMiss}) {
    if (root >= 0.0 && root <= 1.0) first = std::min(first, root);
  }
  if (first == kMiss && f1 <= 0.0) first = 1.0;  // lost by rounding at the end
  return first;
}

}  // namespace

RayGround::RayGround(std::shared_ptr<const HeightMapGround> map) : map_(std::move(map)) {
  const std::vector<double>& heights = map_->grid().heights;
  highest_ = *std::max_element(heights.begin(), heights.end());
}

RayGround::RayGround(const HeightGrid& grid)
    : RayGround(std::make_shared<const HeightMapGround>(grid)) {}

double RayGround::heightOver(const Vector3& p_W) const {
  const GroundPoint point = {p_W.x(), p_W.y(), 0.0};
  GroundQuery query;
  query.points = &point;
  query.count = 1;
  GroundSample sample = kOverNothing;
  map_->sample(query, &sample);
  return -sample.gap / sample.nz;
}

double RayGround::hitPlane(const Vector3& p_W, const Vector3& direction_W) const {
  const double gap = plane_.gap(p_W);
  if (gap <= 0.0) return 0.0;
  const double speed = dot(plane_.nhat_W, direction_W);
  return speed < 0.0 ? -gap / speed : kMiss;
}

double RayGround::hitMap(const Vector3& p_W, const Vector3& direction_W, double farthest) const {
  const double end_z = p_W.z() + farthest * direction_W.z();
  if (std::min(p_W.z(), end_z) > highest_) return kMiss;
  const auto above = [&](double t) {
    const Vector3 p = p_W + t * direction_W;
    return p.z() - heightOver(p);
  };
  const HeightGrid& grid = map_->grid();
  LineWalk along_x((p_W.x() - grid.x) / grid.spacing, direction_W.x() / grid.spacing,
                   static_cast<double>(grid.columns - 1));
  LineWalk along_y((p_W.y() - grid.y) / grid.spacing, direction_W.y() / grid.spacing,
                   static_cast<double>(grid.rows - 1));
  double t0 = 0.0;
  double f0 = above(0.0);
  while (f0 > 0.0 && t0 < farthest) {
    // It has left the ground below for good.
    if (direction_W.z() >= 0.0 && p_W.z() + t0 * direction_W.z() > highest_) return kMiss;
    const double t1 = std::min({along_x.next, along_y.next, farthest});
    const double f1 = above(t1);
    const double share = firstZero(f0, above(0.5 * (t0 + t1)), f1);
    if (share <= 1.0) return t0 + share * (t1 - t0);
    if (along_x.next <= t1) along_x.advance();
    if (along_y.next <= t1) along_y.advance();
    t0 = t1;
    f0 = f1;
  }
  return f0 <= 0.0 ? t0 : kMiss;
}

void RayGround::cast(const BeamFan& fan, const Pose& X_WS, double farthest, double* ranges) const {
  for (std::size_t beam = 0; beam < fan.cosines.size(); ++beam) {
    const Vector3 direction_W = times(X_WS.R_AB, Vector3(fan.cosines[beam], fan.sines[beam], 0.0));
    const double reach = std::min(farthest, ranges[beam]);
    const double range =
        map_ != nullptr ? hitMap(X_WS.p_AB, direction_W, reach) : hitPlane(X_WS.p_AB, direction_W);
    ranges[beam] = std::min(ranges[beam], range);
  }
}

}  // namespace hovercraft
