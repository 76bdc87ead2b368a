#pragma once

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// A quaternion q = [s, v] (25). A unit quaternion q_WB turns components in B into components in W;
/// q and -q are the same rotation. Not Eigen's: its alignment depends on the instruction set, and
/// so do its products.
struct Quaternion {
  double s = 1.0;               // scalar part
  Vector3 v = Vector3::Zero();  // vector part

  static Quaternion identity() { return {}; }  // no turn
};

/// Element by element: quaternions as vectors of four dimensions.
inline Quaternion operator+(const Quaternion& a, const Quaternion& b) {
  return {a.s + b.s, a.v + b.v};
}
inline Quaternion operator*(double factor, const Quaternion& q) {
  return {factor * q.s, factor * q.v};
}

/// Product (26): [s1 s2 - v1·v2, s1 v2 + s2 v1 + v1 × v2].
inline Quaternion operator*(const Quaternion& a, const Quaternion& b) {
  return {a.s * b.s - dot(a.v, b.v), (a.s * b.v + b.s * a.v) + cross(a.v, b.v)};
}

/// q* = [s, -v] (29).
inline Quaternion conjugate(const Quaternion& q) {
  return {q.s, -q.v};
}

/// Of its four numbers.
inline double squaredNorm(const Quaternion& q) {
  return q.s * q.s + dot(q.v, q.v);
}

/// Its length.
inline double norm(const Quaternion& q) {
  return std::sqrt(squaredNorm(q));
}

/// q / |q|; the caller makes sure that q is not zero.
inline Quaternion normalized(const Quaternion& q) {
  return (1.0 / norm(q)) * q;
}

/// dq/dt = ½ [0, w_WB] q = ½ [-w·v, s w + w × v] (27), angular velocity in W, rad/s. Written out:
/// every stage of every step needs it, and the product would multiply by the 0.
inline Quaternion quaternionRateWorld(const Vector3& w_WB, const Quaternion& q_WB) {
  const Vector3& w = w_WB;
  const double s = q_WB.s;
  const Vector3& v = q_WB.v;
  return {-0.5 * dot(w, v),
          {0.5 * (s * w.x() + (w.y() * v.z() - w.z() * v.y())),
           0.5 * (s * w.y() + (w.z() * v.x() - w.x() * v.z())),
           0.5 * (s * w.z() + (w.x() * v.y() - w.y() * v.x()))}};
}

/// dq/dt = ½ q [0, w_WB_B] (after (27)), angular velocity in B, rad/s.
inline Quaternion quaternionRateBody(const Quaternion& q_WB, const Vector3& w_WB_B) {
  return 0.5 * (q_WB * Quaternion{0.0, w_WB_B});
}

/// The angular velocity in W, rad/s, at which a unit quaternion changes so: [0, w] = 2 q' q*.
inline Vector3 angularVelocityOf(const Quaternion& rate, const Quaternion& q_WB) {
  return 2.0 * ((q_WB.s * rate.v - rate.s * q_WB.v) - cross(rate.v, q_WB.v));
}

/// exp([0, u/2]): the rotation about u by |u| rad, by Taylor's series of sine and cosine; to the
/// last bit or two for |u| < 0.1, and off by |u|^8 5e-9 beyond.
inline Quaternion quaternionOfSmallTurn(const Vector3& u) {
  const double x = 0.25 * squaredNorm(u);
  const double s = 1.0 - x * (1.0 / 2.0 - x * (1.0 / 24.0 - x * (1.0 / 720.0 - x / 40320.0)));
  const double sinc = 0.5 - x * (1.0 / 12.0 - x * (1.0 / 240.0 - x / 10080.0));
  return {s, sinc * u};
}

/// v_W = q v_B q* (28), for a unit q.
inline Vector3 rotate(const Quaternion& q_WB, const Vector3& v_B) {
  return (q_WB * Quaternion{0.0, v_B} * conjugate(q_WB)).v;
}

/// R(q) for a unit q (physics.md 3).
inline Matrix3 rotationMatrix(const Quaternion& q_WB) {
  const double s = q_WB.s;
  const double x = q_WB.v.x();
  const double y = q_WB.v.y();
  const double z = q_WB.v.z();
  const double x2 = x + x;
  const double y2 = y + y;
  const double z2 = z + z;
  Matrix3 R_WB;
  R_WB << 1.0 - (y2 * y + z2 * z), x2 * y - z2 * s, x2 * z + y2 * s,  //
      x2 * y + z2 * s, 1.0 - (x2 * x + z2 * z), y2 * z - x2 * s,      //
      x2 * z - y2 * s, y2 * z + x2 * s, 1.0 - (x2 * x + y2 * y);
  return R_WB;
}

/// The unit quaternion of a rotation matrix, with s >= 0 where s decides (Shepperd 1978: the
/// largest of the four components is taken from the diagonal, so that nothing is divided by a small
/// number).
HOVERCRAFT_PUBLIC Quaternion quaternionFromMatrix(const Matrix3& R_WB);

/// q = [cos θ/2, sin θ/2 u]. @param axis unit vector. @param theta rad.
HOVERCRAFT_PUBLIC Quaternion quaternionFromAxisAngle(const Vector3& axis, double theta);

/// Fixed-axis roll, pitch, yaw in rad, as rotationFromRpy().
HOVERCRAFT_PUBLIC Quaternion quaternionFromRpy(const Vector3& rpy);

/// Fixed-axis roll, pitch, yaw in rad of a unit quaternion; pitch in [-pi/2, pi/2].
HOVERCRAFT_PUBLIC Vector3 rpyFromQuaternion(const Quaternion& q_WB);

/// The angle of the rotation from a to b, rad in [0, pi]; accurate for small ones. For reports and
/// tests.
HOVERCRAFT_PUBLIC double angleBetween(const Quaternion& a, const Quaternion& b);

}  // namespace hovercraft
