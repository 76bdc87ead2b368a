#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/pacing/duration_histogram.h"

namespace hovercraft {
namespace {

TEST(DurationHistogram, IsEmptyAtFirstAndAfterClear) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.maximum(), 0);
  EXPECT_EQ(histogram.quantile(0.5), 0);
  histogram.add(1000);
  EXPECT_EQ(histogram.count(), 1U);
  histogram.clear();
  EXPECT_EQ(histogram.count(), 0U);
  EXPECT_EQ(histogram.maximum(), 0);
  EXPECT_EQ(histogram.quantile(1.0), 0);
}

TEST(DurationHistogram, QuantilesAreThoseOfTheSortedSamplesToOneBucket) {
  std::mt19937 engine(4711);
  std::uniform_real_distribution<double> exponent(0.0, 40.0);  // 1 ns to 18 minutes
  DurationHistogram histogram;
  std::vector<std::int64_t> samples;
  for (int i = 0; i < 4999; ++i) {
    samples.push_back(static_cast<std::int64_t>(std::exp2(exponent(engine))));
    histogram.add(samples.back());
  }
  std::sort(samples.begin(), samples.end());
  EXPECT_EQ(histogram.count(), samples.size());
  EXPECT_EQ(histogram.maximum(), samples.back());
  for (const double share : {0.001, 0.01, 0.25, 0.5, 0.75, 0.9, 0.99, 0.999, 1.0}) {
    const auto rank = static_cast<std::size_t>(std::ceil(share * 4999.0));
    const std::int64_t exact = samples[rank - 1];
    EXPECT_GE(histogram.quantile(share), exact) << share;
    EXPECT_LE(histogram.quantile(share), exact + exact / 8) << share;
  }
}

TEST(DurationHistogram, DurationsBelowSixteenAreExact) {
  for (std::int64_t duration = 0; duration < 16; ++duration) {
    DurationHistogram histogram;
    histogram.add(duration);
    histogram.add(1000);
    EXPECT_EQ(histogram.quantile(0.5), duration);
  }
}

TEST(DurationHistogram, NoQuantileIsAboveTheMaximum) {
  DurationHistogram histogram;
  histogram.add(1025);  // its bucket ends at 1151
  EXPECT_EQ(histogram.quantile(1.0), 1025);
  EXPECT_EQ(histogram.quantile(0.0), 1025);
}

TEST(DurationHistogram, ANegativeDurationCountsAsNone) {
  DurationHistogram histogram;
  histogram.add(-5);
  EXPECT_EQ(histogram.count(), 1U);
  EXPECT_EQ(histogram.maximum(), 0);
  EXPECT_EQ(histogram.quantile(1.0), 0);
}

TEST(DurationHistogram, TheLongestDurationHasABucket) {
  DurationHistogram histogram;
  histogram.add(std::numeric_limits<std::int64_t>::max());
  histogram.add(1);
  EXPECT_EQ(histogram.quantile(0.5), 1);
  EXPECT_EQ(histogram.quantile(1.0), std::numeric_limits<std::int64_t>::max());
}

TEST(DurationHistogram, APowerOfTwoBeginsABucketAndTheNumberBeforeItEndsOne) {
  for (int exponent = 4; exponent < 62; ++exponent) {
    const std::int64_t power = std::int64_t{1} << exponent;
    DurationHistogram histogram;
    histogram.add(power - 1);
    histogram.add(power);
    EXPECT_EQ(histogram.quantile(0.5), power - 1) << exponent;
    EXPECT_EQ(histogram.quantile(1.0), power) << exponent;
  }
}

}  // namespace
}  // namespace hovercraft
