#include "hovercraft_sim/collision/closest_features.h"

#include <cmath>

#include "hovercraft_sim/collision/feature_walk.h"
#include "hovercraft_sim/collision/penetration.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

/// Steps after which a walk from the last pair of features is given up for a start from the cube
/// map: a pair that moved on takes one to four, and ten cost less than a third of a fresh start
/// among the vertices with which a long walk hurts.
constexpr std::int32_t kWarmSteps = 10;

constexpr const char* kNotFinite = "closest features of poses that are not finite";

ClosestFeatures separated(const FeatureWalk& walk, const Vector3& origin) {
  ClosestFeatures result;
  result.status = Proximity::kSeparated;
  result.distance = walk.distance();
  result.p_WCa = walk.point(0) + origin;
  result.p_WCb = walk.point(1) + origin;
  result.nhat_AB_W = walk.normal();
  result.feature_a = walk.features()[0];
  result.feature_b = walk.features()[1];
  result.steps = walk.steps();
  result.climbs = walk.climbs();
  result.excess = walk.excess();
  result.edge_sine = walk.edgeSine();
  demand(std::isfinite(result.distance), kNotFinite);
  return result;
}

ClosestFeatures overlapping(const LeastOverlap& least, Proximity status, int steps) {
  ClosestFeatures result;
  result.status = least.complete ? status : Proximity::kStepLimit;
  result.distance = -least.overlap;
  result.p_WCa = least.p_WCa;
  result.p_WCb = least.p_WCb;
  result.nhat_AB_W = least.nhat_AB_W;
  result.feature_a = least.feature_a;
  result.feature_b = least.feature_b;
  result.steps = steps;
  demand(std::isfinite(result.distance), kNotFinite);
  return result;
}

}  // namespace

ClosestFeatures closestFeatures(const ConvexPolyhedron& A, const Pose& X_WA,
                                const ConvexPolyhedron& B, const Pose& X_WB, FeaturePair& last) {
  const FloatingPointEnvironment environment;
  FeatureWalk walk(A, X_WA, B, X_WB);
  FeatureWalk::End end = FeatureWalk::End::kImpatient;
  if (last.known) {
    walk.start(last);
    end = walk.run(kWarmSteps);
  }
  if (end == FeatureWalk::End::kImpatient) {
    walk.startAlong(walk.middleToMiddle());
    end = walk.run();
  }
  if (end != FeatureWalk::End::kClosest) {
    const LeastOverlap least = leastOverlap(A, X_WA, B, X_WB);
    last.a = least.feature_a;
    last.b = least.feature_b;
    last.known = true;
    last.hints = {0, 0};
    const double touching = kTouchingOverlap * walk.scale();
    if (least.overlap > touching) {
      return overlapping(least, Proximity::kPenetrating, walk.steps());
    }
    if (least.overlap > -touching) {
      return overlapping(least, Proximity::kTouching, walk.steps());
    }
    // A plane parts them after all: the walk goes on from the features next to it.
    walk.start(last);
    end = walk.run();
    if (end != FeatureWalk::End::kClosest) {
      return overlapping(least, Proximity::kStepLimit, walk.steps());
    }
  }
  last.known = true;
  last.a = walk.features()[0];
  last.b = walk.features()[1];
  last.hints = walk.hints();
  return separated(walk, X_WA.p_AB);
}

}  // namespace hovercraft
