#pragma once

#include <cstdint>

namespace hovercraft {

/// Number of a simulation step: t = tick · step size. Time is counted, never summed up.
using Tick = std::int64_t;

/// ns in 1 s.
constexpr std::int64_t kNanosecondsPerSecond = 1000000000;

/// Whole nanoseconds as seconds, rounded once.
inline double toSeconds(std::int64_t nanoseconds) {
  return static_cast<double>(nanoseconds) / static_cast<double>(kNanosecondsPerSecond);
}

}  // namespace hovercraft
