#pragma once

#include <chrono>
#include <cstdint>

namespace hovercraft {

/// Reading of a clock that never jumps, ns from an arbitrary origin. For pace and reports: no state
/// depends on it.
inline std::int64_t steadyNow() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace hovercraft
