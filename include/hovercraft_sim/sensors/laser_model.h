#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "hovercraft_sim/math/noise.h"
#include "hovercraft_sim/sensors/sensor_mount.h"

namespace hovercraft {

/// The range that stands for "nothing within range_max".
constexpr double kNoReturn = -1.0;

/// A range as REP 117 tells it: -inf below range_min, inf above range_max or without a return.
inline double reportedRange(const LaserParameters& laser, double range) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (range < 0.0 || range > laser.range_max) return kInfinity;
  return range < laser.range_min ? -kInfinity : range;
}

/// Ranges of all beams at one instant. Its own craft is not seen. A range that noise makes negative
/// is 0; below range_min and above range_max they are left to whoever tells them (REP 117).
class LaserModel : public SensorModel {
 public:
  /// @param site of its own craft, which it does not see.
  LaserModel(const LaserParameters& parameters, const SensorMount& mount, const SensorSite& site);

  std::size_t memorySize() const override { return NoiseProcess::kMemorySize; }
  std::size_t sampleSize() const override { return fan_.cosines.size(); }
  void start(const SensedInstant& instant, double* memory) const override;
  void measure(const SensedInstant& instant, double* memory, double* sample) override;

 private:
  void addNoise(const SensedInstant& instant, double* memory, double* sample) const;

  NoiseProcess noise_;  // but for the white noise, which each beam has by itself
  double white_;        // m
  double gain_;
  std::uint32_t beam_stream_;
  double range_max_;
  Matrix3 R_BS_;
  Vector3 p_BS_;
  std::int32_t body_;
  const std::vector<RayTarget>& targets_;
  const RayGround* ground_;
  BeamFan fan_;
  std::vector<HalfSpace> faces_;  // scratch
};

}  // namespace hovercraft
