#include "hovercraft_sim/collision/feature_walk.h"

#include "hovercraft_sim/geometry/support_map.h"
#include "hovercraft_sim/math/double_double.h"

namespace hovercraft {
namespace {

PreciseVector preciseWorld(const Matrix3& R, const PreciseVector& shift, const Vector3& p) {
  return times(R, PreciseVector(p)) + shift;
}

}  // namespace

void FeatureWalk::startAlong(const Vector3& direction) {
  const Vector3 along_A = transposeTimes(*rotation_[0], direction);
  const Vector3 along_B = transposeTimes(*rotation_[1], Vector3(-direction));
  setFeature(0, FeatureKind::kVertex, supportSeed(*body_[0], along_A));
  setFeature(1, FeatureKind::kVertex, supportSeed(*body_[1], along_B));
  const auto bound =
      static_cast<std::int32_t>(body_[0]->vertices.size() + body_[1]->vertices.size());
  for (std::int32_t i = 0; i < bound; ++i) {
    const bool moved_A = moveVertex(0);
    const bool moved_B = moveVertex(1);
    if (!moved_A && !moved_B) break;
    ++climbs_;
  }
}

/// To the neighbour that is closest to the other side's vertex, if that is closer. The squared
/// distance changes by (length - 2 slope) length.
bool FeatureWalk::moveVertex(int side) {
  const Data& body = *body_[side];
  const Vector3 other = toWorld(1 - side, vertex(1 - side).p);
  const Vector3 u = toBody(side, other) - vertex(side).p;
  const Data::Vertex& here = vertex(side);
  double best = 0.0;
  std::int32_t chosen = -1;
  for (std::int32_t i = here.fan_begin; i < here.fan_begin + here.fan_count; ++i) {
    const Data::Spoke& spoke = body.fan[at(i)];
    const double gain = (2.0 * dot(spoke.direction, u) - spoke.length) * spoke.length;
    if (gain > best) {
      best = gain;
      chosen = i;
    }
  }
  if (chosen < 0) return false;
  setFeature(side, FeatureKind::kVertex, body.fan_vertex[at(chosen)]);
  return true;
}

namespace {

/// Brent's search for a cycle: the walk is back where it was at a mark, which moves on at each step
/// whose number is a power of two.
class CycleSearch {
 public:
  explicit CycleSearch(const std::array<Feature, 2>& start) : mark_(start) {}

  bool isBack(const std::array<Feature, 2>& features) const { return features == mark_; }

  void goOn(const std::array<Feature, 2>& features) {
    if (++step_ < next_) return;
    mark_ = features;
    next_ *= 2;
  }

