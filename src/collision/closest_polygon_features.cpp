#include "hovercraft_sim/collision/closest_polygon_features.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

Vector2 rotated(const PlanarPose& X, const Vector2& v) {
  return {X.cosine * v.x - X.sine * v.y, X.sine * v.x + X.cosine * v.y};
}

Vector2 rotatedBack(const PlanarPose& X, const Vector2& v) {
  return {X.cosine * v.x + X.sine * v.y, X.cosine * v.y - X.sine * v.x};
}

double length(const Vector2& v) {
  return std::sqrt(dot(v, v));
}

Vector2 outward(const ConvexPolygon::Edge& edge) {
  return {edge.direction.y, -edge.direction.x};
}

/// The walk over pairs of vertices and edges; axes of W, origin in the origin of A.
class PolygonWalk {
 public:
  enum class Outcome { kMoved, kClosest, kOverlap };

  PolygonWalk(const ConvexPolygon& A, const PlanarPose& X_WA, const ConvexPolygon& B,
              const PlanarPose& X_WB)
      : body_{&A, &B},
        pose_{X_WA, X_WB},
        touching_(kTouchingDistance * (A.radius() + B.radius() + length(X_WB.p_AB - X_WA.p_AB))) {
    pose_[1].p_AB = X_WB.p_AB - X_WA.p_AB;
    pose_[0].p_AB = {0.0, 0.0};
  }

  bool run(const FeaturePair& start);
  void leastOverlap();
  void closestOfAllPairs();
  const ClosestPolygonFeatures& result() const { return result_; }
  double touching() const { return touching_; }

 private:
  Outcome vertexVertex();
  Outcome vertexEdge(int x);
  Outcome edgeEdge();
  bool leaveVertex(int side, const Vector2& u, double distance);
  double slopeAt(int side, const Vector2& u) const;
  void take(int x, Feature here, Feature there, const Vector2& from, const Vector2& unit,
            double distance);
  void takeVertexEdge(int x, int i, int k);
  Vector2 toWorld(int side, const Vector2& p) const {
    return rotated(pose_[side], p) + pose_[side].p_AB;
  }
  const ConvexPolygon::Edge& edge(int side) const {
    return body_[side]->edge(feature_[side].index);
  }
  int deepestVertex(int side, const Vector2& n) const;
  void overlapAlongEdges(int side);

  const ConvexPolygon* body_[2];
  PlanarPose pose_[2];
  double touching_;
  Feature feature_[2];
  ClosestPolygonFeatures result_;
};

/// Goes to the edge that the direction u (in W, away from the vertex) climbs most, if it does.
bool PolygonWalk::leaveVertex(int side, const Vector2& u, double distance) {
  const ConvexPolygon& body = *body_[side];
  const int v = feature_[side].index;
  const Vector2 local = rotatedBack(pose_[side], u);
  const double forward = dot(local, body.edge(v).direction);
  const double backward = -dot(local, body.edge(body.previous(v)).direction);
  const double slope = std::max(forward, backward) / distance;
  if (slope > kVoronoiSlack) {
    feature_[side] = {FeatureKind::kEdge, forward > backward ? v : body.previous(v)};
    return true;
  }
  result_.excess = std::max(result_.excess, slope);
  return false;
}

PolygonWalk::Outcome PolygonWalk::vertexVertex() {
  result_.p_WCa = toWorld(0, body_[0]->vertex(feature_[0].index));
  result_.p_WCb = toWorld(1, body_[1]->vertex(feature_[1].index));
  const Vector2 u = result_.p_WCb - result_.p_WCa;
  result_.distance = length(u);
  if (result_.distance <= touching_) return Outcome::kOverlap;
  result_.nhat_AB_W = (1.0 / result_.distance) * u;
  if (leaveVertex(0, u, result_.distance)) return Outcome::kMoved;
  return leaveVertex(1, -1.0 * u, result_.distance) ? Outcome::kMoved : Outcome::kClosest;
}

