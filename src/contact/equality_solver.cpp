#include "hovercraft_sim/contact/equality_solver.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/contact/active_set_tolerances.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/index.h"

namespace hovercraft {
namespace {

using Block = std::array<double, 36>;
using Part = std::array<double, 6>;

/// Lower Cholesky factor of a symmetric positive semidefinite matrix of size N, in place; a pivot
/// that is not positive makes a column of zeros: along it nothing moves.
template <std::size_t N, class Matrix>
void factorInPlace(Matrix& matrix) {
  for (std::size_t j = 0; j < N; ++j) {
    double pivot = matrix[j * N + j];
    for (std::size_t k = 0; k < j; ++k) pivot -= matrix[j * N + k] * matrix[j * N + k];
    const double root = pivot > 0.0 ? std::sqrt(pivot) : 0.0;
    const double inverse = root > 0.0 ? 1.0 / root : 0.0;
    matrix[j * N + j] = root;
    for (std::size_t i = j + 1; i < N; ++i) {
      double sum = matrix[i * N + j];
      for (std::size_t k = 0; k < j; ++k) sum -= matrix[i * N + k] * matrix[j * N + k];
      matrix[i * N + j] = sum * inverse;
    }
    for (std::size_t i = 0; i < j; ++i) matrix[i * N + j] = 0.0;
  }
}

/// C -= A Bᵀ.
void subtractProduct(const Block& A, const Block& B, Block& C) {
  Block transposed;
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j < 6; ++j) transposed[j * 6 + i] = B[i * 6 + j];
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      const double share = A[i * 6 + k];
      for (std::size_t j = 0; j < 6; ++j) C[i * 6 + j] -= share * transposed[k * 6 + j];
    }
  }
}

/// X := X L⁻ᵀ, L lower.
void divideRowsBy(const Block& L, Block& X) {
  for (std::size_t j = 0; j < 6; ++j) {
    const double inverse = 1.0 / L[j * 6 + j];
    for (std::size_t i = 0; i < 6; ++i) {
      double sum = X[i * 6 + j];
      for (std::size_t k = 0; k < j; ++k) sum -= X[i * 6 + k] * L[j * 6 + k];
      X[i * 6 + j] = sum * inverse;
    }
  }
}

void subtractTimes(const Block& A, const Part& x, Part& y) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < 6; ++k) y[i] -= A[i * 6 + k] * x[k];
  }
}

void subtractTransposedTimes(const Block& A, const Part& x, Part& y) {
  for (std::size_t k = 0; k < 6; ++k) {
    for (std::size_t i = 0; i < 6; ++i) y[i] -= A[k * 6 + i] * x[k];
  }
}

/// y := L⁻¹ y, L lower.
void divideBy(const Block& L, Part& y) {
  for (std::size_t r = 0; r < 6; ++r) {
    for (std::size_t c = 0; c < r; ++c) y[r] -= L[r * 6 + c] * y[c];
    y[r] /= L[r * 6 + r];
  }
}

/// y := L⁻ᵀ y.
void divideByTransposed(const Block& L, Part& y) {
  for (std::size_t r = 6; r-- > 0;) {
    for (std::size_t c = r + 1; c < 6; ++c) y[r] -= L[c * 6 + r] * y[c];
    y[r] /= L[r * 6 + r];
  }
}

/// C += penalty a bᵀ.
void addProduct(const Part& a, const Part& b, Block& C) {
  for (std::size_t i = 0; i < 6; ++i) {
    const double share = kEqualityPenalty * a[i];
    for (std::size_t j = 0; j < 6; ++j) C[i * 6 + j] += share * b[j];
  }
}

void addTimes(double factor, const Part& a, Part& y) {
  for (std::size_t i = 0; i < 6; ++i) y[i] += factor * a[i];
}

double product(const Part& a, const Part& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < 6; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

void EqualitySolver::clear() {
  roots_.clear();
  rows_.clear();
}

void EqualitySolver::add(const Body& body) {
  std::array<double, 9> inertia;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) inertia[at(i * 3 + j)] = body.inverse_inertia(i, j);
  }
  factorInPlace<3>(inertia);
  Root root;
  for (int i = 0; i < 3; ++i) root.mass[i] = std::sqrt(body.inverse_mass[i]);
  root.inertia = {inertia[0], inertia[3], inertia[4], inertia[6], inertia[7], inertia[8]};
  roots_.push_back(root);
}

