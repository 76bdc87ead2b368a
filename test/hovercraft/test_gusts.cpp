#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/hovercraft/gusts.h"

#include "../support/numbers.h"

namespace hovercraft {
namespace {

using testing::kRounding;

constexpr std::int64_t kSeed = 20261127;
constexpr double kStep = 0.05;
constexpr double kSpeed = 5.0;
constexpr Tick kSteps = 1000000;

/// Covariance of a gust of sigma 1 at a lag of so many seconds.
using Law = std::function<double(double)>;

GustParameters sameOnAllAxes(GustModel model, double length) {
  const GustAxis axis = {1.0, length};
  return {model, axis, axis, axis};
}

std::vector<Vector3> gustsOver(const Gusts& gusts, Tick steps) {
  std::vector<Vector3> values;
  GustState state = gusts.start(0, kSeed);
  for (Tick tick = 0; tick < steps; ++tick) {
    values.push_back(gusts.velocity(state));
    gusts.advance(0, kSeed, tick + 1, state);
  }
  return values;
}

/// Bartlett's variance of an autocovariance of n samples of a Gaussian process, at lag k:
/// 1/n Σ_j (γ_j² + γ_{j+k} γ_{j-k}).
double standardError(const Law& law, int k, double n) {
  constexpr int kFar = 4000;
  double sum = 0.0;
  for (int j = -kFar; j <= kFar; ++j) {
    const auto gamma = [&](int lag) { return law(std::abs(lag) * kStep); };
    sum += gamma(j) * gamma(j) + gamma(j + k) * gamma(j - k);
  }
  return std::sqrt(sum / n);
}

void expectCovariance(const std::vector<Vector3>& gusts, int axis, const Law& law) {
  for (const int lag : {0, 1, 10, 100}) {
    double sum = 0.0;
    const std::size_t count = gusts.size() - static_cast<std::size_t>(lag);
    for (std::size_t i = 0; i < count; ++i) {
      sum += gusts[i][axis] * gusts[i + static_cast<std::size_t>(lag)][axis];
    }
    const auto n = static_cast<double>(count);
    EXPECT_LT(std::abs(sum / n - law(lag * kStep)), 4.0 * standardError(law, lag, n))
        << "axis " << axis << " lag " << lag;
  }
}

// τ = 15 m / 5 m/s = 3 s, 60 steps: at lag 100 the double pole has changed its sign.
TEST(Gusts, HaveTheCovarianceOfTheirLaw) {
  const double tau = 3.0;
  const Law first = [tau](double t) { return std::exp(-t / tau); };
  const Law across = [tau](double t) { return std::exp(-t / tau) * (1.0 - 0.5 * t / tau); };
  const auto dryden = gustsOver(
      Gusts(sameOnAllAxes(GustModel::kDryden, tau * kSpeed), kSpeed, kStep, {"craft"}), kSteps);
  expectCovariance(dryden, 0, first);
  expectCovariance(dryden, 1, across);
  expectCovariance(dryden, 2, across);
  const auto simple = gustsOver(
      Gusts(sameOnAllAxes(GustModel::kFirstOrder, tau * kSpeed), kSpeed, kStep, {"craft"}), kSteps);
  for (int axis = 0; axis < 3; ++axis) expectCovariance(simple, axis, first);
}

// The ensemble of many starts, and of many starts and one step of any length: σ² at both.
TEST(Gusts, AreStationaryFromTheirStartOnWhateverTheStep) {
  constexpr int kSeeds = 20000;
  for (const double step : {1e-4, 0.05, 3.0}) {
    const GustAxis axis = {2.0, 15.0};
    const Gusts gusts({GustModel::kDryden, axis, axis, axis}, kSpeed, step, {"craft"});
    Vector3 start = Vector3::Zero();
    Vector3 after = Vector3::Zero();
    for (std::int64_t seed = 0; seed < kSeeds; ++seed) {
      GustState state = gusts.start(0, seed);
      const Vector3 before = gusts.velocity(state);
      gusts.advance(0, seed, 1, state);
      const Vector3 now = gusts.velocity(state);
      start += before.cwiseProduct(before);
      after += now.cwiseProduct(now);
    }
    // A variance of n samples has a standard error of σ² √(2/n).
    const double error = 4.0 * 4.0 * std::sqrt(2.0 / kSeeds);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(start[i] / kSeeds, 4.0, error) << step;
      EXPECT_NEAR(after[i] / kSeeds, 4.0, error) << step;
    }
  }
}

// Two steps of h are one of 2 h in law: the covariance of what comes in between, P(2h) = F P(h) Fᵀ
// + P(h), of the exact discretisation. Seen where the start is 0: of the variances that grow.
TEST(Gusts, OfALongerStepHaveTheSameLaw) {
  const GustAxis axis = {1.0, 15.0};
  const GustParameters parameters = {GustModel::kDryden, axis, axis, axis};
  const auto variance_after = [&](double step, int steps) {
    const Gusts gusts(parameters, kSpeed, step, {"craft"});
    Vector3 sum = Vector3::Zero();
    constexpr int kSeeds = 40000;
    for (std::int64_t seed = 0; seed < kSeeds; ++seed) {
      GustState state{};
      for (Tick tick = 1; tick <= steps; ++tick) gusts.advance(0, seed, tick, state);
      const Vector3 v = gusts.velocity(state);
      sum += v.cwiseProduct(v);
    }
    return Vector3(sum / kSeeds);
  };
  const Vector3 one = variance_after(0.5, 1);
  const Vector3 ten = variance_after(0.05, 10);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(ten[i] / one[i], 1.0, 6.0 * std::sqrt(4.0 / 40000));
}

TEST(Gusts, OfOneBodyDoNotDependOnAnother) {
  const GustParameters parameters = sameOnAllAxes(GustModel::kDryden, 15.0);
  const Gusts alone(parameters, kSpeed, kStep, {"craft"});
  const Gusts together(parameters, kSpeed, kStep, {"another", "craft"});
  GustState a = alone.start(0, kSeed);
  GustState b = together.start(1, kSeed);
  GustState other = together.start(0, kSeed);
  for (Tick tick = 1; tick < 100; ++tick) {
    ASSERT_EQ(a, b);
    ASSERT_NE(a, other);
    alone.advance(0, kSeed, tick, a);
    together.advance(1, kSeed, tick, b);
    together.advance(0, kSeed, tick, other);
  }
}

TEST(Gusts, AnAxisWithoutThemStays) {
  const Gusts gusts({GustModel::kDryden, {}, {1.0, 15.0}, {}}, kSpeed, kStep, {"craft"});
  for (const Vector3& v : gustsOver(gusts, 100)) {
    EXPECT_EQ(v.x(), 0.0);
    EXPECT_NE(v.y(), 0.0);
    EXPECT_EQ(v.z(), 0.0);
  }
}

// Each axis has its own law: vertical gusts alone, of another size and length than those before.
TEST(Gusts, OfEachAxisAreItsOwn) {
  const GustParameters all = {GustModel::kDryden, {1.0, 15.0}, {2.0, 30.0}, {3.0, 60.0}};
  const Gusts together(all, kSpeed, kStep, {"craft"});
  const Gusts along({all.model, all.along, {}, {}}, kSpeed, kStep, {"craft"});
  const Gusts across({all.model, {}, all.across, {}}, kSpeed, kStep, {"craft"});
  const Gusts vertical({all.model, {}, {}, all.vertical}, kSpeed, kStep, {"craft"});
  const auto sum = gustsOver(together, 100);
  const auto x = gustsOver(along, 100);
  const auto y = gustsOver(across, 100);
  const auto z = gustsOver(vertical, 100);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    EXPECT_EQ(sum[i], Vector3(x[i].x(), y[i].y(), z[i].z())) << i;
    EXPECT_EQ(z[i].head<2>(), Vector3::Zero().head<2>()) << i;
    EXPECT_NE(z[i].z(), 0.0) << i;
  }
}

