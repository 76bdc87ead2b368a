#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/noise.h"

namespace hovercraft {
namespace {

// Random123's known answers (kat_vectors, philox4x32 with 10 rounds).
TEST(Philox, GivesTheKnownAnswers) {
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (PhiloxCounter{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  const std::uint32_t ones = 0xffffffff;
  EXPECT_EQ(philox4x32({ones, ones, ones, ones}, {ones, ones}),
            (PhiloxCounter{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (PhiloxCounter{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

/// How far z lies from the quantile whose upper tail is p, by Newton's step in long double.
long double quantileError(double z, long double p) {
  const long double root_half = std::sqrt(0.5L);
  const long double tail = 0.5L * std::erfc(static_cast<long double>(z) * root_half);
  const long double density = std::exp(-0.5L * z * z) / std::sqrt(8.0L * std::atan(1.0L));  // √(2π)
  return (tail - p) / density;
}

std::uint64_t bitsOfTail(std::uint64_t k) {
  return k << 11U;
}

// The tails of every octave: 52 of them, 200 points in each. The bound is 4.1e-15 (design).
TEST(Normal, IsTheQuantileOfItsTailOverAllOctaves) {
  std::mt19937_64 draw(20261127);
  long double worst = 0.0L;
  for (unsigned octave = 0; octave < 52; ++octave) {
    const std::uint64_t begin = std::uint64_t{1} << octave;
    for (int i = 0; i < 200; ++i) {
      const std::uint64_t k = begin + draw() % begin;
      const long double p = (static_cast<long double>(k) + 0.5L) * std::pow(2.0L, -53);
      const double z = normalFromBits(bitsOfTail(k));
      worst = std::max(worst, std::abs(quantileError(z, p)));
    }
  }
  EXPECT_LT(worst, 4.1e-15L);
}

TEST(Normal, ReachesFromItsSmallestToItsLargestMagnitudeAndIsSymmetric) {
  const std::uint64_t last = (std::uint64_t{1} << 52U) - 1U;
  EXPECT_NEAR(normalFromBits(bitsOfTail(0)), 8.2924, 5e-5);
  // p = 1/2 - 2^-54: z = 2^-54 √(2π)
  const double root_of_2_pi = std::sqrt(8.0 * std::atan(1.0));
  EXPECT_NEAR(normalFromBits(bitsOfTail(last)) / std::ldexp(root_of_2_pi, -54), 1.0, 1e-15);
  const std::uint64_t sign = std::uint64_t{1} << 63U;
  for (const std::uint64_t k : {std::uint64_t{0}, std::uint64_t{12345}, last / 3, last}) {
    EXPECT_EQ(normalFromBits(sign | bitsOfTail(k)), -normalFromBits(bitsOfTail(k))) << k;
  }
}

TEST(Normal, FallsStrictlyWithTheTailAcrossTheBordersOfItsApproximations) {
  // p = 0.075 and r = 5, p = exp(-25).
  for (const double border : {0.075, std::exp(-25.0)}) {
    const auto k = static_cast<std::uint64_t>(std::ldexp(border, 53));
    for (std::uint64_t step = 1; step < 1000; ++step) {
      const std::uint64_t at = k - 500 + step;
      ASSERT_LE(normalFromBits(bitsOfTail(at + 1)), normalFromBits(bitsOfTail(at))) << at;
    }
  }
}

// Standard errors of n = 10^6 draws: mean 1e-3, variance √2 1e-3, kurtosis √24 1e-3; four of them.
TEST(NoiseChannel, IsNormalInMeanVarianceAndKurtosis) {
  const NoiseChannel channel(1, streamOf("alpha/imu/gyro_x"));
  constexpr int kDraws = 1000000;
  double sums[4] = {};
  for (int i = 0; i < kDraws; ++i) {
    const double z = channel.normal(i);
    sums[0] += z;
    sums[1] += z * z;
    sums[3] += z * z * z * z;
  }
  EXPECT_LT(std::abs(sums[0] / kDraws), 4.0e-3);
  EXPECT_LT(std::abs(sums[1] / kDraws - 1.0), 4.0 * 1.42e-3);
  EXPECT_LT(std::abs(sums[3] / kDraws - 3.0), 4.0 * 9.8e-3);  // √96 1e-3: of z⁴ itself
}

TEST(NoiseChannel, DependsOnSeedStreamTickAndDrawAndOnNothingElse) {
  const NoiseChannel channel(7, 1000);
  const double first = channel.normal(5);
  channel.normal(6);
  EXPECT_EQ(channel.normal(5), first);
  std::set<double> all = {first};
  all.insert(NoiseChannel(8, 1000).normal(5));
  all.insert(NoiseChannel(7 + (std::int64_t{1} << 32U), 1000).normal(5));
  all.insert(NoiseChannel(-7, 1000).normal(5));
  all.insert(NoiseChannel(7, 1001).normal(5));
  all.insert(channel.normal(6));
  all.insert(channel.normal(5 + (Tick{1} << 32U)));
  all.insert(channel.normal(5, 1));
  EXPECT_EQ(all.size(), 8U);
}

// Every compiler, level and processor; bench_noise prints the same hash.
TEST(NoiseChannel, GivesTheRecordedBits) {
  const NoiseChannel channel(1, streamOf("bench/noise/normal"));
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (Tick tick = 0; tick < 100000; ++tick) {
    const double z = channel.normal(tick);
    std::uint64_t bits = 0;
    std::memcpy(&bits, &z, sizeof(bits));
    hash = (hash ^ bits) * 0x100000001b3ULL;
  }
  EXPECT_EQ(hash, 0xd9b9a563bc33bd04ULL);
}

// The counter is (tick low, tick high, stream, draw), the key the seed; the first word is low.
TEST(NoiseChannel, DrawsFromItsCounter) {
  const NoiseChannel channel(0x299f31d0a4093822, 0x13198a2e);
  const Tick tick = static_cast<Tick>(0x85a308d3243f6a88U);
  EXPECT_EQ(channel.normal(tick, 0x03707344), normalFromBits(0x94fdccebd16cfe09U));
}

// Published test values of FNV-1a, 32 bits.
TEST(NoiseStreams, AreFnv1aOfTheName) {
  EXPECT_EQ(streamOf(""), 0x811c9dc5U);
  EXPECT_EQ(streamOf("a"), 0xe40c292cU);
  EXPECT_EQ(streamOf("foobar"), 0xbf9cf968U);
}

// Found by trying craft_0, craft_1, … in turn.
TEST(NoiseStreams, TwoNamesOfOneStreamAreRefused) {
  NoiseStreams streams;
  EXPECT_EQ(streams.add("craft_86781/imu/gyro_x"), 0x7d9915d1U);
  streams.add("craft_86781/imu/gyro_y");
  for (const std::string name : {"craft_304690/imu/gyro_x", "craft_86781/imu/gyro_x"}) {
    try {
      streams.add(name);
      ADD_FAILURE() << name << " was taken";
    } catch (const std::invalid_argument& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("'craft_86781/imu/gyro_x'"), std::string::npos) << message;
      EXPECT_NE(message.find("'" + name + "'"), std::string::npos) << message;
    }
  }
}

}  // namespace
}  // namespace hovercraft
