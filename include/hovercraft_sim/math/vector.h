#pragma once

/// Vectors and matrices of three dimensions, with every sum written out in a fixed order.
///
/// Eigen holds the numbers and does what works element by element (+, -, scaling). Its reductions
/// and products are not used on the way to a state: their order of summation, and on some
/// processors a fused multiply-add, depends on the instruction set. The functions below give the
/// same bits on every machine.

#include <cmath>

#include <Eigen/Core>

namespace hovercraft {

/// Eigen::Vector3d and Eigen::Matrix3d. The order of the columns is named, as a program may set
/// another default (EIGEN_DEFAULT_TO_ROW_MAJOR).
using Vector3 = Eigen::Matrix<double, 3, 1, Eigen::ColMajor>;
using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::ColMajor>;  // column by column

// Library and program must agree where the members of a class lie, whatever each was compiled with.
// Eigen aligns what fills whole registers, such as Vector4d, Matrix4d or Quaterniond, as the
// instruction set and macros say: no public class has a member of such a type.
static_assert(sizeof(Vector3) == 3 * sizeof(double) && alignof(Vector3) == alignof(double));
static_assert(sizeof(Matrix3) == 9 * sizeof(double) && alignof(Matrix3) == alignof(double));

/// a · b
inline double dot(const Vector3& a, const Vector3& b) {
  return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

/// a × b, right-handed.
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
          a.x() * b.y() - a.y() * b.x()};
}

/// In this order of operations; no scaling: it overflows where the square of a component does.
inline double squaredNorm(const Vector3& a) {
  return dot(a, a);
}

/// Likewise.
inline double norm(const Vector3& a) {
  return std::sqrt(squaredNorm(a));
}

/// A v, column by column: each component is the sum of its three products from the left.
inline Vector3 times(const Matrix3& A, const Vector3& v) {
  return (A.col(0) * v.x() + A.col(1) * v.y()) + A.col(2) * v.z();
}

/// Aᵀ v
inline Vector3 transposeTimes(const Matrix3& A, const Vector3& v) {
  return {(A(0, 0) * v.x() + A(1, 0) * v.y()) + A(2, 0) * v.z(),
          (A(0, 1) * v.x() + A(1, 1) * v.y()) + A(2, 1) * v.z(),
          (A(0, 2) * v.x() + A(1, 2) * v.y()) + A(2, 2) * v.z()};
}

/// A B
inline Matrix3 product(const Matrix3& A, const Matrix3& B) {
  Matrix3 AB;
  for (int column = 0; column < 3; ++column) {
    const Vector3 b = B.col(column);
    AB.col(column) = times(A, b);
  }
  return AB;
}

/// The matrix of cofactors of A: cofactor(A)ᵀ A = det(A) 1.
inline Matrix3 cofactor(const Matrix3& A) {
  const Vector3 a = A.col(0);
  const Vector3 b = A.col(1);
  const Vector3 c = A.col(2);
  Matrix3 result;
  result.col(0) = cross(b, c);
  result.col(1) = cross(c, a);
  result.col(2) = cross(a, b);
  return result;
}

/// By the triple product of its columns.
inline double determinant(const Matrix3& A) {
  const Vector3 a = A.col(0);
  const Vector3 b = A.col(1);
  const Vector3 c = A.col(2);
  return dot(a, cross(b, c));
}

/// A⁻¹; the caller makes sure that A is regular.
inline Matrix3 inverse(const Matrix3& A) {
  return cofactor(A).transpose() / determinant(A);
}

}  // namespace hovercraft
