#pragma once

#include "hovercraft_sim/lanes/lane_block.h"

/// Vectors, quaternions and matrices of packs: each function has the operations of the one of the
/// same name in math/vector.h and math/quaternion.h, in its order.
///
/// An instruction set `Isa` names Number, a pack of kWidth doubles, and Mask, one of as many 64-bit
/// integers (vectors of the compiler), sqrt(Number) and allOf(Mask). It is a parameter of every
/// name here: two instruction sets have no function in common.

namespace hovercraft::lanes {

template <class Isa>
using NumberOf = typename Isa::Number;
template <class Isa>
using MaskOf = typename Isa::Mask;

/// All of a pack the same.
template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> same(double value) {
  return NumberOf<Isa>{} + value;
}

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> bitsOf(MaskOf<Isa> mask) {
  return reinterpret_cast<NumberOf<Isa>>(mask);
}
template <class Isa>
[[gnu::always_inline]] inline MaskOf<Isa> maskOf(NumberOf<Isa> number) {
  return reinterpret_cast<MaskOf<Isa>>(number);
}

/// The number where the mask is set, else +0.
template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> where(MaskOf<Isa> mask, NumberOf<Isa> number) {
  return bitsOf<Isa>(mask & maskOf<Isa>(number));
}
template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> choose(MaskOf<Isa> mask, NumberOf<Isa> yes,
                                                   NumberOf<Isa> no) {
  return bitsOf<Isa>((mask & maskOf<Isa>(yes)) | (~mask & maskOf<Isa>(no)));
}

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> absolute(NumberOf<Isa> number) {
  constexpr std::int64_t kAllButSign = 0x7fffffffffffffff;
  return bitsOf<Isa>(maskOf<Isa>(number) & (MaskOf<Isa>{} + kAllButSign));
}
/// std::max(0.0, number): 0 of what is no number.
template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> notNegative(NumberOf<Isa> number) {
  return where<Isa>(NumberOf<Isa>{} < number, number);
}

/// From a row, from the lane `first` on: a multiple of the width.
template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> load(const Row& row, std::size_t first) {
  NumberOf<Isa> pack;
  __builtin_memcpy(&pack, __builtin_assume_aligned(row.of + first, sizeof(pack)), sizeof(pack));
  return pack;
}
template <class Isa>
[[gnu::always_inline]] inline MaskOf<Isa> load(const MaskRow& row, std::size_t first) {
  MaskOf<Isa> pack;
  __builtin_memcpy(&pack, __builtin_assume_aligned(row.of + first, sizeof(pack)), sizeof(pack));
  return pack;
}
template <class Isa>
[[gnu::always_inline]] inline void store(NumberOf<Isa> pack, Row& row, std::size_t first) {
  __builtin_memcpy(__builtin_assume_aligned(row.of + first, sizeof(pack)), &pack, sizeof(pack));
}
template <class Isa>
[[gnu::always_inline]] inline void store(MaskOf<Isa> pack, MaskRow& row, std::size_t first) {
  __builtin_memcpy(__builtin_assume_aligned(row.of + first, sizeof(pack)), &pack, sizeof(pack));
}

template <class Isa>
struct Vector {
  NumberOf<Isa> x, y, z;
};
template <class Isa>
struct Quaternion {
  NumberOf<Isa> s;
  Vector<Isa> v;
};
/// Column by column.
template <class Isa>
struct Matrix {
  Vector<Isa> a, b, c;
};
template <class Isa>
struct Wrench {
  Vector<Isa> force, torque;
};

template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> operator+(const Vector<Isa>& a, const Vector<Isa>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> operator-(const Vector<Isa>& a, const Vector<Isa>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> scaled(NumberOf<Isa> factor, const Vector<Isa>& v) {
  return {factor * v.x, factor * v.y, factor * v.z};
}
template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> operator+(const Wrench<Isa>& a, const Wrench<Isa>& b) {
  return {a.force + b.force, a.torque + b.torque};
}

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> dot(const Vector<Isa>& a, const Vector<Isa>& b) {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> cross(const Vector<Isa>& a, const Vector<Isa>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> times(const Matrix<Isa>& A, const Vector<Isa>& v) {
  return (scaled<Isa>(v.x, A.a) + scaled<Isa>(v.y, A.b)) + scaled<Isa>(v.z, A.c);
}
template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> transposeTimes(const Matrix<Isa>& A,
                                                         const Vector<Isa>& v) {
  return {dot(A.a, v), dot(A.b, v), dot(A.c, v)};
}

template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> chosen(MaskOf<Isa> mask, const Vector<Isa>& yes,
                                                 const Vector<Isa>& no) {
  return {choose<Isa>(mask, yes.x, no.x), choose<Isa>(mask, yes.y, no.y),
          choose<Isa>(mask, yes.z, no.z)};
}

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> squaredNorm(const Quaternion<Isa>& q) {
  return q.s * q.s + dot(q.v, q.v);
}
template <class Isa>
[[gnu::always_inline]] inline Matrix<Isa> rotationMatrix(const Quaternion<Isa>& q_WB) {
  using Number = NumberOf<Isa>;
  const Number s = q_WB.s, x = q_WB.v.x, y = q_WB.v.y, z = q_WB.v.z;
  const Number x2 = x + x, y2 = y + y, z2 = z + z;
  const Number one = same<Isa>(1.0);
  return {{one - (y2 * y + z2 * z), x2 * y + z2 * s, x2 * z - y2 * s},
          {x2 * y - z2 * s, one - (x2 * x + z2 * z), y2 * z + x2 * s},
          {x2 * z + y2 * s, y2 * z - x2 * s, one - (x2 * x + y2 * y)}};
}
template <class Isa>
[[gnu::always_inline]] inline Quaternion<Isa> quaternionRateWorld(const Vector<Isa>& w,
                                                                  const Quaternion<Isa>& q_WB) {
  const NumberOf<Isa> half = same<Isa>(0.5);
  const NumberOf<Isa> s = q_WB.s;
  const Vector<Isa>& v = q_WB.v;
  return {same<Isa>(-0.5) * dot(w, v),
          {half * (s * w.x + (w.y * v.z - w.z * v.y)), half * (s * w.y + (w.z * v.x - w.x * v.z)),
           half * (s * w.z + (w.x * v.y - w.y * v.x))}};
}

template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> loadVector(const Row* rows, std::size_t first) {
  return {load<Isa>(rows[0], first), load<Isa>(rows[1], first), load<Isa>(rows[2], first)};
}
template <class Isa>
[[gnu::always_inline]] inline Matrix<Isa> loadMatrix(const Row* rows, std::size_t first) {
  return {loadVector<Isa>(rows, first), loadVector<Isa>(rows + 3, first),
          loadVector<Isa>(rows + 6, first)};
}
template <class Isa>
[[gnu::always_inline]] inline void storeVector(const Vector<Isa>& v, Row* rows, std::size_t first) {
  store<Isa>(v.x, rows[0], first);
  store<Isa>(v.y, rows[1], first);
  store<Isa>(v.z, rows[2], first);
}

}  // namespace hovercraft::lanes
