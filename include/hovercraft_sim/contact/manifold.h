#pragma once

#include <array>

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// One of the points at which two bodies touch, or are about to.
struct ContactPoint {
  Vector3 p_WC;      // m, in the middle between the bodies
  double gap = 0.0;  // m, along the normal; negative: overlap
};

/// All points of contact of a pair at one time: one for a vertex or crossing edges, two for an edge
/// along a face or parallel edges, the corners of the common area for two faces.
struct ContactManifold {
  /// Of a common area with more corners the farthest out are kept.
  static constexpr int kMaxPoints = 8;

  Vector3 nhat_AB_W = Vector3::Zero();          // unit, from A to B, the same for all points
  std::array<ContactPoint, kMaxPoints> points;  // the first `count` of them
  int count = 0;                                // of the points
  bool of_face = false;                         // the normal is that of a face
};

/// The points of a pair whose gap is at most `band`.
///
/// If a face of either body looks along the line of the closest points (within kFaceAlignment), the
/// face of the other body that looks most against it is clipped to the prism over it (Sutherland
/// and Hodgman 1974) and the corners within the band are the points; of more than eight the
/// farthest in eight directions. Two parallel edges give the ends of their common part. All else is
/// the pair of closest points, which is a point in any case.
/// @param closest of the bodies in these poses.
HOVERCRAFT_PUBLIC ContactManifold contactManifold(const ConvexPolyhedron& A, const Pose& X_WA,
                                                  const ConvexPolyhedron& B, const Pose& X_WB,
                                                  const ClosestFeatures& closest, double band);

}  // namespace hovercraft
