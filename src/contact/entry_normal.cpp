#include "hovercraft_sim/contact/entry_normal.h"

#include <algorithm>
#include <limits>

#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/index.h"

namespace hovercraft {
namespace {

/// A few of the faces or edges around a feature.
template <typename Thing>
struct Around {
  std::array<Thing, kMostSidesAround> list;
  int count = 0;

  void add(const Thing& thing) {
    if (count < kMostSidesAround) list[at(count++)] = thing;
  }
  const Thing* begin() const { return list.data(); }
  const Thing* end() const { return list.data() + count; }
};

/// Outward normals, in W, of the faces around a feature.
Around<Vector3> normalsAround(const MovingHull& side, Feature feature) {
  const PolyhedronData& data = side.hull.data();
  Around<Vector3> normals;
  const auto add = [&](std::int32_t face) {
    normals.add(times(side.X_WB.R_AB, data.faces[at(face)].normal));
  };
  if (feature.kind == FeatureKind::kFace) {
    add(feature.index);
  } else if (feature.kind == FeatureKind::kEdge) {
    for (const std::int32_t face : data.edges[at(feature.index)].face) add(face);
  } else {
    const PolyhedronData::Vertex& vertex = data.vertices[at(feature.index)];
    for (std::int32_t k = 0; k < vertex.fan_count; ++k) {
      const std::int32_t spoke = data.fan_edge[at(vertex.fan_begin + k)];
      add(data.edges[at(spoke / 2)].face[spoke % 2]);
    }
  }
  return normals;
}

/// Directions, in W, of the edges of a vertex, or of an edge; none of a face.
Around<Vector3> edgesAround(const MovingHull& side, Feature feature) {
  const PolyhedronData& data = side.hull.data();
  Around<Vector3> edges;
  if (feature.kind == FeatureKind::kEdge) {
    edges.add(times(side.X_WB.R_AB, data.edges[at(feature.index)].direction));
  } else if (feature.kind == FeatureKind::kVertex) {
    const PolyhedronData::Vertex& vertex = data.vertices[at(feature.index)];
    for (std::int32_t k = 0; k < vertex.fan_count; ++k) {
      edges.add(times(side.X_WB.R_AB, data.fan[at(vertex.fan_begin + k)].direction));
    }
  }
  return edges;
}

int vertexOf(const ConvexPolyhedron& hull, Feature feature) {
  if (feature.kind == FeatureKind::kVertex) return feature.index;
  if (feature.kind == FeatureKind::kEdge) return hull.edge(feature.index).vertex[0];
  const PolyhedronData& data = hull.data();
  const std::int32_t edge = data.ring_edge[at(data.faces[at(feature.index)].ring_begin)];
  return data.edges[at(edge)].vertex[0];
}

/// The direction that parts two bodies for longest.
class EntrySearch {
 public:
  EntrySearch(const MovingHull& A, const MovingHull& B, const ClosestFeatures& closest,
              const ContactManifold& manifold)
      : a_(A),
        b_(B),
        manifold_(manifold),
        start_A_(vertexOf(A.hull, closest.feature_a)),
        start_B_(vertexOf(B.hull, closest.feature_b)),
        normal(closest.nhat_AB_W),
        gap(closest.distance),
        time_(timeAlong(normal, gap)) {}

  /// @param m unit, in W, from A to B.
  void look(const Vector3& m) {
    const double along = gapAlong(m);
    if (!(along > 0.0)) return;
    const double time = timeAlong(m, along);
    if (!(time > time_)) return;
    normal = m;
    gap = along;
    time_ = time;
  }

 private:
  double gapAlong(const Vector3& m) const {
    const int a = a_.hull.supportVertexFrom(start_A_, transposeTimes(a_.X_WB.R_AB, m));
    const int b = b_.hull.supportVertexFrom(start_B_, transposeTimes(b_.X_WB.R_AB, -m));
    return dot(
        m, Vector3(transform(b_.X_WB, b_.hull.vertex(b)) - transform(a_.X_WB, a_.hull.vertex(a))));
  }

  /// s; infinite where no point of the contact closes.
  double timeAlong(const Vector3& m, double along) const {
    double closing = 0.0;
    for (int i = 0; i < manifold_.count; ++i) {
      const Vector3& p_WC = manifold_.points[at(i)].p_WC;
      const Vector3 v = velocityOfPoint(b_.twist, p_WC, b_.X_WB.p_AB) -
                        velocityOfPoint(a_.twist, p_WC, a_.X_WB.p_AB);
      closing = std::max(closing, -dot(m, v));
    }
    return closing > 0.0 ? along / closing : std::numeric_limits<double>::infinity();
  }

  const MovingHull& a_;
  const MovingHull& b_;
  const ContactManifold& manifold_;
  int start_A_;
  int start_B_;

 public:
  Vector3 normal;
  double gap;  // m

 private:
  double time_;  // s
};

}  // namespace

void turnToEntry(const MovingHull& A, const MovingHull& B, const ClosestFeatures& closest,
                 ContactManifold& manifold) {
  const FloatingPointEnvironment environment;
  if (manifold.of_face || !(closest.distance > 0.0)) return;
  EntrySearch search(A, B, closest, manifold);
  for (const Vector3& normal : normalsAround(A, closest.feature_a)) search.look(normal);
  for (const Vector3& normal : normalsAround(B, closest.feature_b)) search.look(-normal);
  for (const Vector3& along : edgesAround(A, closest.feature_a)) {
    for (const Vector3& other : edgesAround(B, closest.feature_b)) {
      const Vector3 across = cross(along, other);
      const double sine = norm(across);
      if (!(sine > kFaceAlignment)) continue;
      const double side = dot(across, closest.nhat_AB_W) < 0.0 ? -1.0 / sine : 1.0 / sine;
      search.look(side * across);
    }
  }
  manifold.nhat_AB_W = search.normal;
  for (int i = 0; i < manifold.count; ++i) manifold.points[at(i)].gap = search.gap;
}

}  // namespace hovercraft
