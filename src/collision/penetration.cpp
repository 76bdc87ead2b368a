#include "hovercraft_sim/collision/penetration.h"

#include <cmath>
#include <limits>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

using Data = PolyhedronData;

/// Searches the faces of the Minkowski difference. Axes of W, origin in the origin of A.
class OverlapSearch {
 public:
  OverlapSearch(const ConvexPolyhedron& A, const Pose& X_WA, const ConvexPolyhedron& B,
                const Pose& X_WB)
      : body_{&A, &B}, rotation_{&X_WA.R_AB, &X_WB.R_AB}, shift_(X_WB.p_AB - X_WA.p_AB) {}

  void faces(int side);
  void edges();
  LeastOverlap answer(const Vector3& origin) const;

 private:
  Vector3 toWorld(int side, const Vector3& p) const {
    return side == 0 ? times(*rotation_[0], p) : Vector3(times(*rotation_[1], p) + shift_);
  }
  void arc(std::int32_t edge_A);
  void edgePair(std::int32_t edge_A, std::int32_t edge_B, const Vector3& outward);
  void edgePoints(LeastOverlap& result) const;

  const ConvexPolyhedron* body_[2];
  const Matrix3* rotation_[2];
  Vector3 shift_;
  bool complete_ = true;  // no walk was cut off by its bound
  double least_ = std::numeric_limits<double>::infinity();
  Vector3 normal_{0.0, 0.0, 0.0};  // from A to B, in W
  Feature feature_[2];
};

/// Each face of one side with the support vertex of the other.
void OverlapSearch::faces(int side) {
  const int other = 1 - side;
  int support = 0;
  for (std::int32_t f = 0; f < body_[side]->faceCount(); ++f) {
    const Data::Face& face = body_[side]->face(f);
    const Vector3 outward = times(*rotation_[side], face.normal);
    const Vector3 against = transposeTimes(*rotation_[other], Vector3(-outward));
    support = body_[other]->supportVertex(against);
    const Vector3 deepest = toWorld(other, body_[other]->vertex(support));
    const double depth = side == 0 ? face.offset - dot(outward, deepest)
                                   : face.offset - dot(outward, Vector3(deepest - shift_));
    if (depth < least_) {
      least_ = depth;
      normal_ = side == 0 ? outward : Vector3(-outward);
      feature_[side] = {FeatureKind::kFace, f};
      feature_[other] = {FeatureKind::kVertex, support};
    }
  }
}

void OverlapSearch::edges() {
  for (std::int32_t e = 0; e < body_[0]->edgeCount(); ++e) arc(e);
}

/// Walks along the arc of normals of an edge of A, from its one face to the other, through the
/// normal cones of B's vertices (turned around: B's faces look against A's). Each cone that is left
/// is left through an edge of B.
void OverlapSearch::arc(std::int32_t edge_A) {
  const Data::Edge& edge = body_[0]->edge(edge_A);
  const Vector3 first = times(*rotation_[0], body_[0]->face(edge.face[0]).normal);
  const Vector3 second = times(*rotation_[0], body_[0]->face(edge.face[1]).normal);
  const Vector3 from = transposeTimes(*rotation_[1], Vector3(-first));
  const Vector3 to = transposeTimes(*rotation_[1], Vector3(-second));
  const Data& B = body_[1]->data();
  std::int32_t vertex = body_[1]->supportVertex(from);
  std::int32_t entered = -1;  // the edge of B that was crossed last
  const std::int32_t bound = body_[1]->edgeCount();
  for (std::int32_t crossings = 0; crossings < bound; ++crossings) {
    const Data::Vertex& v = B.vertices[at(vertex)];
    double nearest = std::numeric_limits<double>::infinity();
    std::int32_t chosen = -1;
    for (std::int32_t i = v.fan_begin; i < v.fan_begin + v.fan_count; ++i) {
      if (B.fan_edge[at(i)] / 2 == entered) continue;
      const Vector3& spoke = B.fan[at(i)].direction;
      const double at_end = dot(spoke, to);
      if (at_end <= 0.0) continue;
      const double at_start = std::min(0.0, dot(spoke, from));
      const double share = at_start / (at_start - at_end);
      if (share < nearest) {
        nearest = share;
        chosen = i;
      }
    }
    if (chosen < 0) return;
    const std::int32_t half = B.fan_edge[at(chosen)];
    entered = half / 2;
    edgePair(edge_A, entered, first + second);
    vertex = B.edges[at(entered)].vertex[1 - half % 2];
  }
  complete_ = false;
}

