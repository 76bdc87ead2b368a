// Closest features of two convex bodies: witness points, normal, features. The pair that is kept
// makes the next query cheap.
#include <cstdio>

#include <hovercraft_sim/collision/closest_features.h>
#include <hovercraft_sim/geometry/polyhedron_shapes.h>

using namespace hovercraft;

int main() {
  const ConvexPolyhedron box = boxPolyhedron(Vector3(0.6, 0.4, 0.12));
  const ConvexPolyhedron post = cylinderPolyhedron(0.1, 1.0, 64);
  const Pose X_WBox;
  Pose X_WPost;
  FeaturePair last;
  for (int k = 0; k < 3; ++k) {
    X_WPost.p_AB = Vector3(1.0 - 0.25 * k, 0.05, 0.0);
    const ClosestFeatures c = closestFeatures(box, X_WBox, post, X_WPost, last);
    std::printf(
        "distance %.4f m, normal (%.3f, %.3f, %.3f), on the box (%.3f, %.3f, %.3f), %d pairs of "
        "features looked at\n",
        c.distance, c.nhat_AB_W.x(), c.nhat_AB_W.y(), c.nhat_AB_W.z(), c.p_WCa.x(), c.p_WCa.y(),
        c.p_WCa.z(), c.steps);
  }
}
