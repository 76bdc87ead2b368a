#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Impulses that give points a velocity, whatever their sign: the linear problem that is left of
/// contacts once it is known which are pressed and which hold. Of all such impulses it finds the
/// least, each measured by what it would do alone.
///
/// With y the velocities of all bodies, each measured by the root of its mass, and a row of A for
/// each direction at a point, scaled to length 1: the least |y| with A y = c, by the method of
/// multipliers (Hestenes 1969, Powell 1969):
///   (I + rho AᵀA) y = Aᵀ(rho c + mu),  mu += rho (c - A y)
/// Rows may depend on each other, as those of the four corners of a face do. The matrix has a block
/// of 6 x 6 for each body and each pair in touch, and is factored within its envelope (George and
/// Liu 1981, "Computer Solution of Large Sparse Positive Definite Systems"), bodies in the order of
/// their distance from what is fixed. + - * / and square roots in fixed order; no allocation once
/// it has grown to its working size.
class EqualitySolver {
 public:
  struct Body {
    Vector3 inverse_mass = Vector3::Zero();     // 1/kg, along each axis of W; 0: does not move
    Matrix3 inverse_inertia = Matrix3::Zero();  // 1/(kg m²), in W, positive semidefinite
  };

  /// A velocity along one direction at one point.
  struct Row {
    std::int32_t a = 0;                   // index of a body
    std::int32_t b = 0;                   // likewise
    Vector3 direction = Vector3::Zero();  // unit, in W
    Vector3 r_a = Vector3::Zero();        // m, from the centre of mass of A to the point
    Vector3 r_b = Vector3::Zero();
    double wanted = 0.0;   // m/s: what B's velocity against A's is to change by
    double impulse = 0.0;  // N s, on B; written
  };

  /// Forgets bodies and rows.
  void clear();
  /// Its index is how many were there before.
  void add(const Body& body);
  /// @returns its index. Its bodies must be there.
  std::size_t add(const Row& row);
  /// Bodies stay, and their order.
  void clearRows() { rows_.clear(); }
  /// In the order in which they were added.
  const std::vector<Row>& rows() const { return rows_; }
  /// Multiplications of 6 x 6 that factoring takes, about. Orders the bodies by the rows that are
  /// there; rows that are added later must join the same bodies.
  std::size_t order();
  /// Writes the impulses of all rows.
  void solve();

 private:
  static constexpr std::size_t kSize = 6;
  using Block = std::array<double, kSize * kSize>;  // row by row
  using Part = std::array<double, kSize>;

  struct Root {
    Vector3 mass;                       // of the inverse mass
    std::array<double, kSize> inertia;  // lower Cholesky factor of the inverse inertia, row by row
  };
  /// A row of A; a part of it is 0 where the body does not move.
  struct Scaled {
    std::int32_t place_a;  // in the order; -1: does not move
    std::int32_t place_b;
    Part a;
    Part b;
    double scale;  // (kg)^(1/2): what makes its length 1; 0: nothing moves
    double multiplier;
  };

  static constexpr std::int32_t kUnknown = -1;

  bool moves(std::size_t body) const;
  bool reach(std::int32_t from, std::int32_t to, std::int32_t level);
  std::int32_t findLevels();
  std::int32_t placeBodies();
  Part partOf(std::int32_t body, const Vector3& direction, const Vector3& arm, double sign) const;
  void scaleRows();
  void fillMatrix();
  void factor();
  void substitute();
  void pushBodies();
  void takeMisses();
  Block& block(std::size_t i, std::size_t j) { return blocks_[starts_[i] + (j - firsts_[i])]; }

  std::vector<Root> roots_;
  std::vector<Row> rows_;
  std::vector<std::int32_t> levels_;
  std::vector<std::int32_t> places_;  // of each body in the order; -1: does not move
  std::vector<std::size_t> firsts_;   // of each place, the first place that it has a block with
  std::vector<std::size_t> starts_;   // of each place, the index of that block
  std::vector<Block> blocks_;
  std::vector<Scaled> scaled_;
  std::vector<Part> y_;
};

}  // namespace hovercraft
