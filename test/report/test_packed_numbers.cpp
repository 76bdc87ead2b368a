#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "hovercraft_sim/report/packed_numbers.h"

namespace hovercraft_ros {
namespace {

/// Reads packed numbers as the front end does.
class Unpacker {
 public:
  Unpacker(const std::vector<std::uint8_t>& bytes, const PackedColumn& column)
      : bytes_(bytes), at_(column.begin), column_(column) {}

  std::vector<double> values() {
    std::vector<double> values;
    std::int64_t whole = 0;
    for (const std::int64_t difference : differences()) {
      whole += difference;
      values.push_back(whole == 0 ? std::numeric_limits<double>::quiet_NaN()
                                  : column_.least + column_.step * static_cast<double>(whole - 1));
    }
    return values;
  }

  std::vector<std::int64_t> times() {
    std::vector<std::int64_t> times;
    std::int64_t time = 0;
    std::int64_t step = 0;
    for (const std::int64_t difference : differences()) {
      step += difference;
      time += step;
      times.push_back(time);
    }
    return times;
  }

 private:
  std::uint64_t next() {
    std::uint64_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
      const std::uint64_t byte = bytes_.at(at_++);
      value |= (byte & 0x7fU) << shift;
      if (byte < 0x80U) return value;
    }
  }
  std::vector<std::int64_t> differences() {
    std::vector<std::int64_t> found;
    while (found.size() < column_.count) {
      const std::uint64_t code = next();
      if (code == 0) {
        found.resize(found.size() + next() + 1, 0);
      } else {
        const auto half = static_cast<std::int64_t>(code >> 1U);
        found.push_back((code & 1U) != 0 ? ~half : half);
      }
    }
    EXPECT_EQ(found.size(), column_.count);
    return found;
  }

  const std::vector<std::uint8_t>& bytes_;
  std::size_t at_;
  PackedColumn column_;
};

TEST(PackedNumbers, AValueIsOffByHalfAStepAtMost) {
  std::vector<double> values(1000);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = 3.0 * std::sin(0.02 * static_cast<double>(i)) - 1.0;
  }
  PackedNumbers packed;
  packed.add({1.0, 2.0, 3.0}, 16);
  const PackedColumn column = packed.add(values, 16);
  const std::vector<double> read = Unpacker(packed.bytes(), column).values();
  ASSERT_EQ(read.size(), values.size());
  // The range of 6 in 2^16 - 2 steps.
  EXPECT_NEAR(column.step, 6.0 / 65534.0, 1e-8);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_NEAR(read[i], values[i], 0.5000001 * column.step) << i;
  }
}

TEST(PackedNumbers, WhatIsNotFiniteIsAGapAndWhatStandsTakesNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  PackedNumbers packed;
  const std::vector<double> read =
      Unpacker(packed.bytes(), packed.add({nan, 1.0, infinity, 2.0, -infinity}, 16)).values();
  ASSERT_EQ(read.size(), 5U);
  EXPECT_TRUE(std::isnan(read[0]) && std::isnan(read[2]) && std::isnan(read[4]));
  EXPECT_DOUBLE_EQ(read[1], 1.0);
  EXPECT_DOUBLE_EQ(read[3], 2.0);

  PackedNumbers flat;
  const PackedColumn column = flat.add(std::vector<double>(100000, -7.25), 16);
  EXPECT_LE(flat.bytes().size(), 6U);
  for (const double value : Unpacker(flat.bytes(), column).values()) ASSERT_EQ(value, -7.25);
}

TEST(PackedNumbers, ValuesThatNobodyDrawsAreGapsAndHurtNoOthers) {
  const double most = std::numeric_limits<double>::max();
  PackedNumbers packed;
  const auto read =
      Unpacker(packed.bytes(), packed.add({-most, -1e300, 0.0, 1e300, most}, 16)).values();
  ASSERT_EQ(read.size(), 5U);
  EXPECT_TRUE(std::isnan(read[0]) && std::isnan(read[4]));
  EXPECT_NEAR(read[1] / 1e300, -1.0, 1e-4);
  EXPECT_NEAR(read[2] / 1e300, 0.0, 1e-4);
  EXPECT_NEAR(read[3] / 1e300, 1.0, 1e-4);
}

TEST(PackedNumbers, TimesAreKeptToTheNanosecondAndEvenOnesTakeNothing) {
  std::vector<std::int64_t> times_ns;
  times_ns.reserve(60000);
  for (std::int64_t i = 0; i < 60000; ++i) times_ns.push_back(1'000'000 + 10'000'000 * i);
  PackedNumbers packed;
  const PackedColumn even = packed.addTimes(times_ns);
  EXPECT_LE(packed.bytes().size(), 16U);
  EXPECT_EQ(Unpacker(packed.bytes(), even).times(), times_ns);
  const std::vector<std::int64_t> uneven = {-5, 0, 7, 7, 1'600'000'000'123'456'789};
  EXPECT_EQ(Unpacker(packed.bytes(), packed.addTimes(uneven)).times(), uneven);
}

TEST(PackedNumbers, EveryNthValueIsTaken) {
  PackedNumbers packed;
  const PackedColumn column = packed.addTimes({0, 1, 2, 3, 4, 5, 6}, 3);
  EXPECT_EQ(Unpacker(packed.bytes(), column).times(), (std::vector<std::int64_t>{0, 3, 6}));
}

}  // namespace
}  // namespace hovercraft_ros
