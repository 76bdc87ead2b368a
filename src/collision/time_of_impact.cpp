#include "hovercraft_sim/collision/time_of_impact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

/// The earliest time at which a gap f that closes with `speed` now, and whose second derivative is
/// at least -curvature, can be zero.
double earliestZero(double gap, double speed, double curvature) {
  const double root = std::sqrt(speed * speed + 2.0 * curvature * gap);
  if (speed > 0.0) return 2.0 * gap / (speed + root);
  return curvature > 0.0 ? (root - speed) / curvature : kNever;
}

/// The relative motion of two bodies during a step, with bounds that hold over all of it.
class RelativeMotion {
 public:
  RelativeMotion(const ConvexPolyhedron& A, const StepMotion& motion_A, const ConvexPolyhedron& B,
                 const StepMotion& motion_B, double duration)
      : motion_A_(motion_A),
        motion_B_(motion_B),
        radius_A_(A.data().radius),
        radius_B_(B.data().radius) {
    const Vector3 a = motion_B_.a_WB - motion_A_.a_WB;
    const Vector3 w = motion_B_.w_WB - motion_A_.w_WB;
    acceleration_ = norm(a);
    spin_A_ = norm(motion_A_.w_WB);
    spin_B_ = norm(motion_B_.w_WB);
    spin_ = norm(w);
    speed_ = norm(motion_B_.v_WB - motion_A_.v_WB) + acceleration_ * duration;
    reach_ = norm(motion_B_.p_WB - motion_A_.p_WB) + speed_ * duration;
  }

  /// No two points of the bodies approach faster, m/s.
  double speedBound() const { return speed_ + spin_A_ * radius_A_ + spin_B_ * radius_B_; }

  double clearTime(const ClosestFeatures& now, double t) const;

 private:
  /// What the witness points do at time t.
  struct Instant {
    Vector3 n;         // unit, from A to B
    Vector3 v;         // velocity of B's origin against A's, m/s
    Vector3 from_A_B;  // B's origin from A's, m
    double closing;    // of the origins along n, m/s
  };

  double clearTimeAnywhere(double gap, const Instant& now) const;
  double clearTimeOfVertexFace(const ClosestFeatures& now, double t, const Instant& instant) const;
  double clearTimeOfEdges(const ClosestFeatures& now, double t, double sine,
                          const Instant& instant) const;
  double closingOfWitnesses(const ClosestFeatures& now, double t, const Instant& instant) const;
  /// Bound on the acceleration of B's points in the axes of A (or the other way round): inertial,
  /// Coriolis and centrifugal.
  double turningAcceleration(double spin_axes, double spin, double radius) const {
    return acceleration_ + spin * spin * radius + 2.0 * spin_axes * (speed_ + spin * radius) +
           spin_axes * spin_axes * (reach_ + radius);
  }

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
};

/// A plane across n, fixed in W, in A or in B, stays between the bodies for at least this long.
double RelativeMotion::clearTimeAnywhere(double gap, const Instant& now) const {
  const Vector3 w = motion_B_.w_WB - motion_A_.w_WB;
  const double across = norm(cross(w, now.n));
  const double in_W = now.closing + norm(cross(motion_A_.w_WB, now.n)) * radius_A_ +
                      norm(cross(motion_B_.w_WB, now.n)) * radius_B_;
  const double in_A =
      now.closing + dot(now.n, cross(motion_A_.w_WB, now.from_A_B)) + across * radius_B_;
  const double in_B =
      now.closing + dot(now.n, cross(motion_B_.w_WB, now.from_A_B)) + across * radius_A_;
  const double curvature_W =
      acceleration_ + spin_A_ * spin_A_ * radius_A_ + spin_B_ * spin_B_ * radius_B_;
  return std::max(
      earliestZero(gap, in_W, curvature_W),
      std::max(earliestZero(gap, in_A, turningAcceleration(spin_A_, spin_B_, radius_B_)),
               earliestZero(gap, in_B, turningAcceleration(spin_B_, spin_A_, radius_A_))));
}

/// Speed at which the witness points, fixed to their bodies, approach along n.
double RelativeMotion::closingOfWitnesses(const ClosestFeatures& now, double t,
                                          const Instant& instant) const {
  const Vector3 r_A =
      now.p_WCa - (motion_A_.p_WB + t * (motion_A_.v_WB + (0.5 * t) * motion_A_.a_WB));
  const Vector3 r_B =
      now.p_WCb - (motion_B_.p_WB + t * (motion_B_.v_WB + (0.5 * t) * motion_B_.a_WB));
  return instant.closing +
         dot(instant.n, Vector3(cross(motion_A_.w_WB, r_A) - cross(motion_B_.w_WB, r_B)));
}

