#include "hovercraft_sim/math/rotation.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {

Matrix3 rotationX(double theta) {
  const FloatingPointEnvironment environment;
  const double c = exactCos(theta);
  const double s = exactSin(theta);
  Matrix3 R;
  R << 1.0, 0.0, 0.0,  //
      0.0, c, -s,      //
      0.0, s, c;
  return R;
}

Matrix3 rotationY(double theta) {
  const FloatingPointEnvironment environment;
  const double c = exactCos(theta);
  const double s = exactSin(theta);
  Matrix3 R;
  R << c, 0.0, s,     //
      0.0, 1.0, 0.0,  //
      -s, 0.0, c;
  return R;
}

Matrix3 rotationZ(double theta) {
  const FloatingPointEnvironment environment;
  const double c = exactCos(theta);
  const double s = exactSin(theta);
  Matrix3 R;
  R << c, -s, 0.0,  //
      s, c, 0.0,    //
      0.0, 0.0, 1.0;
  return R;
}

Matrix3 rotationFromRpy(const Vector3& rpy) {
  const FloatingPointEnvironment environment;
  return product(rotationZ(rpy.z()), product(rotationY(rpy.y()), rotationX(rpy.x())));
}

double orthogonalityError(const Matrix3& R) {
  double worst = 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const Vector3 a = R.col(i);
      const Vector3 b = R.col(j);
      worst = std::max(worst, std::abs(dot(a, b) - (i == j ? 1.0 : 0.0)));
    }
  }
  return worst;
}

std::optional<Matrix3> findNearestRotation(const Matrix3& A) {
  Matrix3 R = A;
  for (int iteration = 0; iteration < kMaxPolarIterations; ++iteration) {
    const double det = determinant(R);
    if (!(det > 0.0 && std::isfinite(det))) return std::nullopt;
    const double before = orthogonalityError(R);
    R = 0.5 * (R + cofactor(R) / det);
    // The error is squared by each step: one step from here ends below the rounding error.
    if (before < kPolarLastStep) return R;
  }
  return std::nullopt;
}

Matrix3 nearestRotation(const Matrix3& A) {
  const std::optional<Matrix3> R = findNearestRotation(A);
  demand(R.has_value(), "a rotation matrix has lost its orientation");
  return *R;
}

}  // namespace hovercraft
