#pragma once

#include <cmath>

#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// How something that is pressed on the ground answers: a spring with the damping of Hunt and
/// Crossley, and Coulomb's friction made smooth.
struct GroundSpring {
  double damping = 0.0;      // alpha, s/m, >= 0
  double friction = 0.0;     // mu, >= 0
  double slip_speed = 0.02;  // v_s, m/s, > 0: friction grows up to about this speed

  /// N = max(0, k c (1 - alpha g')). (15) @param elastic k c, N. @param rate g', m/s, at which the
  /// point leaves the ground.
  double normalForce(double elastic, double rate) const {
    const double share = 1.0 - damping * rate;
    return elastic * (share > 0.0 ? share : 0.0);
  }
  /// Friction over speed along the ground, N s/m: mu N/sqrt(v_t² + v_s²). @param slip v_t², m²/s².
  double frictionPerSpeed(double N, double slip) const {
    return (friction * N) / std::sqrt(slip + slip_speed * slip_speed);
  }

  /// The force on the point: N nhat, and the friction -mu N v_t/sqrt(v_t² + v_s²). (16)
  /// @param v its velocity, in the axes of nhat and of the result.
  Vector3 force(double elastic, const Vector3& nhat, const Vector3& v) const {
    const double rate = dot(nhat, v);
    const double N = normalForce(elastic, rate);
    const Vector3 v_t = v - rate * nhat;
    return N * nhat - frictionPerSpeed(N, squaredNorm(v_t)) * v_t;
  }
};

}  // namespace hovercraft
