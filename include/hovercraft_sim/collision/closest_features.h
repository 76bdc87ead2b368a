#pragma once

#include <array>

#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/geometry/feature.h"
#include "hovercraft_sim/geometry/pose.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// How two convex bodies lie to each other.
enum class [[nodiscard]] Proximity{
    kSeparated,    // the distance is positive
    kTouching,     // it is zero but for rounding
    kPenetrating,  // the distance is minus the depth
    kStepLimit     // the bound on the number of steps was reached: no answer
};

/// Where a query starts, and where it ended: keep it from one query of a pair of bodies to the
/// next. A fresh one lets the query look for a start by itself.
struct FeaturePair {
  bool known = false;  // whether the rest means anything
  Feature a;           // of the first body
  Feature b;           // of the second body
  std::array<std::int32_t, 2>
      hints{};  // where in the ring of a long face, the fan of a long vertex
};

/// The closest points of two convex bodies, the features that hold them, and the certificate.
struct ClosestFeatures {
  Proximity status = Proximity::kStepLimit;  // what is known; kStepLimit: nothing
  double distance = 0.0;  // m, negative: depth, the length of the least translation that parts them
  Vector3 p_WCa;          // witness point on A
  Vector3 p_WCb;          // witness point on B
  Vector3 nhat_AB_W;      // unit, from A to B: the way B parts from A
  Feature feature_a;      // that holds the point on A
  Feature feature_b;      // that holds the point on B
  int steps = 0;          // pairs of features looked at
  int climbs = 0;         // moves from vertex to vertex before them, of a query without a start
  /// The sine of the largest angle by which the line between the witness points leaves the Voronoi
  /// regions of the two features, or a bound on it; at most kVoronoiSlack when separated: theorem 2
  /// then says that no other points are closer.
  double excess = 0.0;
  double edge_sine = 0.0;  // of the angle between two edges; 0 for other features
};

/// Closest features by the algorithm of Lin and Canny (1991), over the states of V-Clip (Mirtich
/// 1998): from the last pair the walk goes to the neighbour behind the violated Voronoi plane until
/// each witness point lies in the region of the other's feature. No heap allocation; the number of
/// steps is bounded.
/// @param X_WA @param X_WB poses of the bodies, rotations orthonormal to rounding.
/// @param last read as the start, written as the end.
/// @throws std::logic_error if a pose is not finite.
HOVERCRAFT_PUBLIC ClosestFeatures closestFeatures(const ConvexPolyhedron& A, const Pose& X_WA,
                                                  const ConvexPolyhedron& B, const Pose& X_WB,
                                                  FeaturePair& last);

}  // namespace hovercraft
