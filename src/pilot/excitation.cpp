#include "hovercraft_sim/pilot/excitation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

// Share of an interval by which times may lie before its border: far more than their rounding,
// far less than a decision.
constexpr double kIntervalBorder = 1e-9;

/// Taps of a register of each order whose sequence is of maximum length: primitive polynomials
/// (Golomb, table of chapter III): x^n + x^k + ... + 1.
constexpr std::array<std::uint32_t, kMostPrbsOrder + 1> kTaps = {
    0, 0, 0x3, 0x6, 0xC, 0x14, 0x30, 0x60, 0xB8, 0x110, 0x240, 0x500, 0xE08};

/// ln of a number > 0 by Newton's method on the exact exp, so that it is the same everywhere.
double exactLog(double x) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);  // [0.5, 1)
  constexpr double kLn2 = 0.69314718055994530942;
  double y = mantissa - 1.0;
  for (int i = 0; i < 8; ++i) y -= 1.0 - mantissa * exactExp(-y);
  return y + exponent * kLn2;
}

/// (exp(x) - 1)/x. Near 0, where the difference would keep no digit, by its series.
double growthMean(double x) {
  if (std::abs(x) > 0.5) return (exactExp(x) - 1.0) / x;
  double sum = 0.0;
  for (int k = 16; k >= 1; --k) sum = 1.0 + sum * x / (k + 1);  // x^k/(k + 1)!
  return sum;
}

/// Turns of a chirp until t, 1.
double turnsAt(const Chirp& chirp, double t) {
  const double f0 = chirp.first_frequency;
  const double f1 = chirp.last_frequency;
  if (!chirp.is_logarithmic || f0 == f1) return (f0 + 0.5 * (f1 - f0) * (t / chirp.duration)) * t;
  return f0 * t * growthMean(exactLog(f1 / f0) * (t / chirp.duration));
}

}  // namespace

std::int64_t intervalAt(double t, double length) {
  return static_cast<std::int64_t>(std::floor(t / length + kIntervalBorder));
}

double durationOf(const Steps& steps) {
  return steps.hold * static_cast<double>(steps.levels.size());
}

double durationOf(const Ramp& ramp) {
  return ramp.duration;
}

double durationOf(const Prbs& prbs) {
  return prbs.bit * static_cast<double>(((1 << prbs.order) - 1) * prbs.cycles);
}

double durationOf(const Chirp& chirp) {
  return chirp.duration;
}

void levelsAt(const Steps& steps, double t, Levels& levels) {
  const auto last = static_cast<std::int64_t>(steps.levels.size()) - 1;
  levels = steps.levels[static_cast<std::size_t>(std::min(intervalAt(t, steps.hold), last))];
}

void levelsAt(const Ramp& ramp, double t, Levels& levels) {
  const FloatingPointEnvironment environment;
  const double share = std::min(t / ramp.duration, 1.0);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    levels[i] = (1.0 - share) * ramp.from[i] + share * ramp.to[i];
  }
}

void levelsAt(const Prbs& prbs, double t, Levels& levels) {
  const std::int64_t bits = ((std::int64_t{1} << prbs.order) - 1) * prbs.cycles;
  const std::int64_t bit = std::min(intervalAt(t, prbs.bit), bits - 1);
  levels = maximumLengthBit(prbs.order, bit) ? prbs.high : prbs.low;
}

void levelsAt(const Chirp& chirp, double t, Levels& levels) {
  const FloatingPointEnvironment environment;
  const double turns = turnsAt(chirp, std::min(t, chirp.duration));
  const double swing = exactSin(2.0 * kPi * (turns - std::floor(turns)));
  for (std::size_t i = 0; i < levels.size(); ++i) {
    levels[i] = chirp.centre[i] + chirp.amplitude[i] * swing;
  }
}

bool maximumLengthBit(int order, std::int64_t index) {
  demand(order >= kLeastPrbsOrder && order <= kMostPrbsOrder, "the order has a polynomial");
  const std::uint32_t taps = kTaps[static_cast<std::size_t>(order)];
  const std::uint32_t ones = (1U << static_cast<unsigned>(order)) - 1U;
  std::uint32_t state = ones;
  for (std::int64_t i = index % ones; i > 0; --i) {
    state = (state >> 1U) ^ ((state & 1U) != 0 ? taps : 0U);
  }
  return (state & 1U) != 0;
}

}  // namespace hovercraft
