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

#include "hovercraft_sim/io/number_text.h"

#include "../support/share.h"

namespace hovercraft {
namespace {

constexpr unsigned kSeed = 20261122;

std::uint64_t bitPattern(double number) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &number, sizeof(bits));
  return bits;
}

std::string textOf(double number) {
  fmt::memory_buffer buffer;
  appendNumber(buffer, number);
  return fmt::to_string(buffer);
}

std::string printed(double number, int digits) {
  char text[64];
  std::snprintf(text, sizeof(text), "%.*e", digits - 1, number);
  return text;
}

/// How many digits of a number tell: without sign, point, exponent, and zeros at either end.
std::size_t digitsOf(const std::string& text) {
  std::string digits;
  for (const char c : text.substr(0, text.find('e'))) {
    if (c >= '0' && c <= '9') digits += c;
  }
  digits.erase(0, digits.find_first_not_of('0'));
  const std::size_t last = digits.find_last_not_of('0');
  return last == std::string::npos ? 0 : last + 1;
}

/// "" if a text is read as the number and no decimal number with fewer digits is, nor a nearer one
/// with as many. For one digit less printf gives the nearest such number; where that is not read as
/// this one, the next one on the other side may be, as beside a power of two the numbers below lie
/// twice as close: it is tried too.
std::string faultOf(const std::string& text, double number) {
  if (bitPattern(std::strtod(text.c_str(), nullptr)) != bitPattern(number))
    return text + " is another one";
  const auto digits = static_cast<int>(digitsOf(text));
  if (digits > 1) {
    const std::string shorter = printed(number, digits - 1);
    const double unit = std::strtod(
        ("1e" + std::to_string(std::atoi(shorter.c_str() + shorter.find('e') + 1) - (digits - 2)))
            .c_str(),
        nullptr);
    for (const double off : {0.0, unit, -unit}) {
      const std::string candidate =
          printed(std::strtod(shorter.c_str(), nullptr) + off, digits - 1);
      if (std::strtod(candidate.c_str(), nullptr) == number) return candidate + " is shorter";
    }
  }
  const std::string nearest = printed(number, digits);
  if (std::strtod(nearest.c_str(), nullptr) == number &&
      std::strtold(nearest.c_str(), nullptr) != std::strtold(text.c_str(), nullptr)) {
    return nearest + " is nearer";
  }
  return "";
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

TEST(AppendNumber, WritesTheShortestTextThatIsReadAsTheNumber) {
  for (const double number : awkwardNumbers()) {
    if (number == 0.0) continue;
    EXPECT_EQ(faultOf(textOf(number), number), "") << textOf(number);
  }
  std::mt19937_64 random(kSeed);
  std::uniform_real_distribution<double> mantissa(-10.0, 10.0);
  std::uniform_int_distribution<int> exponent(-14, 18);
  for (int n = 0; n < testing::shareOf(100000); ++n) {
    const double number = mantissa(random) * std::pow(10.0, exponent(random));
    ASSERT_EQ(faultOf(textOf(number), number), "") << "sample " << n << " of seed " << kSeed;
  }
}

// Numbers of few digits, as people write them, come back as they were written.
TEST(AppendNumber, GivesBackWhatWasWritten) {
  for (const char* text : {"0",
                           "-0",
                           "0.6",
                           "0.1",
                           "0.3",
                           "-1.7",
                           "5",
                           "1234.5",
                           "0.0001",
                           "0.00012",
                           "1e-05",
                           "1.5e-09",
                           "1e-10",
                           "9.9e-11",
                           "5e-324",
                           "1e-300",
                           "2.2250738585072014e-308",
                           "1.7976931348623157e+308",
                           "99999999999999",
                           "100000000000000",
                           "12345678901234568",
                           "1e+17",
                           "9007199254740993e3"}) {
    const double number = std::strtod(text, nullptr);
    if (std::string(text) == "9007199254740993e3") {
      EXPECT_EQ(textOf(number), "9.007199254740993e+18");
    } else {
      EXPECT_EQ(textOf(number), text);
    }
  }
  std::mt19937_64 random(kSeed);
  for (int n = 0; n < testing::shareOf(100000); ++n) {
    const std::string text =
        fmt::format("{}.{}", random() % 10000000, random() % 10000000 * 10 + 1 + random() % 9);
    ASSERT_EQ(textOf(std::strtod(text.c_str(), nullptr)), text);
  }
}

// Below 2^-44 = 5.6843418860808014869…e-14 numbers lie twice as close as above: the nearest 16
// digits, …801e-14, are off by 4.9e-30 and read as the next number below, half of whose distance is
// 3.2e-30; …802e-14 is off by 5.1e-30 and read as this one, as half of the gap above is 6.3e-30.
TEST(AppendNumber, KnowsThatNumbersBelowAPowerOfTwoLieCloser) {
  EXPECT_EQ(textOf(std::ldexp(1.0, -44)), "5.684341886080802e-14");
  for (int power = -1074; power <= 1023; ++power) {
    const double number = std::ldexp(1.0, power);
    EXPECT_EQ(faultOf(textOf(number), number), "") << power;
  }
}

TEST(AppendNumber, WritesWhatIsNotFiniteAsAWord) {
  for (const double number :
       {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
        std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(parseNumber(textOf(number)).syntax, NumberSyntax::kNotFinite) << textOf(number);
  }
}

TEST(ParseNumber, GivesBackEveryBitOfWhatWasWritten) {
  std::mt19937_64 random(kSeed);
  for (int n = 0; n < testing::shareOf(100000); ++n) {
    const std::uint64_t bits = random();
    double number = 0.0;
    std::memcpy(&number, &bits, sizeof(number));
    if (!std::isfinite(number)) continue;
    const ParsedNumber parsed = parseNumber(textOf(number));
    ASSERT_EQ(parsed.syntax, NumberSyntax::kNumber) << textOf(number);
    ASSERT_EQ(bitPattern(parsed.value), bits) << "sample " << n << " of seed " << kSeed;
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
