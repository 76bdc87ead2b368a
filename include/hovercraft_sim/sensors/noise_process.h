#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/sensors/sensor_parameters.h"

namespace hovercraft {

/// The error of one measured quantity of three axes, sampled at a fixed period: white noise, a bias
/// that is a Gauss-Markov process or a random walk, and a turn-on bias. Draws are by counter (seed,
/// stream, tick of the sample): only the bias is remembered.
class HOVERCRAFT_PUBLIC NoiseProcess {
 public:
  /// What a run remembers of it.
  struct Memory {
    Vector3 bias;     // u
    Vector3 turn_on;  // u
  };
  static constexpr std::size_t kMemorySize = 6;  // doubles of a Memory

  /// @param period s between two samples. @param channel "vehicle/sensor/channel".
  NoiseProcess(const NoiseParameters& parameters, double period, const std::string& channel);

  /// At the start of a run: turn-on bias, and a bias of the stationary law (of a random walk 0).
  Memory start(std::int64_t seed) const;

  /// One sample: the bias goes on by a period, and what is measured of `truth` is returned.
  Vector3 measure(std::int64_t seed, Tick tick, const Vector3& truth, Memory& memory) const;

  /// Sigma of the white noise of a sample, u.
  double white() const { return white_; }
  /// Variance of a sample, u²: white noise, turn-on bias, and the bias where its law is stationary.
  double variance() const;

 private:
  Vector3 offset_ = Vector3::Zero();
  double gain_ = 0.0;        // 1 + scale
  double white_ = 0.0;       // u
  double turn_on_ = 0.0;     // u
  double decay_ = 0.0;       // of the bias in a period
  double kick_ = 0.0;        // u, of the bias in a period
  double stationary_ = 0.0;  // u; 0 of a random walk
  std::uint32_t stream_;
};

}  // namespace hovercraft
