#pragma once

#include <optional>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Elementary rotations (2), (3), (4) about the first, second and third axis; theta in rad,
/// positive by the right-hand rule: rotationX(theta) is the source's R1, and so on.
HOVERCRAFT_PUBLIC Matrix3 rotationX(double theta);
HOVERCRAFT_PUBLIC Matrix3 rotationY(double theta);
HOVERCRAFT_PUBLIC Matrix3 rotationZ(double theta);

/// Fixed-axis roll, pitch, yaw in rad (REP 103): R = rotationZ(yaw) rotationY(pitch)
/// rotationX(roll).
HOVERCRAFT_PUBLIC Matrix3 rotationFromRpy(const Vector3& rpy);

/// The skew matrix of w (8): skew(w) r = w × r.
inline Matrix3 skew(const Vector3& w) {
  Matrix3 omega;
  omega << 0.0, -w.z(), w.y(),  //
      w.z(), 0.0, -w.x(),       //
      -w.y(), w.x(), 0.0;
  return omega;
}

/// dR_WB/dt = skew(w_WB) R_WB (7), with the angular velocity in W (rad/s).
inline Matrix3 rotationRate(const Vector3& w_WB, const Matrix3& R_WB) {
  Matrix3 rate;
  for (int column = 0; column < 3; ++column) {
    const Vector3 axis = R_WB.col(column);
    rate.col(column) = cross(w_WB, axis);
  }
  return rate;
}

/// The rotation matrix nearest to A in the Frobenius norm: the orthogonal factor of its polar
/// decomposition, by Newton's iteration (Higham 1986, "Computing the polar decomposition",
/// eq. 3.1). It converges quadratically from any A with a positive determinant; no axis is
/// preferred.
/// @returns none if A is singular, reflected, not finite, or so far from SO(3) that the iteration
/// does not end.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<Matrix3> findNearestRotation(const Matrix3& A);

/// The same of a matrix near SO(3). @throws std::logic_error if there is none.
HOVERCRAFT_PUBLIC Matrix3 nearestRotation(const Matrix3& A);

/// The largest entry of |RᵀR - 1|: 0 for a rotation.
HOVERCRAFT_PUBLIC double orthogonalityError(const Matrix3& R);

}  // namespace hovercraft