/// Vertex on side x, edge on the other.
PolygonWalk::Outcome PolygonWalk::vertexEdge(int x) {
  const int y = 1 - x;
  const ConvexPolygon::Edge& e = edge(y);
  const Vector2 v = toWorld(x, body_[x]->vertex(feature_[x].index));
  const Vector2 w = rotatedBack(pose_[y], v - pose_[y].p_AB) - e.p;
  const double t = dot(w, e.direction);
  if (t <= 0.0 || t >= e.length) {
    const int i = feature_[y].index;
    feature_[y] = {FeatureKind::kVertex, t <= 0.0 ? i : body_[y]->next(i)};
    return Outcome::kMoved;
  }
  const double height = dot(outward(e), w);
  if (height <= touching_) return Outcome::kOverlap;
  const Vector2 to_edge = rotated(pose_[y], -1.0 * outward(e));  // unit
  if (leaveVertex(x, to_edge, 1.0)) return Outcome::kMoved;
  const Vector2 foot = v + height * to_edge;
  result_.distance = height;
  result_.p_WCa = x == 0 ? v : foot;
  result_.p_WCb = x == 0 ? foot : v;
  result_.nhat_AB_W = x == 0 ? to_edge : -1.0 * to_edge;
  return Outcome::kClosest;
}

/// Two edges never are the closest pair alone: of the four ends the closest one counts.
PolygonWalk::Outcome PolygonWalk::edgeEdge() {
  double best = std::numeric_limits<double>::infinity();
  const Feature from[2] = {feature_[0], feature_[1]};
  for (int x = 0; x < 2; ++x) {
    const int y = 1 - x;
    const ConvexPolygon::Edge& e = body_[y]->edge(from[y].index);
    for (const int i : {from[x].index, body_[x]->next(from[x].index)}) {
      const Vector2 v = toWorld(x, body_[x]->vertex(i));
      const Vector2 w = rotatedBack(pose_[y], v - pose_[y].p_AB) - e.p;
      const double t = std::min(std::max(dot(w, e.direction), 0.0), e.length);
      const double distance = length(w - t * e.direction);
      if (distance < best) {
        best = distance;
        feature_[x] = {FeatureKind::kVertex, i};
        feature_[y] = from[y];
      }
    }
  }
  return Outcome::kMoved;
}

/// @returns true if the pair is certified, false if the polygons seem to overlap.
bool PolygonWalk::run(const FeaturePair& start) {
  feature_[0] = start.a;
  feature_[1] = start.b;
  const int bound = 64 + 4 * (body_[0]->vertexCount() + body_[1]->vertexCount());
  for (int i = 0; i < bound; ++i) {
    ++result_.steps;
    result_.excess = -1.0;
    const bool vertex_A = feature_[0].kind == FeatureKind::kVertex;
    const bool vertex_B = feature_[1].kind == FeatureKind::kVertex;
    Outcome outcome;
    if (vertex_A) {
      outcome = vertex_B ? vertexVertex() : vertexEdge(0);
    } else {
      outcome = vertex_B ? vertexEdge(1) : edgeEdge();
    }
    if (outcome == Outcome::kMoved) continue;
    if (outcome == Outcome::kOverlap) return false;
    result_.status = Proximity::kSeparated;
    result_.feature_a = feature_[0];
    result_.feature_b = feature_[1];
    return true;
  }
  return false;
}

/// The vertex of a side that lies deepest against n.
int PolygonWalk::deepestVertex(int side, const Vector2& n) const {
  const ConvexPolygon& body = *body_[side];
  const Vector2 local = rotatedBack(pose_[side], n);
  int deepest = 0;
  for (int k = 1; k < body.vertexCount(); ++k) {
    if (dot(local, body.vertex(k)) < dot(local, body.vertex(deepest))) deepest = k;
  }
  return deepest;
}

void PolygonWalk::overlapAlongEdges(int side) {
  const int other = 1 - side;
  for (int i = 0; i < body_[side]->vertexCount(); ++i) {
    const ConvexPolygon::Edge& e = body_[side]->edge(i);
    const Vector2 n = rotated(pose_[side], outward(e));
    const int deepest = deepestVertex(other, n);
    const Vector2 v = toWorld(other, body_[other]->vertex(deepest));
    const double overlap = dot(n, toWorld(side, e.p) - v);
    if (-overlap <= result_.distance) continue;
    const Vector2 foot = v + overlap * n;
    const Feature edge_feature{FeatureKind::kEdge, i};
    const Feature vertex_feature{FeatureKind::kVertex, deepest};
    const bool edge_of_A = side == 0;
    result_.distance = -overlap;
    result_.nhat_AB_W = edge_of_A ? n : -1.0 * n;
    result_.p_WCa = edge_of_A ? foot : v;
    result_.p_WCb = edge_of_A ? v : foot;
    result_.feature_a = edge_of_A ? edge_feature : vertex_feature;
    result_.feature_b = edge_of_A ? vertex_feature : edge_feature;
  }
}

