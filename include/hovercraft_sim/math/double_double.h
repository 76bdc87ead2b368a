#pragma once

/// Numbers of some 106 bits as unevaluated sums of two doubles (Dekker 1971, Knuth 1969), with
/// nothing but + - * /: the same bits on every machine. For the few places where the difference of
/// nearly equal points decides.

#include <cmath>

#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// high + low, |low| at most half a unit in the last place of high.
struct DoubleDouble {
  double high = 0.0;
  double low = 0.0;

  DoubleDouble() = default;
  DoubleDouble(double value) : high(value) {}  // NOLINT: every double is one
  DoubleDouble(double h, double l) : high(h), low(l) {}
};

/// a + b, exactly (Knuth's two-sum).
inline DoubleDouble exactSum(double a, double b) {
  const double sum = a + b;
  const double part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// a b, exactly (Dekker's product with Veltkamp's split), for |a|, |b| < 1e150.
inline DoubleDouble exactProduct(double a, double b) {
  constexpr double splitter = 134217729.0;  // 2^27 + 1: halves of 26 bits
  const double as = splitter * a;
  const double a_high = as - (as - a);
  const double a_low = a - a_high;
  const double bs = splitter * b;
  const double b_high = bs - (bs - b);
  const double b_low = b - b_high;
  const double product = a * b;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble high = exactSum(a.high, b.high);
  const DoubleDouble low = exactSum(a.low, b.low);
  const DoubleDouble first = exactSum(high.high, high.low + low.high);
  return exactSum(first.high, first.low + low.low);
}

inline DoubleDouble operator-(const DoubleDouble& a) {
  return {-a.high, -a.low};
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + (-b);
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = exactProduct(a.high, b.high);
  return exactSum(product.high, product.low + (a.high * b.low + a.low * b.high));
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.high / b.high;
  const DoubleDouble rest = a - b * DoubleDouble(first);
  const double second = rest.high / b.high;
  const DoubleDouble last = rest - b * DoubleDouble(second);
  return exactSum(first, second) + DoubleDouble(last.high / b.high);
}

/// A vector of them.
struct PreciseVector {
  DoubleDouble x;
  DoubleDouble y;
  DoubleDouble z;

  PreciseVector() = default;
  PreciseVector(const DoubleDouble& first, const DoubleDouble& second, const DoubleDouble& third)
      : x(first), y(second), z(third) {}
  explicit PreciseVector(const Vector3& v) : x(v.x()), y(v.y()), z(v.z()) {}

  Vector3 rounded() const { return {x.high, y.high, z.high}; }
};

inline PreciseVector operator+(const PreciseVector& a, const PreciseVector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline PreciseVector operator-(const PreciseVector& a, const PreciseVector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline PreciseVector operator*(const DoubleDouble& factor, const PreciseVector& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}
inline DoubleDouble dot(const PreciseVector& a, const PreciseVector& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
inline PreciseVector cross(const PreciseVector& a, const PreciseVector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A v
inline PreciseVector times(const Matrix3& A, const PreciseVector& v) {
  const auto row = [&](int i) {
    return (DoubleDouble(A(i, 0)) * v.x + DoubleDouble(A(i, 1)) * v.y) +
           DoubleDouble(A(i, 2)) * v.z;
  };
  return {row(0), row(1), row(2)};
}

}  // namespace hovercraft
