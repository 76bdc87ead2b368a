#include "hovercraft_sim/cushion/pads.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

constexpr double kCarriers = 4.0;  // vertices that carry a body at its sink

/// Share (-) of the coordinates by which a box must be clear of a plane: rounding of some ten
/// operations, 2e-15 of them, never is as much.
constexpr double kClearShare = 1e-12;

/// Vertices asked for at once, an even number: what is needed of them lies on the stack.
constexpr std::size_t kBatch = 32;

}  // namespace

Pads::Pads(const std::vector<Vector3>& vertices_B, double weight, const PadParameters& parameters)
    : spring_(parameters.spring) {
  const FloatingPointEnvironment environment;
  stiffness_ = weight / (kCarriers * parameters.sink);
  std::vector<PlacedElement> placed;
  placed.reserve(vertices_B.size());
  for (const Vector3& p : vertices_B) placed.push_back({p, 0.0});
  const std::vector<MirrorPair> pairs = mirrorPairs(placed);
  const auto add = [&](int index) {
    vertices_B_.push_back(vertices_B[static_cast<std::size_t>(index)]);
  };
  for (const MirrorPair& pair : pairs) {
    if (pair[1] < 0) continue;
    add(pair[0]);
    add(pair[1]);
  }
  paired_ = vertices_B_.size();
  for (const MirrorPair& pair : pairs) {
    if (pair[1] < 0) add(pair[0]);
  }
  surround();
}

/// The box around the vertices.
void Pads::surround() {
  if (vertices_B_.empty()) return;
  Vector3 low = vertices_B_.front();
  Vector3 high = low;
  for (const Vector3& p : vertices_B_) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  middle_B_ = 0.5 * (low + high);
  half_extent_ = 0.5 * (high - low);
}

/// Whether all vertices are above a plane, so that none of them presses: by the box around them,
/// for less than vertex by vertex.
bool Pads::isClearOf(const GroundPlane& plane, const BodyMotion& motion) const {
  const Vector3 nhat_B = transposeTimes(motion.R_WB, plane.nhat_W);
  const double reach = dot(nhat_B.cwiseAbs(), half_extent_);
  const double least = (plane.gap(motion.p_WB) + dot(nhat_B, middle_B_)) - reach;
  const Vector3 size = motion.p_WB.cwiseAbs() + middle_B_.cwiseAbs() + half_extent_;
  return least > kClearShare * (size.x() + size.y() + size.z() + std::abs(plane.offset));
}

Wrench Pads::wrenchOf(const Vector3& p_B, const BodyMotion& motion,
                      const GroundSample& sample) const {
  if (!(sample.gap < 0.0)) return {};
  const Vector3 nhat_B = transposeTimes(motion.R_WB, sample.normal());
  const Vector3 force = spring_.force(-stiffness_ * sample.gap, nhat_B, motion.velocityAt(p_B));
  return {force, cross(p_B, force)};
}

Wrench Pads::wrenchInBody(const BodyMotion& motion, const Ground& ground) const {
  Wrench sum;
  const GroundPlane* const plane = ground.plane();
  if (plane != nullptr && isClearOf(*plane, motion)) return sum;
  for (std::size_t first = 0; first < vertices_B_.size(); first += kBatch) {
    const std::size_t end = std::min(first + kBatch, vertices_B_.size());
    std::array<GroundPoint, kBatch> points;
    std::array<GroundSample, kBatch> samples;
    for (std::size_t i = first; i < end; ++i) {
      const Vector3 p_W = times(motion.R_WB, vertices_B_[i]) + motion.p_WB;
      points[i - first] = {p_W.x(), p_W.y(), p_W.z()};
    }
    ground.sample({points.data(), static_cast<int>(end - first), motion.p_WB.z(), kNoGround},
                  samples.data());
    for (std::size_t i = first; i < end; ++i) {
      const Wrench wrench = wrenchOf(vertices_B_[i], motion, samples[i - first]);
      if (i >= paired_) {
        sum = sum + wrench;
        continue;
      }
      ++i;
      sum = sum + (wrench + wrenchOf(vertices_B_[i], motion, samples[i - first]));
    }
  }
  return sum;
}

}  // namespace hovercraft
