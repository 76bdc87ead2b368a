#pragma once

#include <algorithm>

#include "hovercraft_sim/collision/closest_features.h"

namespace hovercraft {

/// Largest coordinate of a pair of bodies: what errors are measured by.
inline double sizeOf(const ConvexPolyhedron& A, const Pose& X_WA, const ConvexPolyhedron& B,
                     const Pose& X_WB) {
  return A.data().radius + B.data().radius + norm(X_WB.p_AB - X_WA.p_AB);
}

/// How far (m) a point lies outside the Voronoi region of a feature; it is inside where this is not
/// positive. From the planes that the body hands out.
inline double outsideRegion(const ConvexPolyhedron& body, const Pose& X, Feature feature,
                            const Vector3& p_W) {
  const Vector3 p = inverseTransform(X, p_W);
  double worst = -1e300;
  for (const VoronoiPlane& plane : body.voronoiPlanes(feature)) {
    worst = std::max(worst, dot(plane.normal, p) - plane.offset);
  }
  return worst;
}

/// Theorem 2's condition: a in V(Fb) and b in V(Fa).
inline double certificateExcess(const ConvexPolyhedron& A, const Pose& X_WA,
                                const ConvexPolyhedron& B, const Pose& X_WB,
                                const ClosestFeatures& c) {
  return std::max(outsideRegion(A, X_WA, c.feature_a, c.p_WCb),
                  outsideRegion(B, X_WB, c.feature_b, c.p_WCa));
}

}  // namespace hovercraft
