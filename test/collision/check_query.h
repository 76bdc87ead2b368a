#pragma once

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/collision/closest_features.h"

#include "brute_force.h"

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

/// One answer against brute force: status, distance or depth, certificate, witness points; each
/// within 1e-12 of the size.
inline void checkAgainstBruteForce(const ConvexPolyhedron& A, const Pose& X_WA,
                                   const ConvexPolyhedron& B, const Pose& X_WB,
                                   const ClosestFeatures& c) {
  const double size = sizeOf(A, X_WA, B, X_WB);
  const brute_force::Body a = brute_force::place(A, X_WA, X_WA.p_AB);
  const brute_force::Body b = brute_force::place(B, X_WB, X_WA.p_AB);
  const double far = std::max(norm(X_WA.p_AB), norm(X_WB.p_AB));
  const double between = dot(Vector3(c.p_WCb - c.p_WCa), c.nhat_AB_W);
  EXPECT_NEAR(norm(c.nhat_AB_W), 1.0, 1e-14);
  EXPECT_NEAR(between, c.distance, 1e-12 * size + 4e-16 * far);
  if (c.status == Proximity::kSeparated) {
    const auto expected = static_cast<double>(brute_force::distance(a, b));
    EXPECT_NEAR(c.distance, expected, 1e-12 * size);
    EXPECT_LE(certificateExcess(A, X_WA, B, X_WB, c), 1e-13 * size + 4e-16 * far);
    EXPECT_LE(c.excess, 2e-14);
    // The bodies are apart, whatever the pairs say: by a plane across the normal, or, where corners
    // nearly touch and the normal is uncertain, by some plane.
    const brute_force::Vec n{c.nhat_AB_W.x(), c.nhat_AB_W.y(), c.nhat_AB_W.z()};
    if (static_cast<double>(brute_force::overlapAlong(a, b, n)) > 1e-12 * size - c.distance) {
      EXPECT_LT(c.distance, 1e-2 * size);
      EXPECT_LE(static_cast<double>(brute_force::leastOverlap(a, b)), 1e-13 * size);
    }
    return;
  }
  const auto overlap = static_cast<double>(brute_force::leastOverlap(a, b));
  ASSERT_NE(c.status, Proximity::kStepLimit);
  EXPECT_NEAR(-c.distance, overlap, 1e-12 * size);
  if (c.status == Proximity::kTouching) {
    EXPECT_NEAR(overlap, 0.0, 1e-12 * size);
  }
}

}  // namespace hovercraft
