#pragma once

#include <cstdint>
#include <optional>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/scenario/config_reader.h"

namespace hovercraft {

/// How many steps a period is; none if these are not a whole number (rates are typed with few
/// digits: 1e-9 of it may be missing), or below 1.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<Tick> wholeSteps(double steps);

/// A duration of a scenario as whole nanoseconds. @param seconds what stands behind `key`.
/// @throws std::invalid_argument if it is no whole number of them, or beyond kMaxNanoseconds.
HOVERCRAFT_PUBLIC std::int64_t nanosecondsOf(const ConfigReader& reader, const char* key,
                                             double seconds);

}  // namespace hovercraft
