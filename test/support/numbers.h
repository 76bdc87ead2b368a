#pragma once

#include <cstdint>
#include <limits>

namespace hovercraft::testing {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
/// What a few operations on numbers near 1 leave (-).
constexpr double kRounding = 1e-15;

constexpr std::int64_t kStepNs = 1000000;
constexpr std::int64_t kNow = 987654321012345;  // some reading of a steady clock, ns

}  // namespace hovercraft::testing
