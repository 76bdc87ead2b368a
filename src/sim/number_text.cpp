#include "hovercraft_sim/sim/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>

#include "hovercraft_sim/math/demand.h"
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

constexpr int kDigits = 17;                                   // tell every double from the next
constexpr std::uint64_t kLeast17Digits = 10000000000000000U;  // 10^16
constexpr std::uint64_t kLeast18Digits = 10 * kLeast17Digits;
constexpr int kMantissaBits = 53;
// Between these, numbers are scaled by 10^2 to 10^27; 5^27 < 2^63: times a mantissa it fits 128
// bits.
constexpr double kLeastFast = 1e-10;
constexpr double kMostFast = 1e14;
constexpr int kLeastFixedExponent = -4;  // %g writes smaller numbers with an exponent

/// The first 17 digits of a positive number, and its decimal exponent: d.ddd… · 10^exponent.
struct Digits17 {
  std::uint64_t digits;
  int exponent;
};

/// m · 5^k · 2^(e + k) rounded to nearest, ties to even: the number m · 2^e times 10^k.
std::uint64_t scaled(std::uint64_t m, int e, int k) {
  std::uint64_t power_of_5 = 1;
  for (int i = 0; i < k; ++i) power_of_5 *= 5;
  const UInt128 exact = static_cast<UInt128>(m) * power_of_5;
  const int shift = -(e + k);
  const auto whole = static_cast<std::uint64_t>(exact >> shift);
  const UInt128 rest = exact & ((static_cast<UInt128>(1) << shift) - 1);
  const UInt128 half = static_cast<UInt128>(1) << (shift - 1);
  const bool rounds_up = rest > half || (rest == half && whole % 2 == 1);
  return whole + (rounds_up ? 1 : 0);
}

/// @param number in [kLeastFast, kMostFast).
Digits17 digitsOf(double number) {
  int exponent = 0;
  const double mantissa = std::frexp(number, &exponent);  // in [1/2, 1)
  const auto m = static_cast<std::uint64_t>(std::ldexp(mantissa, kMantissaBits));
  // log10(2) = 0.30103 makes of the binary exponent a decimal one that is right or one too small.
  int power = kDigits - 1 - static_cast<int>(std::floor((exponent - 1) * 0.30103));
  std::uint64_t digits = scaled(m, exponent - kMantissaBits, power);
  if (digits >= kLeast18Digits) {
    --power;
    digits = scaled(m, exponent - kMantissaBits, power);
  }
  return {digits, kDigits - 1 - power};
}

void appendFraction(fmt::memory_buffer& buffer, const char* begin, const char* end) {
  if (begin >= end) return;
  buffer.push_back('.');
  buffer.append(begin, end);
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
  if (std::signbit(number)) buffer.push_back('-');
  const double magnitude = std::abs(number);
  if (magnitude == 0.0) {
    buffer.push_back('0');
    return;
  }
  if (!(magnitude >= kLeastFast && magnitude < kMostFast)) {
    fmt::format_to(std::back_inserter(buffer), "{:.17g}", magnitude);
    return;
  }
  const Digits17 parts = digitsOf(magnitude);
  const fmt::format_int text(parts.digits);
  const char* begin = text.data();
  const char* end = begin + kDigits;
  while (end[-1] == '0') --end;
  if (parts.exponent >= 0) {
    const char* point = begin + parts.exponent + 1;
    buffer.append(begin, point);
    appendFraction(buffer, point, end);
  } else if (parts.exponent >= kLeastFixedExponent) {
    const std::string zeros = "0.0000";
    buffer.append(zeros.data(), zeros.data() + 1 - parts.exponent);
    buffer.append(begin, end);
  } else {
    buffer.push_back(*begin);
    appendFraction(buffer, begin + 1, end);
    fmt::format_to(std::back_inserter(buffer), "e-{:02}", -parts.exponent);
  }
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
