#pragma once

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/collision/motion.h"

namespace hovercraft {

/// The earliest time at which a gap that closes with `speed` now, and whose second derivative is at
/// least -curvature, can be zero; infinity: never.
double earliestZero(double gap, double speed, double curvature);

/// The relative motion of two bodies during a step, with bounds that hold over all of it.
class RelativeMotion {
 public:
  RelativeMotion(const ConvexPolyhedron& A, const StepMotion& motion_A, const ConvexPolyhedron& B,
                 const StepMotion& motion_B, double duration);

  /// No two points of the bodies approach faster, m/s.
  double speedBound() const { return speed_ + spin_A_ * radius_A_ + spin_B_ * radius_B_; }

  /// How long after t the bodies certainly stay farther apart than `margin`, s.
  /// @param closest their closest features at t.
  double clearTime(const ClosestFeatures& closest, double t, double margin) const;

 private:
  /// What the witness points do at time t.
  struct Instant {
    Vector3 n;         // unit, from A to B
    Vector3 v;         // velocity of B's origin against A's, m/s
    Vector3 from_A_B;  // B's origin from A's, m
    double closing;    // of the origins along n, m/s
    double time;       // s
    double margin;     // m
  };

  /// One of the bodies, as the bounds that are the same for both see it.
  struct Side {
    const ConvexPolyhedron& body;
    const StepMotion& motion;
    double spin;  // rad/s
  };

  double clearTimeAnywhere(double gap, const Instant& now) const;
  double clearTimeOfVertexFace(const ClosestFeatures& now, double t, const Instant& instant) const;
  double clearTimeOfEdges(const ClosestFeatures& now, double t, double sine,
                          const Instant& instant) const;
  double clearTimeOverFaces(const ClosestFeatures& now, const Instant& instant) const;
  double clearTimeBesideEdge(const ClosestFeatures& now, bool edge_of_A,
                             const Instant& instant) const;
  double clearTimeOverFace(const Side& face_side, int face, const Side& other, int vertex,
                           const Instant& instant) const;
  double timeLowest(const Side& face_side, const Side& other, const Vector3& up, const Pose& X_WV,
                    int vertex) const;
  double closingOfWitnesses(const ClosestFeatures& now, double t, const Instant& instant) const;
  /// Bound on the acceleration of B's points in the axes of A (or the other way round): inertial,
  /// Coriolis and centrifugal.
  double turningAcceleration(double spin_axes, double spin, double radius) const {
    return acceleration_ + spin * spin * radius + 2.0 * spin_axes * (speed_ + spin * radius) +
           spin_axes * spin_axes * (reach_ + radius);
  }

  Side side_A_;
  Side side_B_;
  const StepMotion& motion_A_;
  const StepMotion& motion_B_;
  double radius_A_;
  double radius_B_;
  double acceleration_;
  double spin_A_;
  double spin_B_;
  double spin_;
  double speed_;  // of the origins
  double reach_;  // largest distance of the origins
  double duration_;
};

}  // namespace hovercraft
