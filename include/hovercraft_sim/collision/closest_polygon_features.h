#pragma once

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/geometry/convex_polygon.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// Position and orientation of a frame in the plane: p_A = (c x - s y, s x + c y) + p_AB.
struct PlanarPose {
  double cosine = 1.0;  // of the angle from A to B
  double sine = 0.0;
  Vector2 p_AB;  // m
};

/// As ClosestFeatures, in the plane.
struct ClosestPolygonFeatures {
  Proximity status = Proximity::kStepLimit;
  double distance = 0.0;  // m, negative: depth
  Vector2 p_WCa;
  Vector2 p_WCb;
  Vector2 nhat_AB_W;
  Feature feature_a;
  Feature feature_b;
  int steps = 0;
  double excess = 0.0;  // as ClosestFeatures::excess
};

/// The algorithm of Lin and Canny on two convex polygons, as the source draws it: vertices own
/// cones, edges own strips. Overlapping polygons give the least translation over all edge normals.
/// Where rounding keeps the walk from an answer all pairs are looked at: there is always one, and
/// `excess` may then be more than kVoronoiSlack.
/// @param last read as the start, written as the end.
HOVERCRAFT_PUBLIC ClosestPolygonFeatures closestFeatures(const ConvexPolygon& A,
                                                         const PlanarPose& X_WA,
                                                         const ConvexPolygon& B,
                                                         const PlanarPose& X_WB, FeaturePair& last);

}  // namespace hovercraft
