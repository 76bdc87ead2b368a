#include "hovercraft_sim/scenario/step_time.h"

#include <cmath>
#include <fmt/format.h>

#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

// Relative distance from a whole number of steps that a rate may have: rates are typed with few
// digits.
constexpr double kRateSlack = 1e-9;

// Beyond it a count of steps is no exact double; such a period is a slip.
constexpr double kMostStepsOfPeriod = 1e15;

}  // namespace

std::optional<Tick> wholeSteps(double steps) {
  if (!(steps <= kMostStepsOfPeriod)) return std::nullopt;
  const Tick whole = std::llround(steps);
  if (whole < 1 || std::abs(steps - static_cast<double>(whole)) > kRateSlack * steps) {
    return std::nullopt;
  }
  return whole;
}

std::int64_t nanosecondsOf(const ConfigReader& reader, const char* key, double seconds) {
  const double exact = seconds * static_cast<double>(kNanosecondsPerSecond);
  if (!(exact <= kMaxNanoseconds)) {
    reader.fail(key,
                fmt::format("must be at most {:.0f} s", kMaxNanoseconds / kNanosecondsPerSecond));
  }
  const std::int64_t whole = std::llround(exact);
  if (std::abs(exact - static_cast<double>(whole)) > kNanosecondSlack * std::abs(exact)) {
    reader.fail(key, "must be a whole number of nanoseconds");
  }
  return whole;
}

}  // namespace hovercraft
