#pragma once

#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/geometry/pose.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// How a frame B moves in W over a step: its origin with constant acceleration, its axes with
/// constant angular velocity.
///   p(t) = p + v t + a t²/2,  R(t) = exp(skew(w) t) R(q)
struct HOVERCRAFT_PUBLIC StepMotion {
  Vector3 p_WB = Vector3::Zero();  // m, at t = 0
  Quaternion q_WB;                 // unit, at t = 0
  Vector3 v_WB = Vector3::Zero();  // m/s at t = 0
  Vector3 a_WB = Vector3::Zero();  // m/s²
  Vector3 w_WB = Vector3::Zero();  // rad/s, in W

  /// The pose at time t, s.
  Pose at(double t) const;
};

/// The motion that takes a frame from one pose to another in `duration` s at constant velocities,
/// turning the short way. @throws std::logic_error if duration is not positive.
HOVERCRAFT_PUBLIC StepMotion motionBetween(const Vector3& p_start, const Quaternion& q_start,
                                           const Vector3& p_end, const Quaternion& q_end,
                                           double duration);

/// A box with sides along the axes of W, m.
struct AxisAlignedBox {
  Vector3 low = Vector3::Zero();
  Vector3 high = Vector3::Zero();

  /// Whether they share a point; faces that touch count.
  bool overlaps(const AxisAlignedBox& other) const {
    return low.x() <= other.high.x() && other.low.x() <= high.x() && low.y() <= other.high.y() &&
           other.low.y() <= high.y() && low.z() <= other.high.z() && other.low.z() <= high.z();
  }
};

/// A box that holds the body from t = 0 to `duration`: the boxes at both ends, widened by how far
/// a point may leave the straight line between its ends.
HOVERCRAFT_PUBLIC AxisAlignedBox sweptBox(const ConvexPolyhedron& body, const StepMotion& motion,
                                          double duration);

}  // namespace hovercraft