/// While the face's normal stays in the cone of the vertex, the gap is the height of this vertex
/// over the plane of the face.
double RelativeMotion::clearTimeOfVertexFace(const ClosestFeatures& now, double t,
                                             const Instant& instant) const {
  const double in_cone = spin_ > 0.0 ? -now.excess / spin_ : kNever;
  const bool face_A = now.feature_a.kind == FeatureKind::kFace;
  const double curvature = face_A ? turningAcceleration(spin_A_, spin_B_, radius_B_)
                                  : turningAcceleration(spin_B_, spin_A_, radius_A_);
  return std::min(in_cone,
                  earliestZero(now.distance, closingOfWitnesses(now, t, instant), curvature));
}

/// While the common normal of the edges' lines stays in the cones of both, the gap is the distance
/// of the lines, g / s with g = w · (e_A × e_B) and s the sine of their angle. In the axes of A:
/// |N'| <= w, |N''| <= w² + w_A w_B for N = e_A × e_B, and s stays above half of what it is now for
/// as long as the cones allow.
double RelativeMotion::clearTimeOfEdges(const ClosestFeatures& now, double t, double sine,
                                        const Instant& instant) const {
  const double s = 0.5 * sine;
  const double in_cone = spin_ > 0.0 ? std::min(1.0, -now.excess) * s / spin_ : kNever;
  const double second = spin_ * spin_ + spin_A_ * spin_B_;
  const double size = reach_ + radius_A_ + radius_B_;
  const double speed = speed_ + spin_B_ * radius_B_ + spin_A_ * (reach_ + radius_B_);
  const double g_first = speed + size * spin_;
  const double g_second =
      turningAcceleration(spin_A_, spin_B_, radius_B_) + 2.0 * speed * spin_ + size * second;
  const double s_second = second + spin_ * spin_ / s;
  const double curvature = g_second / s + 2.0 * g_first * spin_ / (s * s) +
                           size * s_second / (s * s) + 2.0 * size * spin_ * spin_ / (s * s * s);
  return std::min(in_cone,
                  earliestZero(now.distance, closingOfWitnesses(now, t, instant), curvature));
}

double RelativeMotion::clearTime(const ClosestFeatures& now, double t) const {
  Instant instant{
      now.nhat_AB_W, (motion_B_.v_WB - motion_A_.v_WB) + t * (motion_B_.a_WB - motion_A_.a_WB),
      (motion_B_.p_WB - motion_A_.p_WB) +
          t * ((motion_B_.v_WB - motion_A_.v_WB) + (0.5 * t) * (motion_B_.a_WB - motion_A_.a_WB)),
      0.0};
  instant.closing = -dot(instant.n, instant.v);
  double clear = clearTimeAnywhere(now.distance, instant);
  const FeatureKind a = now.feature_a.kind;
  const FeatureKind b = now.feature_b.kind;
  if (a == FeatureKind::kFace || b == FeatureKind::kFace) {
    clear = std::max(clear, clearTimeOfVertexFace(now, t, instant));
  } else if (a == FeatureKind::kEdge && b == FeatureKind::kEdge && now.edge_sine > 0.0) {
    clear = std::max(clear, clearTimeOfEdges(now, t, now.edge_sine, instant));
  }
  return clear;
}

/// The two bodies as a function of time.
class Scene {
 public:
  Scene(const ConvexPolyhedron& A, const StepMotion& motion_A, const ConvexPolyhedron& B,
        const StepMotion& motion_B)
      : body_A_(A), motion_A_(motion_A), body_B_(B), motion_B_(motion_B) {}

  ClosestFeatures at(double t) {
    ++queries_;
    return closestFeatures(body_A_, motion_A_.at(t), body_B_, motion_B_.at(t), pair_);
  }
  int queries() const { return queries_; }

 private:
  const ConvexPolyhedron& body_A_;
  const StepMotion& motion_A_;
  const ConvexPolyhedron& body_B_;
  const StepMotion& motion_B_;
  FeaturePair pair_;
  int queries_ = 0;
};

bool apart(const ClosestFeatures& closest, double tolerance) {
  return closest.status == Proximity::kSeparated && closest.distance > tolerance;
}

/// For how long the bodies certainly stay farther than half of the tolerance apart: the other half
/// is left to the rounding of the last step.
double clearTime(const RelativeMotion& motion, const ClosestFeatures& now, double t,
                 double tolerance) {
  ClosestFeatures gap = now;
  gap.distance -= 0.5 * tolerance;
  return motion.clearTime(gap, t);
}

TimeOfImpact advance(Scene& scene, const ClosestFeatures& start, const RelativeMotion& motion,
                     const ImpactSearch& search) {
  TimeOfImpact result;
  ClosestFeatures now = start;
  double t = 0.0;
  while (apart(now, search.tolerance)) {
    if (scene.queries() >= kMaxImpactQueries) {
      result.status = ImpactStatus::kQueryLimit;
      break;
    }
    const double clear = clearTime(motion, now, t, search.tolerance);
    result.closest = now;
    result.time = t;
    if (t + clear >= search.duration) {
      result.time = search.duration;
      result.closest = scene.at(search.duration);
      result.queries = scene.queries();
      return result;
    }
    t += clear;
    now = scene.at(t);
  }
  if (result.status != ImpactStatus::kQueryLimit) result.status = ImpactStatus::kImpact;
  result.time = t;
  result.closest = now;
  result.queries = scene.queries();
  return result;
}

