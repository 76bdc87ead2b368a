#pragma once

#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Position and orientation of a frame B in a frame A: p_A = R_AB p_B + p_AB.
struct Pose {
  Matrix3 R_AB = Matrix3::Identity();  // a rotation
  Vector3 p_AB = Vector3::Zero();      // m, origin of B in A
};

/// Components in A of the point whose components in B are p_B.
inline Vector3 transform(const Pose& X_AB, const Vector3& p_B) {
  return times(X_AB.R_AB, p_B) + X_AB.p_AB;
}

/// Components in B of the point whose components in A are p_A.
inline Vector3 inverseTransform(const Pose& X_AB, const Vector3& p_A) {
  return transposeTimes(X_AB.R_AB, p_A - X_AB.p_AB);
}

}  // namespace hovercraft
