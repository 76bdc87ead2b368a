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

/// |A f - b|² is the cost of f.
struct LeastSquares {
  Eigen::MatrixXd A;
  Eigen::VectorXd b;
};

LeastSquares systemOf(const AllocationProblem& problem, const Vector3& wrench) {
  const auto n = static_cast<Eigen::Index>(problem.count);
  LeastSquares system = {Eigen::MatrixXd::Zero(3 + n, n), Eigen::VectorXd::Zero(3 + n)};
  system.b.head<3>() = problem.weights.cwiseProduct(wrench);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector3& column = problem.columns[static_cast<std::size_t>(i)];
    system.A.col(i).head<3>() = problem.weights.cwiseProduct(column);
    system.A(3 + i, i) = problem.effort;
  }
  return system;
}

/// The least of those in which the free ones may be anything: Eigen's solver.
/// @param f what the others are held at.
void solveFree(const LeastSquares& system, const std::vector<Eigen::Index>& free,
               Eigen::VectorXd& f) {
  if (free.empty()) return;
  Eigen::MatrixXd part(system.A.rows(), static_cast<Eigen::Index>(free.size()));
  for (std::size_t k = 0; k < free.size(); ++k) {
    part.col(static_cast<Eigen::Index>(k)) = system.A.col(free[k]);
  }
  const Eigen::VectorXd x = part.colPivHouseholderQr().solve(system.b - system.A * f);
  for (std::size_t k = 0; k < free.size(); ++k) f[free[k]] = x[static_cast<Eigen::Index>(k)];
}

bool isWithin(const AllocationProblem& problem, const Eigen::VectorXd& f) {
  for (std::size_t k = 0; k < problem.count; ++k) {
    const double level = f[static_cast<Eigen::Index>(k)];
    if (level < problem.low[k] - 1e-12 || level > problem.high[k] + 1e-12) return false;
  }
  return true;
}

/// The least cost over every way to hold some at their limits, the others free.
double leastCost(const AllocationProblem& problem, const Vector3& wrench) {
  const LeastSquares system = systemOf(problem, wrench);
  double least = INFINITY;
  const auto sets = std::lround(std::pow(3.0, static_cast<double>(problem.count)));
  for (long set = 0; set < sets; ++set) {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(system.A.cols());
    std::vector<Eigen::Index> free;
    long rest = set;
    for (Eigen::Index i = 0; i < f.size(); ++i, rest /= 3) {
      const auto k = static_cast<std::size_t>(i);
      if (rest % 3 == 0) free.push_back(i);
      if (rest % 3 == 1) f[i] = problem.low[k];
      if (rest % 3 == 2) f[i] = problem.high[k];
    }
    solveFree(system, free, f);
    if (isWithin(problem, f)) least = std::min(least, (system.A * f - system.b).squaredNorm());
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