void OverlapSearch::edgePair(std::int32_t edge_A, std::int32_t edge_B, const Vector3& outward) {
  const Data::Edge& a = body_[0]->edge(edge_A);
  const Data::Edge& b = body_[1]->edge(edge_B);
  const Vector3 n = cross(times(*rotation_[0], a.direction), times(*rotation_[1], b.direction));
  const double square = dot(n, n);
  if (!(square > kParallelEdges)) return;  // then a face of one of them has the same normal
  const double size = std::sqrt(square);
  const Vector3 normal = n / (dot(n, outward) > 0.0 ? size : -size);
  const double depth = dot(normal, Vector3(toWorld(0, a.p) - toWorld(1, b.p)));
  if (depth >= least_) return;
  // Rounding may take a pair for one that crosses: the support vertices have the last word.
  const int top = body_[0]->supportVertexFrom(a.vertex[0], transposeTimes(*rotation_[0], normal));
  const int low = body_[1]->supportVertexFrom(b.vertex[0], transposeTimes(*rotation_[1], -normal));
  const double overlap =
      dot(normal, Vector3(toWorld(0, body_[0]->vertex(top)) - toWorld(1, body_[1]->vertex(low))));
  if (overlap >= least_) return;
  least_ = overlap;
  normal_ = normal;
  feature_[0] = {FeatureKind::kEdge, edge_A};
  feature_[1] = {FeatureKind::kEdge, edge_B};
}

/// The points where the lines of the two edges come closest.
void OverlapSearch::edgePoints(LeastOverlap& result) const {
  const Data::Edge& ea = body_[0]->edge(feature_[0].index);
  const Data::Edge& eb = body_[1]->edge(feature_[1].index);
  const Vector3 a = toWorld(0, ea.p);
  const Vector3 b = toWorld(1, eb.p);
  const Vector3 da = times(*rotation_[0], ea.direction);
  const Vector3 db = times(*rotation_[1], eb.direction);
  const Vector3 n = cross(da, db);
  const double s = dot(cross(Vector3(b - a), db), n) / dot(n, n);
  result.p_WCa = a + std::min(std::max(s, 0.0), ea.length) * da;
  result.p_WCb = result.p_WCa - least_ * normal_;
}

LeastOverlap OverlapSearch::answer(const Vector3& origin) const {
  LeastOverlap result;
  result.overlap = least_;
  result.nhat_AB_W = normal_;
  result.feature_a = feature_[0];
  result.feature_b = feature_[1];
  if (feature_[0].kind == FeatureKind::kEdge) {
    edgePoints(result);
  } else if (feature_[0].kind == FeatureKind::kFace) {
    result.p_WCb = toWorld(1, body_[1]->vertex(feature_[1].index));
    result.p_WCa = result.p_WCb + least_ * normal_;
  } else {
    result.p_WCa = toWorld(0, body_[0]->vertex(feature_[0].index));
    result.p_WCb = result.p_WCa - least_ * normal_;
  }
  result.p_WCa += origin;
  result.p_WCb += origin;
  return result;
}

}  // namespace

LeastOverlap leastOverlap(const ConvexPolyhedron& A, const Pose& X_WA, const ConvexPolyhedron& B,
                          const Pose& X_WB) {
  const FloatingPointEnvironment environment;
  OverlapSearch search(A, X_WA, B, X_WB);
  search.faces(0);
  search.faces(1);
  search.edges();
  return search.answer(X_WA.p_AB);
}

}  // namespace hovercraft
