#pragma once

/// What hovercraft_sim/math/vector.h would be without the rules of determinism: Eigen's own
/// products and reductions. scripts/determinism cost builds the core with this in its place, to
/// measure what the rules cost; nothing else does.

#include <Eigen/Dense>

namespace hovercraft {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

inline double dot(const Vector3& a, const Vector3& b) {
  return a.dot(b);
}
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return a.cross(b);
}
inline double squaredNorm(const Vector3& a) {
  return a.squaredNorm();
}
inline double norm(const Vector3& a) {
  return a.norm();
}
inline Vector3 times(const Matrix3& A, const Vector3& v) {
  return A * v;
}
inline Vector3 transposeTimes(const Matrix3& A, const Vector3& v) {
  return A.transpose() * v;
}
inline Matrix3 product(const Matrix3& A, const Matrix3& B) {
  return A * B;
}
inline Matrix3 cofactor(const Matrix3& A) {
  return A.determinant() * A.inverse().transpose();
}
inline double determinant(const Matrix3& A) {
  return A.determinant();
}
inline Matrix3 inverse(const Matrix3& A) {
  return A.inverse();
}

}  // namespace hovercraft
