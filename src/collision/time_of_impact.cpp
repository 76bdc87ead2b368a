#include "hovercraft_sim/collision/time_of_impact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hovercraft_sim/collision/relative_motion.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

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

/// Half of the tolerance is left to the rounding of the last step.
constexpr double kMarginShare = 0.5;

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
    const double clear = motion.clearTime(now, t, kMarginShare * search.tolerance);
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
  const bool answered = result.status == ImpactStatus::kNone && now.status != Proximity::kStepLimit;
  result.status = answered ? ImpactStatus::kImpact : ImpactStatus::kQueryLimit;
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
    } else if (within < 0.25 * search.tolerance) {
      return {ImpactStatus::kImpact, start};
    } else if (count == ends.size()) {
      break;
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
  if (result.closest.status == Proximity::kStepLimit) result.status = ImpactStatus::kQueryLimit;
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
  const FloatingPointEnvironment environment;
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
  const FloatingPointEnvironment environment;
  check(search);
  if (!apart(start, search.tolerance)) return false;
  const RelativeMotion motion(A, motion_A, B, motion_B, search.duration);
  return motion.clearTime(start, 0.0, kMarginShare * search.tolerance) >= search.duration;
}

VertexImpact vertexPlaneImpact(const Vector3& p_B, const StepMotion& motion, const Plane& plane,
                               const ImpactSearch& search) {
  const FloatingPointEnvironment environment;
  check(search);
  const double spin = norm(motion.fastestTurn(search.duration));
  const double curvature = norm(motion.a_WB) + (spin * spin + norm(motion.alpha_WB)) * norm(p_B);
  int evaluations = 0;
  double rate = 0.0;
  const auto gap_at = [&](double t) {
    ++evaluations;
    const Pose X_WB = motion.at(t);
    const Vector3 r = times(X_WB.R_AB, p_B);
    rate = dot(plane.normal,
               Vector3(motion.v_WB + t * motion.a_WB + cross(motion.angularVelocity(t), r)));
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
