// A polygon, the rays that bound its Voronoi regions, and one answer of the walk in the plane, as
// CSV for plot_collision.py.
#include <fmt/format.h>

#include "hovercraft_sim/collision/closest_polygon_features.h"

int main() {
  using namespace hovercraft;
  const ConvexPolygon A({{-1.2, -0.6}, {0.4, -0.9}, {1.3, 0.1}, {0.5, 1.0}, {-0.9, 0.7}});
  const ConvexPolygon B({{-0.5, -0.4}, {0.6, -0.3}, {0.1, 0.7}});
  const PlanarPose X_WB{0.6, 0.8, {2.4, 1.5}};
  FeaturePair last;
  const ClosestPolygonFeatures c = closestFeatures(A, PlanarPose(), B, X_WB, last);
  for (int i = 0; i < A.vertexCount(); ++i) {
    fmt::print("vertex,{},{}\n", A.vertex(i).x, A.vertex(i).y);
  }
  for (int i = 0; i < B.vertexCount(); ++i) {
    const Vector2& p = B.vertex(i);
    fmt::print("other,{},{}\n", X_WB.cosine * p.x - X_WB.sine * p.y + X_WB.p_AB.x,
               X_WB.sine * p.x + X_WB.cosine * p.y + X_WB.p_AB.y);
  }
  for (int i = 0; i < A.vertexCount(); ++i) {
    for (const VoronoiPlane& plane : A.voronoiPlanes({FeatureKind::kVertex, i})) {
      fmt::print("plane,{},{},{},{}\n", i, plane.normal.x(), plane.normal.y(), plane.offset);
    }
  }
  fmt::print("witness,{},{},{},{}\n", c.p_WCa.x, c.p_WCa.y, c.p_WCb.x, c.p_WCb.y);
  return 0;
}
