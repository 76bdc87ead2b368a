#include "hovercraft_sim/io/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/time.h"

namespace hovercraft {
namespace {

constexpr int kNanosecondDigits = 9;  // a nanosecond is the ninth decimal of a second
constexpr int kMostDigits = 16;       // of kMaxNanoseconds
constexpr long kMostShift =
    1000000;  // an exponent beyond it is of 0, or leaves nothing of a number

/// A decimal number taken apart: ± 0.d1 d2 d3 ... · 10^point
struct Decimal {
  bool is_negative = false;
  std::string digits;
  int point = 0;
};

Decimal takenApart(const std::string& text) {
  Decimal decimal;
  decimal.is_negative = text.front() == '-';
  const std::size_t exponent = std::min(text.find_first_of("eE"), text.size());
  bool is_fraction = false;
  for (std::size_t i = 0; i < exponent; ++i) {
    if (text[i] == '.') is_fraction = true;
    if (!isDigit(text[i])) continue;
    decimal.digits += text[i];
    if (!is_fraction) ++decimal.point;
  }
  if (exponent < text.size()) {
    const long shift = std::strtol(text.c_str() + exponent + 1, nullptr, 10);
    decimal.point += static_cast<int>(std::clamp(shift, -kMostShift, kMostShift));
  }
  const std::size_t zeros = std::min(decimal.digits.find_first_not_of('0'), decimal.digits.size());
  decimal.digits.erase(0, zeros);
  decimal.point -= static_cast<int>(zeros);
  return decimal;
}

__extension__ using UInt128 = unsigned __int128;

constexpr int kDigits = 17;                                    // tell every double from the next
constexpr int kSureDigits = 15;                                // come back from every double
constexpr std::uint64_t kLeast18Digits = 100000000000000000U;  // 10^17
constexpr int kMantissaBits = 53;
// Between these, numbers are scaled by 10^2 to 10^27; 5^27 < 2^63: times a mantissa, and times 4,
// it fits 128 bits.
constexpr double kLeastFast = 1e-10;
constexpr double kMostFast = 1e14;
constexpr int kLeastFixedExponent = -4;  // %g writes smaller numbers with an exponent
constexpr int kLeastExponent = 17;       // %.17g writes these and greater ones with an exponent

/// The digits of a positive number, followed by zeros up to 17, and its decimal exponent:
/// d.ddd… · 10^exponent. 10^17 stands for 10 · 10^exponent.
struct Digits17 {
  std::uint64_t digits;
  int exponent;
};

std::uint64_t powerOf10(int exponent) {
  std::uint64_t power = 1;
  for (int i = 0; i < exponent; ++i) power *= 10;
  return power;
}

/// A positive number times 10^power, exactly, in units of 2^-shift, and what lies half way to the
/// next numbers: whatever is nearer is read as this number.
struct Scaled {
  UInt128 exact;
  int shift;
  UInt128 above;
  UInt128 below;
  bool takes_ties;  // what lies half way itself is read as the number with the even mantissa