void PolygonWalk::leastOverlap() {
  result_.distance = -std::numeric_limits<double>::infinity();
  overlapAlongEdges(0);
  overlapAlongEdges(1);
}

/// The larger slope of the two edges of a vertex in the direction u (unit, in W).
double PolygonWalk::slopeAt(int side, const Vector2& u) const {
  if (feature_[side].kind != FeatureKind::kVertex) return -1.0;
  const ConvexPolygon& body = *body_[side];
  const int v = feature_[side].index;
  const Vector2 local = rotatedBack(pose_[side], u);
  return std::max(dot(local, body.edge(v).direction),
                  -dot(local, body.edge(body.previous(v)).direction));
}

/// Takes the pair whose points are `from` on side x and the one `distance` along `unit` on the
/// other, if it is the closest so far.
void PolygonWalk::take(int x, Feature here, Feature there, const Vector2& from, const Vector2& unit,
                       double distance) {
  if (distance >= result_.distance) return;
  const Vector2 to = from + distance * unit;
  feature_[x] = here;
  feature_[1 - x] = there;
  result_.distance = distance;
  result_.p_WCa = x == 0 ? from : to;
  result_.p_WCb = x == 0 ? to : from;
  result_.nhat_AB_W = x == 0 ? unit : -1.0 * unit;
}

/// Vertex i of side x and edge k of the other, where it is over that.
void PolygonWalk::takeVertexEdge(int x, int i, int k) {
  const int y = 1 - x;
  const ConvexPolygon::Edge& e = body_[y]->edge(k);
  const Vector2 v = toWorld(x, body_[x]->vertex(i));
  const Vector2 w = rotatedBack(pose_[y], v - pose_[y].p_AB) - e.p;
  const double t = dot(w, e.direction);
  const double height = dot(outward(e), w);
  if (t <= 0.0 || t >= e.length || height <= 0.0) return;
  take(x, {FeatureKind::kVertex, i}, {FeatureKind::kEdge, k}, v,
       rotated(pose_[y], -1.0 * outward(e)), height);
}

/// Every pair of disjoint polygons: where rounding lets the walk go round in a circle.
void PolygonWalk::closestOfAllPairs() {
  result_.distance = std::numeric_limits<double>::infinity();
  for (int i = 0; i < body_[0]->vertexCount(); ++i) {
    for (int k = 0; k < body_[1]->vertexCount(); ++k) {
      const Vector2 a = toWorld(0, body_[0]->vertex(i));
      const Vector2 u = toWorld(1, body_[1]->vertex(k)) - a;
      const double distance = length(u);
      take(0, {FeatureKind::kVertex, i}, {FeatureKind::kVertex, k}, a, (1.0 / distance) * u,
           distance);
      takeVertexEdge(0, i, k);
      takeVertexEdge(1, k, i);
    }
  }
  result_.status = Proximity::kSeparated;
  result_.excess = std::max(slopeAt(0, result_.nhat_AB_W), slopeAt(1, -1.0 * result_.nhat_AB_W));
  result_.feature_a = feature_[0];
  result_.feature_b = feature_[1];
}

}  // namespace

ClosestPolygonFeatures closestFeatures(const ConvexPolygon& A, const PlanarPose& X_WA,
                                       const ConvexPolygon& B, const PlanarPose& X_WB,
                                       FeaturePair& last) {
  const FloatingPointEnvironment environment;
  PolygonWalk walk(A, X_WA, B, X_WB);
  if (!walk.run(last.known ? last : FeaturePair{})) {
    walk.leastOverlap();
    ClosestPolygonFeatures result = walk.result();
    result.status = Proximity::kPenetrating;
    if (std::abs(result.distance) <= 10.0 * walk.touching()) result.status = Proximity::kTouching;
    if (result.distance > 10.0 * walk.touching()) {
      // An edge parts them after all: the walk goes on from it.
      FeaturePair again;
      again.a = result.feature_a;
      again.b = result.feature_b;
      if (!walk.run(again)) walk.closestOfAllPairs();
      result = walk.result();
    }
    result.p_WCa = result.p_WCa + X_WA.p_AB;
    result.p_WCb = result.p_WCb + X_WA.p_AB;
    last = {true, result.feature_a, result.feature_b, {}};
    return result;
  }
  ClosestPolygonFeatures result = walk.result();
  result.p_WCa = result.p_WCa + X_WA.p_AB;
  result.p_WCb = result.p_WCb + X_WA.p_AB;
  last = {true, result.feature_a, result.feature_b, {}};
  return result;
}

}  // namespace hovercraft
