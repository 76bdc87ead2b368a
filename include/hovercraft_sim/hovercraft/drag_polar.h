#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/hovercraft/environment.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Drag in the plane by the direction in which the air comes, as a wind tunnel gives it. With
/// V² = u_x² + u_y², the dynamic pressure q = ρ V²/2 and the angle β of u from the bow to the left:
///   F_x = -q S_x Σ a_k cos kβ (k = 0..5),  F_y = -q S_y Σ b_k sin kβ (k = 1..6),
///   M_z = -q S_y L Σ c_k sin kβ (k = 1..6),
/// u being the velocity of the centre of mass relative to the air, in B. The cosines and sines come
/// by Chebyshev's recursion from u_x/V and u_y/V: no trigonometric function, and -β mirrors β to
/// the last bit.
struct DragPolar {
  static constexpr std::size_t kTerms = 6;   // terms of each sum
  using Terms = std::array<double, kTerms>;  // its coefficients

  double air_density = kStandardAirDensity;  // kg/m³
  double area_x = 0.0;                       // m², that the bow shows
  double area_y = 0.0;                       // m², that a side shows
  double length = 0.0;                       // m, of the moment
  Terms surge{};                             // a_0 to a_5
  Terms sway{};                              // b_1 to b_6
  Terms yaw{};                               // c_1 to c_6

  /// The three sums in one direction.
  /// @param cosine and @param sine of β.
  Vector3 coefficients(double cosine, double sine) const {
    double cos_k = 1.0;        // of k = 0
    double cos_next = cosine;  // of k + 1
    double sin_k = 0.0;
    double sin_next = sine;
    Vector3 sums = Vector3::Zero();
    for (std::size_t k = 0; k < kTerms; ++k) {
      sums += Vector3(surge[k] * cos_k, sway[k] * sin_next, yaw[k] * sin_next);
      const double cos_after = 2.0 * cosine * cos_next - cos_k;
      const double sin_after = 2.0 * cosine * sin_next - sin_k;
      cos_k = cos_next, cos_next = cos_after;
      sin_k = sin_next, sin_next = sin_after;
    }
    return sums;
  }

  /// Force and moment about the centre of mass, both in B; 0 where the air stands.
  Wrench wrenchInBody(const Vector3& u_B) const {
    const double square = u_B.x() * u_B.x() + u_B.y() * u_B.y();
    if (!(square > 0.0)) return {};
    const double speed = std::sqrt(square);
    const Vector3 sums = coefficients(u_B.x() / speed, u_B.y() / speed);
    const double pressure = 0.5 * air_density * square;
    return {Vector3(-(pressure * area_x) * sums.x(), -(pressure * area_y) * sums.y(), 0.0),
            Vector3(0.0, 0.0, -(pressure * area_y) * (length * sums.z()))};
  }

  /// By quadratic drag of each axis, N s²/m²: what it has ahead and to the side.
  Vector3 quadraticDrag() const {
    const double half = 0.5 * air_density;
    const double ahead = coefficients(1.0, 0.0).x();
    const double sideways = coefficients(0.0, 1.0).y();
    return {half * area_x * std::max(0.0, ahead), half * area_y * std::max(0.0, sideways), 0.0};
  }
};

}  // namespace hovercraft