/// What bisection found.
struct Halving {
  ImpactStatus status;
  double time;
};

/// The intervals not yet cleared lie on a stack, the earliest on top; each is cleared by the
/// distance in its middle, or halved.
/// @param speed bound on the change of the distance, m/s. @param distance_at 0 when they overlap.
template <typename Distance>
Halving halve(const ImpactSearch& search, double speed, const Distance& distance_at) {
  std::array<double, 128> ends{};
  std::size_t count = 0;
  ends[count++] = search.duration;
  double start = 0.0;
  for (int looks = 0; looks < kMaxImpactQueries; ++looks) {
    const double end = ends[count - 1];
    const double middle = 0.5 * (start + end);
    const double within = speed * (0.5 * (end - start));
    if (distance_at(middle) > within + 0.25 * search.tolerance) {
      start = end;
      if (--count == 0) return {ImpactStatus::kNone, start};
    } else if (within < 0.25 * search.tolerance || count == ends.size()) {
      return {ImpactStatus::kImpact, start};
    } else {
      ends[count++] = middle;
    }
  }
  return {ImpactStatus::kQueryLimit, start};
}

TimeOfImpact bisect(Scene& scene, const RelativeMotion& motion, const ImpactSearch& search) {
  const auto distance_at = [&](double t) {
    const ClosestFeatures now = scene.at(t);
    return now.status == Proximity::kSeparated ? now.distance : 0.0;
  };
  const Halving found = halve(search, motion.speedBound(), distance_at);
  TimeOfImpact result;
  result.status = found.status;
  result.time = found.time;
  result.closest = scene.at(found.time);
  result.queries = scene.queries();
  return result;
}

void check(const ImpactSearch& search) {
  demand(search.duration > 0.0, "a search for an impact needs a positive duration");
  demand(search.tolerance > 0.0, "a search for an impact needs a positive tolerance");
}

}  // namespace

TimeOfImpact timeOfImpact(const ConvexPolyhedron& A, const StepMotion& motion_A,
                          const ConvexPolyhedron& B, const StepMotion& motion_B,
                          const ImpactSearch& search) {
  check(search);
  Scene scene(A, motion_A, B, motion_B);
  const RelativeMotion motion(A, motion_A, B, motion_B, search.duration);
  const ClosestFeatures start = scene.at(0.0);
  if (start.status == Proximity::kPenetrating) {
    TimeOfImpact result;
    result.status = ImpactStatus::kOverlapping;
    result.closest = start;
    result.queries = scene.queries();
    return result;
  }
  return search.method == ImpactMethod::kAdvance ? advance(scene, start, motion, search)
                                                 : bisect(scene, motion, search);
}

bool isClear(const ConvexPolyhedron& A, const StepMotion& motion_A, const ConvexPolyhedron& B,
             const StepMotion& motion_B, const ClosestFeatures& start, const ImpactSearch& search) {
  check(search);
  if (!apart(start, search.tolerance)) return false;
  const RelativeMotion motion(A, motion_A, B, motion_B, search.duration);
  return clearTime(motion, start, 0.0, search.tolerance) >= search.duration;
}

VertexImpact vertexPlaneImpact(const Vector3& p_B, const StepMotion& motion, const Plane& plane,
                               const ImpactSearch& search) {
  check(search);
  const double spin = norm(motion.w_WB);
  const double curvature = norm(motion.a_WB) + spin * spin * norm(p_B);
  int evaluations = 0;
  double rate = 0.0;
  const auto gap_at = [&](double t) {
    ++evaluations;
    const Pose X_WB = motion.at(t);
    const Vector3 r = times(X_WB.R_AB, p_B);
    rate = dot(plane.normal, Vector3(motion.v_WB + t * motion.a_WB + cross(motion.w_WB, r)));
    return dot(plane.normal, Vector3(X_WB.p_AB + r)) - plane.offset;
  };
  double gap = gap_at(0.0);
  if (gap < 0.0) return {ImpactStatus::kOverlapping, 0.0, gap, evaluations};
  if (search.method == ImpactMethod::kBisection) {
    const double speed = norm(motion.v_WB) + norm(motion.a_WB) * search.duration + spin * norm(p_B);
    const Halving found = halve(search, speed, gap_at);
    gap = gap_at(found.time);
    return {found.status, found.time, gap, evaluations};
  }
  double t = 0.0;
  while (gap > search.tolerance) {
    if (evaluations >= kMaxImpactQueries) return {ImpactStatus::kQueryLimit, t, gap, evaluations};
    t += earliestZero(gap - 0.5 * search.tolerance, -rate, curvature);
    if (t >= search.duration) {
      gap = gap_at(search.duration);
      return {ImpactStatus::kNone, search.duration, gap, evaluations};
    }
    gap = gap_at(t);
  }
  return {ImpactStatus::kImpact, t, gap, evaluations};
}

}  // namespace hovercraft
