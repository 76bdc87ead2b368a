#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "hovercraft_sim/control/allocation.h"

namespace hovercraft {
namespace {

double costOf(const AllocationProblem& problem, const Vector3& wrench, const Thrusts& f) {
  const Vector3 error = (wrenchOf(problem, f) - wrench).cwiseProduct(problem.weights);
  double cost = error.squaredNorm();
  for (std::size_t i = 0; i < problem.count; ++i) {
    cost += problem.effort * problem.effort * f[i] * f[i];
  }
  return cost;
}

/// The least cost over every way to hold some at their limits, the others free: Eigen's solver.
// NOLINTNEXTLINE(readability-function-cognitive-complexity): to be split.
double leastCost(const AllocationProblem& problem, const Vector3& wrench) {
  const auto n = static_cast<Eigen::Index>(problem.count);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3 + n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(3 + n);
  for (int r = 0; r < 3; ++r) {
    b[r] = problem.weights[r] * wrench[r];
    for (Eigen::Index i = 0; i < n; ++i) {
      A(r, i) = problem.weights[r] * problem.columns[static_cast<std::size_t>(i)][r];
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) A(3 + i, i) = problem.effort;
  double least = INFINITY;
  const auto sets = static_cast<int>(std::lround(std::pow(3.0, static_cast<double>(n))));
  for (int set = 0; set < sets; ++set) {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(n);
    std::vector<Eigen::Index> free;
    for (int i = 0, rest = set; i < n; ++i, rest /= 3) {
      const auto k = static_cast<std::size_t>(i);
      if (rest % 3 == 0) free.push_back(i);
      if (rest % 3 == 1) f[i] = problem.low[k];
      if (rest % 3 == 2) f[i] = problem.high[k];
    }
    if (!free.empty()) {
      Eigen::MatrixXd part(3 + n, static_cast<Eigen::Index>(free.size()));
      for (std::size_t k = 0; k < free.size(); ++k) {
        part.col(static_cast<Eigen::Index>(k)) = A.col(free[k]);
      }
      const Eigen::VectorXd x = part.colPivHouseholderQr().solve(b - A * f);
      for (std::size_t k = 0; k < free.size(); ++k) f[free[k]] = x[static_cast<Eigen::Index>(k)];
    }
    bool is_possible = true;
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto k = static_cast<std::size_t>(i);
      is_possible =
          is_possible && f[i] >= problem.low[k] - 1e-12 && f[i] <= problem.high[k] + 1e-12;
    }
    if (is_possible) least = std::min(least, (A * f - b).squaredNorm());
  }
  return least;
}

TEST(Allocation, IsTheLeastOfAllWaysToHoldActuators) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int trial = 0; trial < 600; ++trial) {
    AllocationProblem problem;
    problem.count = static_cast<std::size_t>(1 + trial % 6);
    for (std::size_t i = 0; i < problem.count; ++i) {
      problem.columns[i] = {unit(random), unit(random), unit(random)};
      problem.low[i] = trial % 3 == 0 ? 0.0 : -std::abs(unit(random));
      problem.high[i] = trial % 5 == 0 ? problem.low[i] : problem.low[i] + std::abs(unit(random));
    }
    problem.weights = {1.0, 0.5, 10.0};
    problem.effort = trial % 2 == 0 ? 1e-4 : 0.1;
    const Vector3 wrench = 3.0 * Vector3(unit(random), unit(random), unit(random));
    const Thrusts f = allocate(problem, wrench);
    for (std::size_t i = 0; i < problem.count; ++i) {
      EXPECT_GE(f[i], problem.low[i]);
      EXPECT_LE(f[i], problem.high[i]);
    }
    EXPECT_NEAR(costOf(problem, wrench, f), leastCost(problem, wrench), 1e-9) << trial;
  }
}

// The MVWT craft: two fans 0.123 m beside the axis. F = l + r, M = 0.123 (r - l).
TEST(Allocation, TwoFansShareForceAndMoment) {
  AllocationProblem problem;
  problem.count = 2;
  problem.columns[0] = {1.0, 0.0, -0.123};
  problem.columns[1] = {1.0, 0.0, 0.123};
  problem.high = {4.5, 4.5};
  problem.effort = 1e-8;
  const Thrusts f = allocate(problem, {4.0, 0.0, 0.123});
  EXPECT_NEAR(f[0], 1.5, 1e-9);
  EXPECT_NEAR(f[1], 2.5, 1e-9);
}

TEST(Allocation, AnActuatorWithoutRangeStaysWhereItIs) {
  AllocationProblem problem;
  problem.count = 1;
  problem.columns[0] = {1.0, 0.0, 0.0};
  problem.low[0] = problem.high[0] = -2.0;
  EXPECT_EQ(allocate(problem, {5.0, 0.0, 0.0})[0], -2.0);
}

}  // namespace
}  // namespace hovercraft