std::size_t EqualitySolver::add(const Row& row) {
  demand(row.a >= 0 && row.b >= 0 && at(std::max(row.a, row.b)) < roots_.size(),
         "a row must name two bodies");
  rows_.push_back(row);
  return rows_.size() - 1;
}

/// What a body moves by, measured by the root of its mass, for an impulse of 1 along a direction.
EqualitySolver::Part EqualitySolver::partOf(std::int32_t body, const Vector3& direction,
                                            const Vector3& arm, double sign) const {
  const Root& root = roots_[at(body)];
  const Vector3 moment = cross(arm, direction);
  const std::array<double, 6>& R = root.inertia;
  return {sign * (root.mass.x() * direction.x()),
          sign * (root.mass.y() * direction.y()),
          sign * (root.mass.z() * direction.z()),
          sign * (R[0] * moment.x() + (R[1] * moment.y() + R[3] * moment.z())),
          sign * (R[2] * moment.y() + R[4] * moment.z()),
          sign * (R[5] * moment.z())};
}

bool EqualitySolver::moves(std::size_t body) const {
  const Root& root = roots_[body];
  double sum = root.mass.x() + root.mass.y() + root.mass.z();
  for (const double entry : root.inertia) sum += std::abs(entry);
  return sum > 0.0;
}

/// Gives a body the level after that of another. @returns whether it had none.
bool EqualitySolver::reach(std::int32_t from, std::int32_t to, std::int32_t level) {
  if (levels_[at(from)] != level || levels_[at(to)] != kUnknown) return false;
  levels_[at(to)] = level + 1;
  return true;
}

/// How many pairs each body is away from what is fixed; a group that rests on nothing begins with
/// its first body. @returns the highest level.
std::int32_t EqualitySolver::findLevels() {
  const std::size_t count = roots_.size();
  levels_.assign(count, kUnknown);
  for (std::size_t i = 0; i < count; ++i) {
    if (!moves(i)) levels_[i] = 0;
  }
  std::int32_t level = 0;
  for (std::size_t seed = 0; seed < count;) {
    bool any = false;
    for (const Row& row : rows_) {
      any = reach(row.a, row.b, level) || any;
      any = reach(row.b, row.a, level) || any;
    }
    ++level;
    if (any) continue;
    while (seed < count && levels_[seed] != kUnknown) ++seed;
    if (seed < count) levels_[seed] = level;
  }
  return level;
}

/// Places the bodies that move by level, and by index within one. @returns how many.
std::int32_t EqualitySolver::placeBodies() {
  const std::int32_t highest = findLevels();
  places_.assign(roots_.size(), -1);
  std::int32_t placed = 0;
  for (std::int32_t level = 0; level <= highest; ++level) {
    for (std::size_t i = 0; i < roots_.size(); ++i) {
      if (levels_[i] == level && moves(i)) places_[i] = placed++;
    }
  }
  return placed;
}

std::size_t EqualitySolver::order() {
  firsts_.resize(at(placeBodies()));
  for (std::size_t i = 0; i < firsts_.size(); ++i) firsts_[i] = i;
  for (const Row& row : rows_) {
    const std::int32_t low = std::min(places_[at(row.a)], places_[at(row.b)]);
    const std::int32_t high = std::max(places_[at(row.a)], places_[at(row.b)]);
    if (low >= 0) firsts_[at(high)] = std::min(firsts_[at(high)], at(low));
  }
  std::size_t work = 0;
  std::size_t blocks = 0;
  starts_.resize(firsts_.size());
  for (std::size_t i = 0; i < firsts_.size(); ++i) {
    starts_[i] = blocks;
    const std::size_t width = i - firsts_[i] + 1;
    blocks += width;
    work += width * width;
  }
  blocks_.resize(blocks);
  return work;
}

