#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "hovercraft_sim/sensors/noise_process.h"

namespace hovercraft {
namespace {

constexpr double kPeriod = 0.01;  // s

TEST(NoiseProcess, WithoutNoiseScaleAndOffsetAreAll) {
  NoiseParameters parameters;
  parameters.scale = 0.25;
  parameters.offset = {1.0, 2.0, 3.0};
  const NoiseProcess noise(parameters, kPeriod, "craft/imu/gyroscope");
  NoiseProcess::Memory memory = noise.start(1);
  // 4 (1 + 1/4) + 1, ...
  EXPECT_EQ(noise.measure(1, 7, {4.0, 8.0, -4.0}, memory), Vector3(6.0, 12.0, -2.0));
  EXPECT_EQ(noise.variance(), 0.0);
}

TEST(NoiseProcess, WhiteNoiseHasItsDensityOverTheRootOfThePeriod) {
  NoiseParameters parameters;
  parameters.noise_density = 0.02;
  const NoiseProcess noise(parameters, kPeriod, "craft/imu/gyroscope");
  EXPECT_NEAR(noise.white(), 0.2, 1e-15);  // 0.02 / sqrt(0.01)
  NoiseProcess::Memory memory = noise.start(1);
  Vector3 squares = Vector3::Zero();
  constexpr int kCount = 100000;
  for (int n = 1; n <= kCount; ++n) {
    const Vector3 x = noise.measure(1, n, Vector3::Zero(), memory);
    squares += x.cwiseProduct(x);
  }
  // The variance of a mean of squares of normal numbers: 2/N; five standard errors.
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(squares[i] / kCount / 0.04, 1.0, 5.0 * std::sqrt(2.0 / kCount));
  }
}

/// Sigma of the bias over seeds after `samples` samples.
Vector3 biasSigma(const NoiseParameters& parameters, int samples) {
  const NoiseProcess noise(parameters, kPeriod, "craft/imu/gyroscope");
  Vector3 squares = Vector3::Zero();
  constexpr int kSeeds = 4000;
  for (std::int64_t seed = 1; seed <= kSeeds; ++seed) {
    NoiseProcess::Memory memory = noise.start(seed);
    for (int n = 1; n <= samples; ++n) noise.measure(seed, n, Vector3::Zero(), memory);
    squares += memory.bias.cwiseProduct(memory.bias);
  }
  return (squares / kSeeds).cwiseSqrt();
}

// The relative standard error of a sigma of 4000 draws is 1/sqrt(8000) = 1.1 %: 4 % is 3.6 of them.
TEST(NoiseProcess, TheBiasIsStationaryFromTheStart) {
  NoiseParameters parameters;
  parameters.random_walk = 0.3;
  parameters.bias_correlation_time = 0.08;  // eight periods
  const double sigma = 0.3 * std::sqrt(0.04);
  for (const int samples : {0, 1, 50}) {
    const Vector3 found = biasSigma(parameters, samples);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i] / sigma, 1.0, 0.04) << samples << " " << i;
  }
}

TEST(NoiseProcess, HectorsDriftIsTheSigmaOfTheBias) {
  NoiseParameters parameters;
  parameters.drift = 0.7;
  parameters.drift_frequency = 20.0;
  for (const int samples : {0, 30}) {
    const Vector3 found = biasSigma(parameters, samples);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i] / 0.7, 1.0, 0.04) << samples << " " << i;
  }
}

TEST(NoiseProcess, WithoutACorrelationTimeTheBiasWalks) {
  NoiseParameters parameters;
  parameters.random_walk = 0.3;
  EXPECT_EQ(biasSigma(parameters, 0), Vector3::Zero());
  const Vector3 found = biasSigma(parameters, 100);  // sigma = 0.3 sqrt(100 · 0.01 s)
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i] / 0.3, 1.0, 0.04);
}