  /// @param digits the number in whole units of 10^-power, from below or above.
  UInt128 distance(std::uint64_t digits) const {
    const UInt128 value = static_cast<UInt128>(digits) << shift;
    return value > exact ? value - exact : exact - value;
  }
  bool isReadBack(std::uint64_t digits) const {
    const UInt128 off = distance(digits);
    const UInt128 most = (static_cast<UInt128>(digits) << shift) > exact ? above : below;
    return off < most || (off == most && takes_ties);
  }
};

/// m · 2^e times 10^power.
Scaled scaled(std::uint64_t m, int e, int power) {
  std::uint64_t power_of_5 = 1;
  for (int i = 0; i < power; ++i) power_of_5 *= 5;
  // The unit is a quarter of the one that the product needs: halves of halves stay whole.
  const UInt128 quarter = power_of_5;
  const bool is_power_of_2 = m == std::uint64_t{1} << (kMantissaBits - 1);
  return {4 * quarter * m, -(e + power) + 2, 2 * quarter, is_power_of_2 ? quarter : 2 * quarter,
          m % 2 == 0};
}

/// The shortest digits that are read back, and of these the nearest. @param most of 17 digits,
/// rounded down.
std::uint64_t shortest(const Scaled& number, std::uint64_t most) {
  for (std::uint64_t unit = powerOf10(kDigits - kSureDigits); unit > 1; unit /= 10) {
    const std::uint64_t down = most / unit * unit;
    const std::uint64_t up = down + unit;
    const UInt128 to_up = number.distance(up);
    const UInt128 to_down = number.distance(down);
    const bool is_down_even = down / unit % 2 == 0;
    const bool is_up_nearer = to_up < to_down || (to_up == to_down && !is_down_even);
    const std::uint64_t nearer = is_up_nearer ? up : down;
    if (number.isReadBack(nearer)) return nearer;
    const std::uint64_t farther = is_up_nearer ? down : up;
    if (number.isReadBack(farther)) return farther;
  }
  const UInt128 off = number.distance(most);
  const UInt128 off_above = number.distance(most + 1);
  return off < off_above || (off == off_above && most % 2 == 0) ? most : most + 1;
}

/// @param number in [kLeastFast, kMostFast).
Digits17 shortestDigits(double number) {
  int exponent = 0;
  const double mantissa = std::frexp(number, &exponent);  // in [1/2, 1)
  const auto m = static_cast<std::uint64_t>(std::ldexp(mantissa, kMantissaBits));
  // log10(2) = 0.30103 makes of the binary exponent a decimal one that is right or one too small.
  int power = kDigits - 1 - static_cast<int>(std::floor((exponent - 1) * 0.30103));
  Scaled value = scaled(m, exponent - kMantissaBits, power);
  if (static_cast<std::uint64_t>(value.exact >> value.shift) >= kLeast18Digits) {
    --power;
    value = scaled(m, exponent - kMantissaBits, power);
  }
  const auto most = static_cast<std::uint64_t>(value.exact >> value.shift);
  return {shortest(value, most), kDigits - 1 - power};
}

bool isReadBack(double number, const Digits17& parts) {
  const std::string text = fmt::format("{}e{}", parts.digits, parts.exponent - (kDigits - 1));
  return parseNumber(text).value == number;
}

/// A positive number rounded to so many digits.
Digits17 rounded(double number, int digits) {
  const std::string text = fmt::format("{:.{}e}", number, digits - 1);  // d.ddde±dd
  const std::size_t exponent = text.find('e');
  Digits17 parts = {0, static_cast<int>(std::strtol(text.c_str() + exponent + 1, nullptr, 10))};
  for (const char c : text.substr(0, exponent)) {
    if (isDigit(c)) parts.digits = 10 * parts.digits + static_cast<std::uint64_t>(c - '0');
  }
  parts.digits *= powerOf10(kDigits - digits);
  return parts;
}

/// The same by trial, for any positive number.
Digits17 shortestDigitsByTrial(double number) {
  // Denormal numbers have fewer digits than others.
  const bool is_normal = number >= std::numeric_limits<double>::min();
  int exponent = 0;
  const bool is_power_of_2 = std::frexp(number, &exponent) == 0.5;
  for (int digits = is_normal ? kSureDigits : 1; digits < kDigits; ++digits) {
    Digits17 candidate = rounded(number, digits);
    if (isReadBack(number, candidate)) return candidate;
    // More is read as a power of two from above than from below.
    candidate.digits += powerOf10(kDigits - digits);
    if (is_power_of_2 && isReadBack(number, candidate)) return candidate;
  }
  return rounded(number, kDigits);
}

void appendFraction(fmt::memory_buffer& buffer, const char* begin, const char* end) {
  if (begin >= end) return;
  buffer.push_back('.');
  buffer.append(begin, end);
}

void appendDigits(fmt::memory_buffer& buffer, Digits17 parts) {
  if (parts.digits == kLeast18Digits) parts = {kLeast18Digits / 10, parts.exponent + 1};
  const fmt::format_int text(parts.digits);
  const char* begin = text.data();
  const char* end = begin + kDigits;
  while (end[-1] == '0') --end;
  if (parts.exponent >= 0 && parts.exponent < kLeastExponent) {
    const char* point = begin + parts.exponent + 1;
    buffer.append(begin, point);
    appendFraction(buffer, point, end);
  } else if (parts.exponent < 0 && parts.exponent >= kLeastFixedExponent) {
    const std::string zeros = "0.0000";
    buffer.append(zeros.data(), zeros.data() + 1 - parts.exponent);
    buffer.append(begin, end);
  } else {
    buffer.push_back(*begin);
    appendFraction(buffer, begin + 1, end);
    fmt::format_to(std::back_inserter(buffer), "e{}{:02}", parts.exponent < 0 ? '-' : '+',
                   std::abs(parts.exponent));
  }
}

}  // namespace

std::int64_t parseNanoseconds(const std::string& text) {
  const Decimal decimal = takenApart(text);
  if (decimal.digits.empty()) return 0;
  const int whole = decimal.point + kNanosecondDigits;  // digits before the nanosecond's point
  demand(whole <= kMostDigits, "a time must be at most kMaxNanoseconds");
  const auto digit = [&](int i) {
    const auto index = static_cast<std::size_t>(i);
    return i >= 0 && index < decimal.digits.size() ? decimal.digits[index] - '0' : 0;
  };
  std::int64_t time_ns = 0;
  for (int i = 0; i < whole; ++i) time_ns = 10 * time_ns + digit(i);
  if (digit(whole) >= 5) ++time_ns;
  return decimal.is_negative ? -time_ns : time_ns;
}

void appendNumber(fmt::memory_buffer& buffer, double number) {
  const FloatingPointEnvironment environment;
  if (!std::isfinite(number)) {
    fmt::format_to(std::back_inserter(buffer), "{}", number);
    return;
  }
  if (std::signbit(number)) buffer.push_back('-');
  const double magnitude = std::abs(number);
  if (magnitude == 0.0) {
    buffer.push_back('0');
  } else if (magnitude >= kLeastFast && magnitude < kMostFast) {
    appendDigits(buffer, shortestDigits(magnitude));
  } else {
    appendDigits(buffer, shortestDigitsByTrial(magnitude));
  }
}

std::string numberText(double number) {
  fmt::memory_buffer buffer;
  appendNumber(buffer, number);
  return fmt::to_string(buffer);
}

void appendSeconds(fmt::memory_buffer& buffer, std::int64_t time_ns) {
  if (time_ns < 0) buffer.push_back('-');
  const std::int64_t magnitude = std::abs(time_ns);
  const fmt::format_int whole(magnitude / kNanosecondsPerSecond);
  buffer.append(whole.data(), whole.data() + whole.size());
  const std::int64_t fraction = magnitude % kNanosecondsPerSecond;
  if (fraction == 0) return;
  fmt::format_to(std::back_inserter(buffer), ".{:09}", fraction);
  while (buffer[buffer.size() - 1] == '0') buffer.resize(buffer.size() - 1);
}

std::string secondsText(std::int64_t time_ns) {
  fmt::memory_buffer buffer;
  appendSeconds(buffer, time_ns);
  return fmt::to_string(buffer);
}

}  // namespace hovercraft
