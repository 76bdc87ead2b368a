#include <clocale>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <limits>
#include <locale>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/number_text.h"

namespace hovercraft {
namespace {

constexpr unsigned kSeed = 20261122;

std::uint64_t bitsOf(double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof(bits));
  return bits;
}

std::string textOf(double number) {
  fmt::memory_buffer buffer;
  appendNumber(buffer, number);
  return fmt::to_string(buffer);
}

std::string printed(double number) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.17g", number);
  return text;
}

/// Numbers at which a formatter errs first: powers of two and of ten, their neighbours, ties.
std::vector<double> awkwardNumbers() {
  std::vector<double> numbers = {0.0, -0.0, std::numeric_limits<double>::denorm_min(),
                                 std::numeric_limits<double>::max()};
  for (int power = -60; power <= 60; ++power) {
    const double of_two = std::ldexp(1.0, power);
    const double of_ten = std::strtod(fmt::format("1e{}", power).c_str(), nullptr);
    for (const double number : {of_two, of_ten, 3.0 * of_two, 5.0 * of_ten}) {
      numbers.insert(numbers.end(),
                     {number, -number, std::nextafter(number, 0.0), std::nextafter(number, 1e300)});
    }
  }
  return numbers;
}

TEST(AppendNumber, WritesWhatPrintfWrites) {
  for (const double number : awkwardNumbers()) EXPECT_EQ(textOf(number), printed(number));
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> mantissa(-10.0, 10.0);
  std::uniform_int_distribution<int> exponent(-14, 18);
  for (int n = 0; n < 300000; ++n) {
    const double number = mantissa(random) * std::pow(10.0, exponent(random));
    ASSERT_EQ(textOf(number), printed(number)) << "sample " << n << " of seed " << kSeed;
  }
}

TEST(AppendNumber, RoundsTiesToEven) {
  // An odd multiple of 1/16 above 1e13 has 14 digits before the point and 4 behind it, the last a
  // 5: halfway between two numbers of 17 digits.
  std::mt19937_64 random(kSeed);
  for (int n = 0; n < 20000; ++n) {
    const double number = 1e13 + static_cast<double>(2 * (random() % 1000000) + 1) / 16.0;
    ASSERT_EQ(textOf(number), printed(number));
  }
}

TEST(ParseNumber, GivesBackEveryBitOfWhatWasWritten) {
  std::mt19937_64 random(kSeed);
  for (int n = 0; n < 100000; ++n) {
    const std::uint64_t bits = random();
    double number = 0.0;
    std::memcpy(&number, &bits, sizeof(number));
    if (!std::isfinite(number)) continue;
    const ParsedNumber parsed = parseNumber(textOf(number));
    ASSERT_EQ(parsed.syntax, NumberSyntax::kNumber) << textOf(number);
    ASSERT_EQ(bitsOf(parsed.value), bits) << "sample " << n << " of seed " << kSeed;
  }
}

/// For as long as it lives, streams write a decimal comma, and so does the C library if it has a
/// locale that does.
class CommaLocale {
 public:
  CommaLocale() : before_(std::locale::global(std::locale(std::locale(), new Comma))) {
    for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "pl_PL.UTF-8"}) {
      if (std::setlocale(LC_NUMERIC, name) != nullptr) break;
    }
  }
  CommaLocale(const CommaLocale&) = delete;
  CommaLocale& operator=(const CommaLocale&) = delete;
  ~CommaLocale() {
    std::locale::global(before_);
    std::setlocale(LC_NUMERIC, "C");
  }

 private:
  struct Comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
  };
  std::locale before_;
};

TEST(ParseNumber, DoesNotDependOnTheLocale) {
  const CommaLocale locale;
  EXPECT_EQ(parseNumber("1.5").value, 1.5);
  EXPECT_EQ(parseNumber("1,5").syntax, NumberSyntax::kNoNumber);
  EXPECT_EQ(textOf(1.5), "1.5");
  EXPECT_EQ(textOf(std::ldexp(1.0, 100)), "1.2676506002282294e+30");
}

TEST(ParseNanoseconds, IsExactWhereAProductOfDoublesIsNot) {
  EXPECT_EQ(parseNanoseconds("0.001"), 1000000);
  EXPECT_EQ(parseNanoseconds("1e-9"), 1);
  EXPECT_EQ(parseNanoseconds("999999.999999999"), 999999999999999);
  EXPECT_EQ(parseNanoseconds("1000000"), 1000000000000000);
  EXPECT_EQ(parseNanoseconds("1234.5e-2"), 12345000000);
  EXPECT_EQ(parseNanoseconds("0.00125e3"), 1250000000);
  EXPECT_EQ(parseNanoseconds("-2.5"), -2500000000);
  EXPECT_EQ(parseNanoseconds("0"), 0);
  EXPECT_EQ(parseNanoseconds("0.0e99999999999999999999"), 0);
  EXPECT_EQ(parseNanoseconds("1e-99999999999999999999"), 0);
}

TEST(ParseNanoseconds, RoundsToTheNearest) {
  EXPECT_EQ(parseNanoseconds("0.10000000000000001"), 100000000);  // %.17g of 0.1
  EXPECT_EQ(parseNanoseconds("0.30000000000000004"), 300000000);  // 0.1 + 0.2
  EXPECT_EQ(parseNanoseconds("0.0000000014"), 1);
  EXPECT_EQ(parseNanoseconds("0.0000000015"), 2);
  EXPECT_EQ(parseNanoseconds("0.0000000005"), 1);
  EXPECT_EQ(parseNanoseconds("0.00000000049999"), 0);
}

TEST(SecondsText, IsExactAndShort) {
  EXPECT_EQ(secondsText(0), "0");
  EXPECT_EQ(secondsText(1), "0.000000001");
  EXPECT_EQ(secondsText(100000000), "0.1");
  EXPECT_EQ(secondsText(1500000000), "1.5");
  EXPECT_EQ(secondsText(20000000000), "20");
  std::mt19937_64 random(kSeed);
  for (int n = 0; n < 10000; ++n) {
    const auto time_ns = static_cast<std::int64_t>(random() % 1000000000000000);
    ASSERT_EQ(parseNanoseconds(secondsText(time_ns)), time_ns);
  }
}

}  // namespace
}  // namespace hovercraft
