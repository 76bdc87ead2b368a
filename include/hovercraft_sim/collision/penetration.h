#pragma once

#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/geometry/feature.h"
#include "hovercraft_sim/geometry/pose.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// The direction along which two convex bodies overlap least.
struct LeastOverlap {
  double overlap = 0.0;  // m, how far B must move along nhat_AB_W to part; negative: a gap
  Vector3 nhat_AB_W;     // unit
  Feature feature_a;     // the features that meet when they part: face and vertex, or two edges
  Feature feature_b;
  Vector3 p_WCa;  // points of them, overlap apart along nhat_AB_W
  Vector3 p_WCb;
  bool complete = true;  // false: a bound cut the search off, and there may be less
};

/// The least overlap over all faces of the Minkowski difference of A and B: each face of one body
/// with the support vertex of the other, and each pair of edges whose arcs on the sphere of normals
/// cross. The arcs of B that an edge of A crosses are found by walking over the normal cones of
/// B's vertices, so that the cost is that of the faces there are, not of all pairs of edges. The
/// bodies overlap exactly if the result is positive; it is the depth then. Of a gap it is a lower
/// bound, and less than the distance where that runs from a vertex to a vertex or an edge.
/// No heap allocation; every loop is bounded by the number of features.
HOVERCRAFT_PUBLIC LeastOverlap leastOverlap(const ConvexPolyhedron& A, const Pose& X_WA,
                                            const ConvexPolyhedron& B, const Pose& X_WB);

}  // namespace hovercraft