 private:
  std::array<Feature, 2> mark_;
  std::int32_t step_ = 0;
  std::int32_t next_ = 2;
};

}  // namespace

FeatureWalk::End FeatureWalk::run(std::int32_t patience) {
  const auto most =
      static_cast<std::int32_t>(64 + 4 * (body_[0]->edges.size() + body_[1]->edges.size()));
  const bool is_patient = patience == 0 || patience >= most;
  const std::int32_t bound = is_patient ? most : patience;
  CycleSearch search(feature_);
  for (std::int32_t i = 1; i <= bound; ++i) {
    ++steps_;
    const Outcome outcome = step();
    if (outcome == Outcome::kClosest) return End::kClosest;
    if (outcome == Outcome::kOverlap) return End::kOverlap;
    const bool cycle = outcome == Outcome::kMoved && search.isBack(feature_);
    if (cycle && precise_) return End::kStepLimit;
    if (cycle || outcome == Outcome::kUncertain) precise_ = true;
    search.goOn(feature_);
  }
  return is_patient ? End::kStepLimit : End::kImpatient;
}

FeatureWalk::Outcome FeatureWalk::step() {
  const FeatureKind a = feature_[0].kind;
  const FeatureKind b = feature_[1].kind;
  if (a == FeatureKind::kVertex) {
    if (b == FeatureKind::kVertex) return vertexVertex();
    return b == FeatureKind::kEdge ? vertexEdge(0) : vertexFace(0);
  }
  if (a == FeatureKind::kEdge) {
    if (b == FeatureKind::kVertex) return vertexEdge(1);
    return b == FeatureKind::kEdge ? edgeEdge() : edgeFace(0);
  }
  if (b == FeatureKind::kVertex) return vertexFace(1);
  if (b == FeatureKind::kEdge) return edgeFace(1);
  setFeature(1, FeatureKind::kEdge, body_[1]->ring_edge[at(face(1).ring_begin)]);
  return Outcome::kMoved;  // two faces are never the closest pair alone: any side of one will do
}

FeatureWalk::Outcome FeatureWalk::vertexVertex() {
  const Vector3 a = toWorld(0, vertex(0).p);
  const Vector3 b = toWorld(1, vertex(1).p);
  const Vector3 u = precise_ ? preciseDifference() : Vector3(b - a);
  const double length = norm(u);
  if (length <= kTouchingDistance * scale_) return Outcome::kOverlap;
  const Slope slope_A = steepest(0, transposeTimes(*rotation_[0], u));
  const Verdict verdict_A = judge(slope_A.value, length);
  if (verdict_A == Verdict::kOutside) {
    moveAlong(0, slope_A);
    return Outcome::kMoved;
  }
  const Slope slope_B = steepest(1, transposeTimes(*rotation_[1], Vector3(-u)));
  const Verdict verdict_B = judge(slope_B.value, length);
  if (verdict_B == Verdict::kOutside) {
    moveAlong(1, slope_B);
    return Outcome::kMoved;
  }
  if (verdict_A == Verdict::kUncertain || verdict_B == Verdict::kUncertain) {
    return Outcome::kUncertain;
  }
  setAnswer(0, a, b, u / length, length);
  excess_ = std::max(slope_A.value, slope_B.value) / length;
  return Outcome::kClosest;
}

/// Vertex on side x, edge on the other.
FeatureWalk::Outcome FeatureWalk::vertexEdge(int x) {
  const int y = 1 - x;
  const Data::Edge& e = edge(y);
  const Vector3 v = toWorld(x, vertex(x).p);
  const Vector3 w = toBody(y, v) - e.p;
  const double t = dot(w, e.direction);
  if (t <= -margin() || t >= e.length + margin()) {
    setFeature(y, FeatureKind::kVertex, e.vertex[t <= 0.0 ? 0 : 1]);
    return Outcome::kMoved;
  }
  const Vector3 away = precise_ ? transposeTimes(*rotation_[y], preciseVertexEdge(x))
                                : Vector3(w - t * e.direction);  // from the edge to the vertex
  const double length = norm(away);
  if (length <= kTouchingDistance * scale_) return Outcome::kOverlap;
  const double slope_0 = dot(away, e.inward[0]);
  const double slope_1 = dot(away, e.inward[1]);
  const double slope_Y = std::max(slope_0, slope_1);
  const Verdict verdict_Y = judge(slope_Y, length);
  if (verdict_Y == Verdict::kOutside) {
    setFeature(y, FeatureKind::kFace, e.face[slope_0 > slope_1 ? 0 : 1]);
    return Outcome::kMoved;
  }
  const Vector3 u = times(*rotation_[y], Vector3(-away));  // from the vertex to the edge, in W
  const Slope slope_X = steepest(x, transposeTimes(*rotation_[x], u));
  const Verdict verdict_X = judge(slope_X.value, length);
  if (verdict_X == Verdict::kOutside) {
    moveAlong(x, slope_X);
    return Outcome::kMoved;
  }
  if (verdict_X == Verdict::kUncertain || verdict_Y == Verdict::kUncertain) {
    return Outcome::kUncertain;
  }
  setAnswer(x, v, v + u, u / length, length);
  excess_ = std::max(slope_X.value, slope_Y) / length;
  return Outcome::kClosest;
}

FeatureWalk::Outcome FeatureWalk::edgeEdge() {
  Crossing crossing{toWorld(0, edge(0).p),
                    toWorld(1, edge(1).p),
                    times(*rotation_[0], edge(0).direction),
                    times(*rotation_[1], edge(1).direction),
                    {0.0, 0.0, 0.0},
                    {0.0, 0.0, 0.0}};
  crossing.w = crossing.b - crossing.a;
  crossing.n = cross(crossing.da, crossing.db);
  const double nn = dot(crossing.n, crossing.n);
  edge_sine_ = 0.0;
  const EdgePoints points = precise_ ? preciseEdges() : edgePoints(crossing, nn);
  if (leaveEnds(points)) return Outcome::kMoved;
  point_[0] = crossing.a + points.s * crossing.da;
  point_[1] = crossing.b + points.t * crossing.db;
  if (nn >= kCrossingEdges && !precise_) {
    const double sine = std::sqrt(nn);
    edge_sine_ = sine;
    const double height = dot(crossing.w, crossing.n) / sine;
    if (std::abs(height) <= kTouchingDistance * scale_) return Outcome::kOverlap;
    const double signed_sine = height > 0.0 ? sine : -sine;
    return edgesMeet(crossing.n / signed_sine, std::abs(height), kPointRounding / sine);
  }
  const double length = norm(points.u);
  if (length <= kTouchingDistance * scale_) return Outcome::kOverlap;
  return edgesMeet(points.u / length, length, precise_ ? 0.0 : rounding_ / length);
}

/// The closest points of two segments: of their lines where these lie inside, else of an end.
FeatureWalk::EdgePoints FeatureWalk::edgePoints(const Crossing& c, double nn) const {
  const double length_A = edge(0).length;
  const double length_B = edge(1).length;
  double s = 0.0;
  if (nn > kParallelEdges) s = dot(cross(c.w, c.db), c.n) / nn;
  s = std::min(std::max(s, 0.0), length_A);
  double t = dot(Vector3(s * c.da - c.w), c.db);
  const bool end_B = t <= 0.0 || t >= length_B;
  if (end_B) {
    t = std::min(std::max(t, 0.0), length_B);
    s = dot(Vector3(c.w + t * c.db), c.da);
  }
  return {s, t, s <= 0.0 || s >= length_A, end_B, c.w + t * c.db - s * c.da};
}

/// An edge whose closest point is an end gives way to that vertex.
bool FeatureWalk::leaveEnds(const EdgePoints& points) {
  const Data::Edge& ea = edge(0);
  const Data::Edge& eb = edge(1);
  if (points.end_A) setFeature(0, FeatureKind::kVertex, ea.vertex[points.s <= 0.0 ? 0 : 1]);
  if (points.end_B) setFeature(1, FeatureKind::kVertex, eb.vertex[points.t <= 0.0 ? 0 : 1]);
  return points.end_A || points.end_B;
}

/// Two edges with the unit normal from A to B between their lines, known to within `error` (-); 0
/// for some roundings of a unit vector.
FeatureWalk::Outcome FeatureWalk::edgesMeet(const Vector3& normal, double length, double error) {
  excess_ = -1.0;
  bool uncertain = false;
  for (int side = 0; side < 2; ++side) {
    const Data::Edge& e = edge(side);
    const Vector3 out = transposeTimes(*rotation_[side], side == 0 ? normal : Vector3(-normal));
    const double slope_0 = dot(out, e.inward[0]);
    const double slope_1 = dot(out, e.inward[1]);
    const double slope = std::max(slope_0, slope_1);
    if (slope > kVoronoiSlack && slope > error) {
      setFeature(side, FeatureKind::kFace, e.face[slope_0 > slope_1 ? 0 : 1]);
      return Outcome::kMoved;
    }
    uncertain = uncertain || (error > kVoronoiSlack && slope > -error);
    excess_ = std::max(excess_, slope);
  }
  if (uncertain) return Outcome::kUncertain;
  normal_ = normal;
  distance_ = length;
  return Outcome::kClosest;
}

/// From the vertex of A to that of B in W, right to the last bit but one.
Vector3 FeatureWalk::preciseDifference() const {
  const PreciseVector a = preciseWorld(*rotation_[0], PreciseVector(), vertex(0).p);
  return (preciseWorld(*rotation_[1], PreciseVector(shift_), vertex(1).p) - a).rounded();
}

/// The closest points of the two edges, right to the last bit but one.
FeatureWalk::EdgePoints FeatureWalk::preciseEdges() const {
  const auto end = [&](int side, int i) {
    const Data::Vertex& v = body_[side]->vertices[at(edge(side).vertex[i])];
    return preciseWorld(*rotation_[side], side == 0 ? PreciseVector() : PreciseVector(shift_), v.p);
  };
  // Up to the margin past an end counts as on the edge.
  const double over_A = margin() / edge(0).length;
  const double over_B = margin() / edge(1).length;
  const auto clamp = [](const DoubleDouble& x, double over) {
    if (!(x.high > -over)) return DoubleDouble(-over);
    return x.high >= 1.0 + over ? DoubleDouble(1.0 + over) : x;
  };
  const auto clamped = [](const DoubleDouble& x, double over) {
    return x.high == -over || x.high == 1.0 + over;
  };
  const PreciseVector a = end(0, 0);
  const PreciseVector b = end(1, 0);
  const PreciseVector da = end(0, 1) - a;
  const PreciseVector db = end(1, 1) - b;
  const PreciseVector w = b - a;
  const PreciseVector n = cross(da, db);
  const DoubleDouble nn = dot(n, n);
  const DoubleDouble aa = dot(da, da);
  const DoubleDouble bb = dot(db, db);
  DoubleDouble share_A;
  if (nn.high > kPreciseParallelEdges * (aa.high * bb.high)) {
    share_A = clamp(dot(cross(w, db), n) / nn, over_A);
  }
  const DoubleDouble share_B = clamp(dot(share_A * da - w, db) / bb, over_B);
  if (clamped(share_B, over_B)) share_A = clamp(dot(w + share_B * db, da) / aa, over_A);
  return {share_A.high * edge(0).length, share_B.high * edge(1).length, clamped(share_A, over_A),
          clamped(share_B, over_B), (w + share_B * db - share_A * da).rounded()};
}

/// From the edge to the vertex on side x, in W.
Vector3 FeatureWalk::preciseVertexEdge(int x) const {
  const int y = 1 - x;
  const PreciseVector zero;
  const PreciseVector shift(shift_);
  const auto place = [&](int side, std::int32_t index) {
    return preciseWorld(*rotation_[side], side == 0 ? zero : shift,
                        body_[side]->vertices[at(index)].p);
  };
  const PreciseVector start = place(y, edge(y).vertex[0]);
  const PreciseVector along = place(y, edge(y).vertex[1]) - start;
  const PreciseVector w = place(x, feature_[at(x)].index) - start;
  return (w - (dot(w, along) / dot(along, along)) * along).rounded();
}

}  // namespace hovercraft