// Neighbours of a Gauss-Markov process correlate by exp(-period/tau).
TEST(NoiseProcess, TheBiasDecaysByItsCorrelationTime) {
  NoiseParameters parameters;
  parameters.random_walk = 1.0;
  parameters.bias_correlation_time = 0.05;
  const NoiseProcess noise(parameters, kPeriod, "craft/imu/gyroscope");
  NoiseProcess::Memory memory = noise.start(3);
  double products = 0.0;
  double squares = 0.0;
  for (int n = 1; n <= 200000; ++n) {
    const double before = memory.bias.x();
    noise.measure(3, n, Vector3::Zero(), memory);
    products += before * memory.bias.x();
    squares += before * before;
  }
  EXPECT_NEAR(products / squares, std::exp(-0.2), 0.01);
}

// 1 - exp(-2 dt/tau) keeps no digit for tau = 1e15 s, where the process is the random walk.
TEST(NoiseProcess, AVeryLongCorrelationTimeLeavesTheKickOfTheRandomWalk) {
  NoiseParameters walk;
  walk.random_walk = 1.0;
  NoiseParameters slow = walk;
  slow.bias_correlation_time = 1e15;
  const NoiseProcess a(walk, kPeriod, "craft/imu/gyroscope");
  const NoiseProcess b(slow, kPeriod, "craft/imu/gyroscope");
  NoiseProcess::Memory of_a = {Vector3::Zero(), Vector3::Zero()};
  NoiseProcess::Memory of_b = of_a;
  const Vector3 x = a.measure(1, 5, Vector3::Zero(), of_a);
  const Vector3 y = b.measure(1, 5, Vector3::Zero(), of_b);
  EXPECT_LT((x - y).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(NoiseProcess, TheTurnOnBiasIsDrawnOnceInARun) {
  NoiseParameters parameters;
  parameters.turn_on_bias_sigma = 2.0;
  const NoiseProcess noise(parameters, kPeriod, "craft/imu/gyroscope");
  NoiseProcess::Memory memory = noise.start(5);
  const Vector3 first = noise.measure(5, 1, Vector3::Zero(), memory);
  EXPECT_EQ(noise.measure(5, 2, Vector3::Zero(), memory), first);
  EXPECT_NE(noise.start(6).turn_on, memory.turn_on);
  EXPECT_EQ(noise.variance(), 4.0);
}

// What is skipped without a bias must not change what is drawn.
TEST(NoiseProcess, TheWhiteNoiseIsTheSameWithABiasBesideIt) {
  NoiseParameters parameters;
  parameters.noise_density = 0.5;
  const NoiseProcess alone(parameters, kPeriod, "craft/imu/gyroscope");
  parameters.random_walk = 0.25;
  const NoiseProcess both(parameters, kPeriod, "craft/imu/gyroscope");
  NoiseProcess::Memory of_alone = alone.start(1);
  NoiseProcess::Memory of_both = both.start(1);
  for (Tick tick = 1; tick < 20; ++tick) {
    const Vector3 white = alone.measure(1, tick, Vector3::Zero(), of_alone);
    const Vector3 all = both.measure(1, tick, Vector3::Zero(), of_both);
    EXPECT_LT((all - of_both.bias - white).cwiseAbs().maxCoeff(), 1e-14);
  }
}

TEST(NoiseProcess, AnotherSeedOrChannelIsAnotherNoise) {
  NoiseParameters parameters;
  parameters.noise_density = 1.0;
  const NoiseProcess a(parameters, kPeriod, "craft/imu/gyroscope");
  const NoiseProcess b(parameters, kPeriod, "craft/imu/accelerometer");
  NoiseProcess::Memory memory = a.start(1);
  const Vector3 x = a.measure(1, 1, Vector3::Zero(), memory);
  EXPECT_EQ(a.measure(1, 1, Vector3::Zero(), memory), x);
  EXPECT_NE(a.measure(2, 1, Vector3::Zero(), memory), x);
  EXPECT_NE(a.measure(1, 2, Vector3::Zero(), memory), x);
  EXPECT_NE(b.measure(1, 1, Vector3::Zero(), memory), x);
}

}  // namespace
}  // namespace hovercraft
