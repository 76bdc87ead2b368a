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
    Vector3 w_A;       // angular velocities, rad/s
    Vector3 w_B;
    double closing;  // of the origins along n, m/s
    double time;     // s
    double margin;   // m
  };

  /// One of the bodies, as the bounds that are the same for both see it.
  struct Side {
    const ConvexPolyhedron& body;
    const StepMotion& motion;
    Vector3 fastest;  // angular velocity, rad/s, of all times of the step
    double spin;      // rad/s, of it
    double alpha;     // rad/s²
  };
  static Side sideOf(const ConvexPolyhedron& body, const StepMotion& motion, double duration);

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
                    int vertex, double t) const;
  double slopeCurvature(const Side& turning, double wobble, const Vector3& e, double swept) const;
  double closingOfWitnesses(const ClosestFeatures& now, double t, const Instant& instant) const;
  double curvatureAcross(const Side& side, const Vector3& n) const;
  /// Bound on the acceleration, m/s², of a body's points in the axes of the other one: inertial,
  /// Coriolis, centrifugal and Euler's.
  double turningAcceleration(const Side& axes, const Side& body) const {
    const double radius = body.body.data().radius;
    return acceleration_ + (body.spin * body.spin + body.alpha) * radius +
           2.0 * axes.spin * (speed_ + body.spin * radius) +
           (axes.spin * axes.spin + axes.alpha) * (reach_ + radius);
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
  double spin_;     // of one against the other, at most
  double spin_up_;  // rad/s², likewise
  double speed_;    // of the origins
  double reach_;    // largest distance of the origins
  double duration_;
};

}  // namespace hovercraft