TEST(Gusts, InAlmostNoWindAreCarriedAsByOneOfOneMetreASecond) {
  const GustParameters parameters = sameOnAllAxes(GustModel::kDryden, 15.0);
  const auto slow = gustsOver(Gusts(parameters, 0.0, kStep, {"craft"}), 100);
  EXPECT_EQ(slow, gustsOver(Gusts(parameters, 1.0, kStep, {"craft"}), 100));
  EXPECT_EQ(slow, gustsOver(Gusts(parameters, 0.9, kStep, {"craft"}), 100));
  EXPECT_NE(slow, gustsOver(Gusts(parameters, 1.1, kStep, {"craft"}), 100));
}

// Stationary deviations: sigma of the first order; of x1' = -a x1 + x2, x2' = -a x2 + white noise
// of density 1 they are sqrt(1/(4 a^3)) and sqrt(1/(2 a)), and x2 is bounded by 100 of the sum
// 1/(2 sqrt(a)) + 1/(2 sqrt(a)) of its shares of both draws. a = 5/15 1/s.
TEST(Gusts, CanBeWithinAHundredDeviations) {
  const double a = kSpeed / 15.0;
  const GustAxis axis = {2.0, 15.0};
  const Gusts gusts({GustModel::kDryden, axis, axis, {}}, kSpeed, kStep, {"craft"});
  const double most[] = {200.0, 0.0, 100.0 / std::sqrt(4.0 * a * a * a), 100.0 / std::sqrt(a),
                         0.0,   0.0};
  EXPECT_TRUE(gusts.canBe(gusts.start(0, kSeed)));
  for (std::size_t i = 0; i < 6; ++i) {
    for (const double sign : {-1.0, 1.0}) {
      GustState state{};
      state[i] = sign * 0.999 * most[i];
      EXPECT_TRUE(gusts.canBe(state)) << i;
      state[i] = sign * (1.001 * most[i] + 1e-9);
      EXPECT_FALSE(gusts.canBe(state)) << i;
      state[i] = testing::kNan;
      EXPECT_FALSE(gusts.canBe(state)) << i;
    }
  }
}

TEST(Gusts, TwoBodiesOfOneNameAreRefused) {
  EXPECT_THROW(Gusts(sameOnAllAxes(GustModel::kDryden, 15.0), kSpeed, kStep, {"a", "a"}),
               std::invalid_argument);
}

TEST(Gusts, BlowAlongAndAcrossTheMeanWind) {
  EXPECT_LT(norm(gustInWorld({3.0, 4.0, 9.0}, {10.0, 0.0, 1.0}) - Vector3(6.0, 8.0, 1.0)),
            kRounding);
  EXPECT_LT(norm(gustInWorld({3.0, 4.0, 9.0}, {0.0, 10.0, 0.0}) - Vector3(-8.0, 6.0, 0.0)),
            kRounding);
  EXPECT_EQ(gustInWorld({0.0, 0.0, -2.0}, {1.0, 2.0, 3.0}), Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(gustInWorld({0.0, 0.25, 0.0}, {1.0, 2.0, 3.0}),
            Vector3(-2.0, 1.0, 3.0));  // a light air
}

}  // namespace
}  // namespace hovercraft
