#pragma once

#include <algorithm>
#include <cstdint>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// Lets so many events through a second on the average, and `burst` at once (a token bucket), by
/// the readings of a steady clock.
class HOVERCRAFT_PUBLIC RateLimiter {
 public:
  /// @param per_second > 0. @param burst >= 1.
  RateLimiter(double per_second, double burst)
      : per_second_(per_second), burst_(burst), tokens_(burst) {}

  /// Whether an event at this time is within the rate; one that is counts.
  bool take(std::int64_t now_ns) {
    if (!started_ || now_ns > last_ns_) {
      const double seconds = started_ ? 1e-9 * static_cast<double>(now_ns - last_ns_) : 0.0;
      tokens_ = std::min(burst_, tokens_ + per_second_ * seconds);
      last_ns_ = now_ns;
      started_ = true;
    }
    if (tokens_ < 1.0) return false;
    tokens_ -= 1.0;
    return true;
  }

 private:
  double per_second_;
  double burst_;
  double tokens_;
  std::int64_t last_ns_ = 0;
  bool started_ = false;
};

}  // namespace hovercraft_ros
