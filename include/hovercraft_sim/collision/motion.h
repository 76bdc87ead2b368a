#pragma once

#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/geometry/pose.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// How a frame B moves in W over a step: its origin with constant acceleration, its axes about one
/// axis with constant angular acceleration.
///   p(t) = p + v t + a t²/2,  R(t) = exp(skew(w t + alpha t²/2)) R(q)
/// Invariant: alpha is parallel to w, so that w + alpha t is the angular velocity.
struct HOVERCRAFT_PUBLIC StepMotion {
  Vector3 p_WB = Vector3::Zero();      // m, at t = 0
  Quaternion q_WB;                     // unit, at t = 0
  Vector3 v_WB = Vector3::Zero();      // m/s at t = 0
  Vector3 a_WB = Vector3::Zero();      // m/s²
  Vector3 w_WB = Vector3::Zero();      // rad/s at t = 0, in W
  Vector3 alpha_WB = Vector3::Zero();  // rad/s², along w_WB

  /// The pose at time t, s.
  Pose at(double t) const;
  /// The angular velocity at time t, rad/s.
  Vector3 angularVelocity(double t) const { return w_WB + t * alpha_WB; }
  /// The fastest angular velocity from t = 0 to `duration`, rad/s: that of one of its ends.
  Vector3 fastestTurn(double duration) const;
  /// Makes both ends' velocities those of a motion of `duration` s that motionBetween() gave, whose
  /// poses at both ends stay: the change of velocity over it, and of the angular velocity what lies
  /// along the axis that it turns about. @param dv_WB m/s. @param dw_WB rad/s.
  void bend(const Vector3& dv_WB, const Vector3& dw_WB, double duration);
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
