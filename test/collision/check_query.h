#pragma once

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/collision/closest_features.h"

#include "brute_force.h"
#include "certificate.h"

namespace hovercraft {

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
  const bool edges =
      c.feature_a.kind == FeatureKind::kEdge && c.feature_b.kind == FeatureKind::kEdge;
  EXPECT_TRUE(edges || c.edge_sine == 0.0);
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