void EqualitySolver::scaleRows() {
  scaled_.resize(rows_.size());
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Row& row = rows_[k];
    Scaled& scaled = scaled_[k];
    scaled.place_a = places_[at(row.a)];
    scaled.place_b = places_[at(row.b)];
    scaled.a = partOf(row.a, row.direction, row.r_a, -1.0);
    scaled.b = partOf(row.b, row.direction, row.r_b, 1.0);
    const double squared = product(scaled.a, scaled.a) + product(scaled.b, scaled.b);
    scaled.scale = squared > 0.0 ? 1.0 / std::sqrt(squared) : 0.0;
    for (double& entry : scaled.a) entry *= scaled.scale;
    for (double& entry : scaled.b) entry *= scaled.scale;
    scaled.multiplier = 0.0;
  }
}

void EqualitySolver::fillMatrix() {
  for (Block& each : blocks_) each.fill(0.0);
  for (std::size_t i = 0; i < firsts_.size(); ++i) {
    Block& diagonal = block(i, i);
    for (std::size_t k = 0; k < kSize; ++k) diagonal[k * kSize + k] = 1.0;
  }
  for (const Scaled& row : scaled_) {
    const bool a_moves = row.place_a >= 0;
    const bool b_moves = row.place_b >= 0;
    if (a_moves) addProduct(row.a, row.a, block(at(row.place_a), at(row.place_a)));
    if (b_moves) addProduct(row.b, row.b, block(at(row.place_b), at(row.place_b)));
    if (!a_moves || !b_moves) continue;
    if (row.place_a > row.place_b) {
      addProduct(row.a, row.b, block(at(row.place_a), at(row.place_b)));
    } else {
      addProduct(row.b, row.a, block(at(row.place_b), at(row.place_a)));
    }
  }
}

void EqualitySolver::factor() {
  for (std::size_t i = 0; i < firsts_.size(); ++i) {
    for (std::size_t j = firsts_[i]; j < i; ++j) {
      Block& entry = block(i, j);
      for (std::size_t k = std::max(firsts_[i], firsts_[j]); k < j; ++k) {
        subtractProduct(block(i, k), block(j, k), entry);
      }
      divideRowsBy(block(j, j), entry);
    }
    Block& diagonal = block(i, i);
    for (std::size_t k = firsts_[i]; k < i; ++k) {
      subtractProduct(block(i, k), block(i, k), diagonal);
    }
    factorInPlace<kSize>(diagonal);
  }
}

/// y := (L Lᵀ)⁻¹ y.
void EqualitySolver::substitute() {
  const std::size_t count = firsts_.size();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = firsts_[i]; k < i; ++k) subtractTimes(block(i, k), y_[k], y_[i]);
    divideBy(block(i, i), y_[i]);
  }
  for (std::size_t i = count; i-- > 0;) {
    divideByTransposed(block(i, i), y_[i]);
    for (std::size_t k = firsts_[i]; k < i; ++k) subtractTransposedTimes(block(i, k), y_[i], y_[k]);
  }
}

/// The velocities that the multipliers and what is missed push for.
void EqualitySolver::pushBodies() {
  for (Part& part : y_) part.fill(0.0);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const Scaled& row = scaled_[k];
    const double push = kEqualityPenalty * (row.scale * rows_[k].wanted) + row.multiplier;
    if (row.place_a >= 0) addTimes(push, row.a, y_[at(row.place_a)]);
    if (row.place_b >= 0) addTimes(push, row.b, y_[at(row.place_b)]);
  }
}

/// Adds to the multipliers what the velocities still miss.
void EqualitySolver::takeMisses() {
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    Scaled& row = scaled_[k];
    double reached = 0.0;
    if (row.place_a >= 0) reached += product(row.a, y_[at(row.place_a)]);
    if (row.place_b >= 0) reached += product(row.b, y_[at(row.place_b)]);
    row.multiplier += kEqualityPenalty * (row.scale * rows_[k].wanted - reached);
  }
}

void EqualitySolver::solve() {
  scaleRows();
  fillMatrix();
  factor();
  y_.resize(firsts_.size());
  for (int turn = 0; turn < kEqualityTurns; ++turn) {
    pushBodies();
    substitute();
    takeMisses();
  }
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    rows_[k].impulse = scaled_[k].multiplier * scaled_[k].scale;
  }
}

}  // namespace hovercraft
