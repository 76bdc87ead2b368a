#include "hovercraft_sim/control/allocation.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

constexpr double kSettledGradient = 1e-12;  // of the greatest term of a gradient
constexpr int kMostRounds = 4096;           // each makes the sum smaller: no set comes twice

enum class Bound { kFree, kLow, kHigh };

using Numbers = std::array<double, kMostActuators>;

/// ½ fᵀ H f - bᵀ f within limits, H positive definite.
class BoundedQuadratic {
 public:
  BoundedQuadratic(const AllocationProblem& problem, const Vector3& wrench)
      : problem_(problem), count_(problem.count) {
    const Vector3 w2 = problem.weights.cwiseProduct(problem.weights);
    for (std::size_t i = 0; i < count_; ++i) {
      const Vector3 weighted = w2.cwiseProduct(problem.columns[i]);
      b_[i] = dot(weighted, wrench);
      for (std::size_t k = 0; k < count_; ++k) hessian_[i][k] = dot(weighted, problem.columns[k]);
      hessian_[i][i] += problem.effort * problem.effort;
      const bool starts_high = problem.high[i] < 0.0;
      f_[i] = starts_high ? problem.high[i] : problem.low[i];
      bounds_[i] = starts_high ? Bound::kHigh : Bound::kLow;
    }
  }

  Thrusts minimum() {
    for (int round = 0; round < kMostRounds; ++round) {
      const std::size_t wrong = mostWronglyHeld();
      if (wrong == count_) return f_;
      bounds_[wrong] = Bound::kFree;
      while (!moveFree()) {
      }
    }
    demand(false, "an allocation must end");
    return f_;
  }

 private:
  /// The held actuator whose move inwards lowers the sum most; count_: there is none.
  std::size_t mostWronglyHeld() const {
    std::size_t worst = count_;
    double steepest = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (bounds_[i] == Bound::kFree || problem_.low[i] == problem_.high[i]) continue;
      double gradient = -b_[i];
      double scale = std::abs(b_[i]);
      for (std::size_t k = 0; k < count_; ++k) {
        gradient += hessian_[i][k] * f_[k];
        scale += std::abs(hessian_[i][k] * f_[k]);
      }
      const double inwards = bounds_[i] == Bound::kLow ? -gradient : gradient;
      if (inwards > kSettledGradient * scale && inwards > steepest) {
        steepest = inwards;
        worst = i;
      }
    }
    return worst;
  }

  /// Moves the free ones towards their minimum. @returns false if one of them was held on the way.
  bool moveFree() {
    const Numbers wanted = freeMinimum();
    double share = 1.0;
    std::size_t first = count_;  // to reach a limit
    for (std::size_t i = 0; i < count_; ++i) {
      if (bounds_[i] != Bound::kFree) continue;
      const double way = wanted[i] - f_[i];
      const double room = way < 0.0 ? problem_.low[i] - f_[i] : problem_.high[i] - f_[i];
      if (std::abs(way) <= std::abs(room) || room / way >= share) continue;
      share = room / way;
      first = i;
    }
    for (std::size_t i = 0; i < count_; ++i) {
      if (bounds_[i] != Bound::kFree) continue;
      const double moved = f_[i] + share * (wanted[i] - f_[i]);
      f_[i] = std::clamp(moved, problem_.low[i], problem_.high[i]);
    }
    if (first == count_) return true;
    const bool is_low = wanted[first] < problem_.low[first];
    f_[first] = is_low ? problem_.low[first] : problem_.high[first];
    bounds_[first] = is_low ? Bound::kLow : Bound::kHigh;
    return false;
  }

  /// The right-hand side of one, what is held taken off.
  double loadOf(std::size_t row) const {
    double load = b_[row];
    for (std::size_t k = 0; k < count_; ++k) {
      if (bounds_[k] != Bound::kFree) load -= hessian_[row][k] * f_[k];
    }
    return load;
  }

  /// @param free their indices. @returns how many they are.
  std::size_t findFree(std::array<std::size_t, kMostActuators>& free) const {
    std::size_t n = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (bounds_[i] == Bound::kFree) free[n++] = i;
    }
    return n;
  }

  /// Solves for the free ones, the others being held (Cholesky).
  Numbers freeMinimum() const {
    std::array<std::size_t, kMostActuators> free{};
    const std::size_t n = findFree(free);
    std::array<Numbers, kMostActuators> L{};
    Numbers y{};
    for (std::size_t r = 0; r < n; ++r) {
      y[r] = loadOf(free[r]);
      for (std::size_t c = 0; c <= r; ++c) {
        double sum = hessian_[free[r]][free[c]];
        for (std::size_t k = 0; k < c; ++k) sum -= L[r][k] * L[c][k];
        L[r][c] = c == r ? std::sqrt(sum) : sum / L[c][c];
      }
      for (std::size_t k = 0; k < r; ++k) y[r] -= L[r][k] * y[k];
      y[r] /= L[r][r];
    }
    Numbers wanted{};
    for (std::size_t r = n; r-- > 0;) {
      double sum = y[r];
      for (std::size_t k = r + 1; k < n; ++k) sum -= L[k][r] * wanted[free[k]];
      wanted[free[r]] = sum / L[r][r];
    }
    return wanted;
  }

  const AllocationProblem& problem_;
  std::size_t count_;
  std::array<Numbers, kMostActuators> hessian_{};
  Numbers b_{};
  Thrusts f_{};
  std::array<Bound, kMostActuators> bounds_{};
};

}  // namespace

Thrusts allocate(const AllocationProblem& problem, const Vector3& wrench) {
  const FloatingPointEnvironment environment;
  return BoundedQuadratic(problem, wrench).minimum();
}

Vector3 wrenchOf(const AllocationProblem& problem, const Thrusts& thrusts) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < problem.count; ++i) sum += thrusts[i] * problem.columns[i];
  return sum;
}

}  // namespace hovercraft
