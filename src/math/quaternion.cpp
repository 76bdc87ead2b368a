#include "hovercraft_sim/math/quaternion.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

/// Shepperd's formula with vector component i as the largest; (i, j, k) in cyclic order.
Quaternion fromLargestComponent(const Matrix3& R, int i) {
  const int j = (i + 1) % 3;
  const int k = (i + 2) % 3;
  const double root = std::sqrt(1.0 + ((R(i, i) - R(j, j)) - R(k, k)));
  const double factor = 0.5 / root;
  Quaternion q;
  q.s = (R(k, j) - R(j, k)) * factor;
  q.v[i] = 0.5 * root;
  q.v[j] = (R(j, i) + R(i, j)) * factor;
  q.v[k] = (R(k, i) + R(i, k)) * factor;
  return q;
}

}  // namespace

Quaternion quaternionFromMatrix(const Matrix3& R_WB) {
  const FloatingPointEnvironment environment;
  const double trace = (R_WB(0, 0) + R_WB(1, 1)) + R_WB(2, 2);
  if (trace > 0.0) {
    const double root = std::sqrt(1.0 + trace);
    const double factor = 0.5 / root;
    return {0.5 * root,
            {(R_WB(2, 1) - R_WB(1, 2)) * factor, (R_WB(0, 2) - R_WB(2, 0)) * factor,
             (R_WB(1, 0) - R_WB(0, 1)) * factor}};
  }
  int largest = R_WB(1, 1) > R_WB(0, 0) ? 1 : 0;
  if (R_WB(2, 2) > R_WB(largest, largest)) largest = 2;
  return fromLargestComponent(R_WB, largest);
}

Quaternion quaternionFromAxisAngle(const Vector3& axis, double theta) {
  const FloatingPointEnvironment environment;
  return {exactCos(0.5 * theta), exactSin(0.5 * theta) * axis};
}

Quaternion quaternionFromRpy(const Vector3& rpy) {
  const FloatingPointEnvironment environment;
  const Quaternion roll = quaternionFromAxisAngle(Vector3::UnitX(), rpy.x());
  const Quaternion pitch = quaternionFromAxisAngle(Vector3::UnitY(), rpy.y());
  const Quaternion yaw = quaternionFromAxisAngle(Vector3::UnitZ(), rpy.z());
  return normalized(yaw * (pitch * roll));
}

Vector3 rpyFromQuaternion(const Quaternion& q_WB) {
  const FloatingPointEnvironment environment;
  const Matrix3 R = rotationMatrix(q_WB);
  return {exactAtan2(R(2, 1), R(2, 2)), exactAsin(std::clamp(-R(2, 0), -1.0, 1.0)),
          exactAtan2(R(1, 0), R(0, 0))};
}

double angleBetween(const Quaternion& a, const Quaternion& b) {
  const Quaternion difference = conjugate(a) * b;
  return 2.0 * std::atan2(norm(difference.v), std::abs(difference.s));
}

}  // namespace hovercraft
