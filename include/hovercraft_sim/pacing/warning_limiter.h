#pragma once

#include <cstdint>
#include <optional>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// Says when a warning may be given again: once a second at most, on a steady clock
/// (ROS_WARN_THROTTLE counts in ROS time, which a simulation stops, hurries and slows).
class HOVERCRAFT_PUBLIC WarningLimiter {
 public:
  bool isDue(std::int64_t now_ns) {
    if (last_ns_ && now_ns - *last_ns_ < kPeriodNs) return false;
    last_ns_ = now_ns;
    return true;
  }

 private:
  static constexpr std::int64_t kPeriodNs = 1000000000;
  std::optional<std::int64_t> last_ns_;
};

}  // namespace hovercraft
