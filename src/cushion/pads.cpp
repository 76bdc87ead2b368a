#include "hovercraft_sim/cushion/pads.h"

#include <algorithm>
#include <array>

namespace hovercraft {
namespace {

constexpr double kCarriers = 4.0;  // vertices that carry a body at its sink

/// Vertices asked for at once, an even number: what is needed of them lies on the stack.
constexpr std::size_t kBatch = 32;

}  // namespace

Pads::Pads(const std::vector<Vector3>& vertices_B, double weight, const PadParameters& parameters)
    : stiffness_(weight / (kCarriers * parameters.sink)), spring_(parameters.spring) {
  std::vector<PlacedElement> placed;
  for (const Vector3& p : vertices_B) placed.push_back({p, 0.0});
  const std::vector<MirrorPair> pairs = mirrorPairs(placed);
  for (const bool alone : {false, true}) {
    for (const MirrorPair& pair : pairs) {
      if ((pair[1] < 0) != alone) continue;
      for (const int index : pair) {
        if (index >= 0) vertices_B_.push_back(vertices_B[static_cast<std::size_t>(index)]);
      }
    }
    if (!alone) paired_ = vertices_B_.size();
  }
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
