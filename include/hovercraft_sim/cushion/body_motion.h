#pragma once

#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// How a body moves, in its frame B at the centre of mass.
struct BodyMotion {
  Matrix3 R_WB;    // axes of B in W
  Vector3 p_WB;    // m
  Vector3 v_WB_B;  // m/s, of B in W
  Vector3 w_WB_B;  // rad/s
  Vector3 u_B;     // m/s, of B relative to the air

  /// Of a point of the body, m/s, in B.
  Vector3 velocityAt(const Vector3& p_B) const { return v_WB_B + cross(w_WB_B, p_B); }
};

}  // namespace hovercraft
