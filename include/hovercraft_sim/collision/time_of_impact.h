#pragma once

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/collision/motion.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

enum class [[nodiscard]] ImpactStatus{
    kNone,         // the bodies stay apart for the whole step
    kImpact,       // at `time` they are `tolerance` apart or less, and have not met before
    kOverlapping,  // they overlap at t = 0 already
    kQueryLimit    // the bound on the number of queries was reached, or one found no answer; they
                   // have not met before `time`
};

/// How to search for the time of impact. All are never late.
enum class ImpactMethod {
  kAdvance,   // steps that no motion can outrun, from the true speed and a bound on its change
  kBisection  // halves of the step, each cleared by a bound on the speed, the earlier half first
};

struct ImpactSearch {
  double duration = 0.0;   // s, of the step
  double tolerance = 0.0;  // m, the distance that counts as contact, positive; below
                           // kTouchingDistance of all coordinates it is lost in rounding
  ImpactMethod method = ImpactMethod::kAdvance;
};

struct TimeOfImpact {
  ImpactStatus status = ImpactStatus::kNone;  // what happened first
  double time = 0.0;        // s; never after the first contact. kNone: the duration
  ClosestFeatures closest;  // at `time`
  int queries = 0;          // of closest features
};

/// The first time in a step at which two moving convex polyhedra are within `tolerance` of each
/// other.
///
/// kAdvance is conservative advancement (Mirtich 1996) with the curvature of the path: from the
/// gap f between the closest features, its rate and a bound K on its second derivative, the
/// bodies cannot meet before the root of f + f' t - K t²/2. While the normal stays in the normal
/// cones of both features, f is the distance of two features and f' is known, so that the times
/// converge as Newton's do; else f' is bounded by the speed of the bodies' farthest points. Nothing
/// tunnels: there is no sample between which something could happen.
/// @throws std::logic_error if duration or tolerance are not positive.
HOVERCRAFT_PUBLIC TimeOfImpact timeOfImpact(const ConvexPolyhedron& A, const StepMotion& motion_A,
                                            const ConvexPolyhedron& B, const StepMotion& motion_B,
                                            const ImpactSearch& search);

/// Whether the first bound of kAdvance shows already that there is no impact: two bodies that are
/// far apart, or move alike, need no query at all. @param start their closest features at t = 0.
/// @returns false if only a search can tell.
/// @throws std::logic_error if duration or tolerance are not positive.
HOVERCRAFT_PUBLIC bool isClear(const ConvexPolyhedron& A, const StepMotion& motion_A,
                               const ConvexPolyhedron& B, const StepMotion& motion_B,
                               const ClosestFeatures& start, const ImpactSearch& search);

/// A fixed plane: normal · x = offset.
struct Plane {
  Vector3 normal = Vector3::Zero();  // unit, to the free side
  double offset = 0.0;               // m
};

struct VertexImpact {
  ImpactStatus status = ImpactStatus::kNone;  // what happened first
  double time = 0.0;    // s, never after the vertex passed the plane. kNone: the duration
  double gap = 0.0;     // m, height over the plane at `time`
  int evaluations = 0;  // how often the motion was asked for
};

/// The first time in a step at which a vertex p_B of a moving body comes within `tolerance` of a
/// fixed plane: the source's first step (physics.md 5), by bisection or by steps from rate and
/// curvature; each finds the first of several contacts.
/// @throws std::logic_error if duration or tolerance are not positive.
HOVERCRAFT_PUBLIC VertexImpact vertexPlaneImpact(const Vector3& p_B, const StepMotion& motion,
                                                 const Plane& plane, const ImpactSearch& search);

}  // namespace hovercraft
