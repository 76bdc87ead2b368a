#pragma once

#include <cmath>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Drag of the craft, each body axis by itself (design: the source names drag and gives no law,
/// errata 19):
///   F_i = -linear_i u_i - quadratic_i |u_i| u_i,   M_i = -angular_linear_i w_i -
///   angular_quadratic_i |w_i| w_i
/// with u the velocity of the centre of mass relative to the air and w the angular velocity, both
/// in B.
struct Drag {
  Vector3 linear = Vector3::Zero();             // N s/m
  Vector3 quadratic = Vector3::Zero();          // N s²/m² (½ ρ Cd A)
  Vector3 angular_linear = Vector3::Zero();     // N m s
  Vector3 angular_quadratic = Vector3::Zero();  // N m s²

  /// Force and moment about the centre of mass, both in B.
  Wrench wrenchInBody(const Vector3& u_B, const Vector3& w_WB_B) const {
    return {resistance(linear, quadratic, u_B),
            resistance(angular_linear, angular_quadratic, w_WB_B)};
  }

 private:
  static Vector3 resistance(const Vector3& first, const Vector3& second, const Vector3& rate) {
    return {-(first.x() + second.x() * std::abs(rate.x())) * rate.x(),
            -(first.y() + second.y() * std::abs(rate.y())) * rate.y(),
            -(first.z() + second.z() * std::abs(rate.z())) * rate.z()};
  }
};

}  // namespace hovercraft
