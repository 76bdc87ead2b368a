#include "hovercraft_sim/contact/manifold.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/index.h"

namespace hovercraft {
namespace {

/// Most corners that a clipped face is followed with: each side of the other face adds one at most.
constexpr int kMaxCorners = 64;

struct PlacedFace {
  const ConvexPolyhedron& body;
  const Pose& X_WB;
  int face;
};

struct Corners {
  std::array<Vector3, kMaxCorners> points;
  int count = 0;

  /// If there is no room, the corner goes without which the least area is lost.
  void add(const Vector3& p) {
    if (count == kMaxCorners) dropFlattest();
    points[at(count++)] = p;
  }
  const Vector3& operator[](int i) const { return points[at(i)]; }

 private:
  void dropFlattest() {
    int flattest = 1;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 1; i + 1 < count; ++i) {
      const Vector3 area = cross((*this)[i] - (*this)[i - 1], (*this)[i + 1] - (*this)[i]);
      if (squaredNorm(area) >= least) continue;
      least = squaredNorm(area);
      flattest = i;
    }
    std::copy(points.begin() + flattest + 1, points.begin() + count, points.begin() + flattest);
    --count;
  }
};

/// The face of a body that looks most along a direction of W: uphill on the faces of the support
/// vertex would do for a smooth answer; the faces around the supporting feature hold it.
int faceAlong(const ConvexPolyhedron& body, const Pose& X_WB, const Vector3& direction_W,
              double& alignment) {
  const Vector3 direction = transposeTimes(X_WB.R_AB, direction_W);
  const PolyhedronData& data = body.data();
  const PolyhedronData::Vertex& vertex = data.vertices[at(body.supportVertex(direction))];
  int best = -1;
  for (std::int32_t k = 0; k < vertex.fan_count; ++k) {
    const std::int32_t spoke = data.fan_edge[at(vertex.fan_begin + k)];
    const std::int32_t face = data.edges[at(spoke / 2)].face[spoke % 2];
    const double along = dot(data.faces[at(face)].normal, direction);
    if (best < 0 || along > alignment || (along == alignment && face < best)) {
      best = face;
      alignment = along;
    }
  }
  return best;
}

/// The corners of a face in W.
void addCorners(const PlacedFace& placed, Corners& corners) {
  const PolyhedronData& data = placed.body.data();
  const PolyhedronData::Face& f = data.faces[at(placed.face)];
  for (std::int32_t k = 0; k < f.ring_count; ++k) {
    const PolyhedronData::Edge& edge = data.edges[at(data.ring_edge[at(f.ring_begin + k)])];
    const int first = edge.face[0] == placed.face ? 0 : 1;
    corners.add(transform(placed.X_WB, data.vertices[at(edge.vertex[first])].p));
  }
}

/// Cuts off what of a polygon is on the outer side of a plane. @param kept written if there is
/// some.
/// @returns whether there is.
bool clip(const Corners& polygon, const Vector3& inward, double offset, Corners& kept) {
  std::array<double, kMaxCorners> inside;  // m
  bool holds_all = true;
  for (int i = 0; i < polygon.count; ++i) {
    inside[at(i)] = dot(inward, polygon[i]) - offset;
    holds_all = holds_all && inside[at(i)] >= 0.0;
  }
  if (holds_all) return false;
  kept.count = 0;
  for (int i = 0; i < polygon.count; ++i) {
    const int next = i + 1 < polygon.count ? i + 1 : 0;
    const Vector3& p = polygon[i];
    const double p_in = inside[at(i)];
    const double q_in = inside[at(next)];
    if (p_in >= 0.0) kept.add(p);
    if ((p_in > 0.0 && q_in < 0.0) || (p_in < 0.0 && q_in > 0.0)) {
      kept.add(p + (p_in / (p_in - q_in)) * (polygon[next] - p));
    }
  }
  return true;
}

/// The eight of more points that lie farthest in eight directions of the plane across n.
void reduce(ContactManifold& manifold, const Corners& points, const double* gaps) {
  const Vector3& n = manifold.nhat_AB_W;
  const Vector3 axis = std::abs(n.x()) < 0.6 ? Vector3(1.0, 0.0, 0.0) : Vector3(0.0, 1.0, 0.0);
  Vector3 t1 = cross(n, axis);
  t1 = t1 / norm(t1);
  const Vector3 t2 = cross(n, t1);
  const double cosines[8] = {1.0, 0.7, 0.0, -0.7, -1.0, -0.7, 0.0, 0.7};
  std::array<bool, kMaxCorners> taken{};
  for (int k = 0; k < 8; ++k) {
    const Vector3 direction = cosines[k] * t1 + cosines[(k + 6) % 8] * t2;
    int best = 0;
    for (int i = 1; i < points.count; ++i) {
      if (dot(points[i], direction) > dot(points[best], direction)) best = i;
    }
    if (taken[at(best)]) continue;
    taken[at(best)] = true;
    manifold.points[at(manifold.count++)] = {points[best], gaps[best]};
  }
}

/// A corner where the polygon hardly turns: sides that lie along each other, but for a small angle,
/// cross somewhere in the middle.
bool isFlatCorner(const Corners& polygon, int i) {
  if (polygon.count <= 3) return false;
  const Vector3 in = polygon[i] - polygon[i > 0 ? i - 1 : polygon.count - 1];
  const Vector3 out = polygon[i + 1 < polygon.count ? i + 1 : 0] - polygon[i];
  return squaredNorm(cross(in, out)) <
         kFlatCorner * kFlatCorner * (squaredNorm(in) * squaredNorm(out));
}

/// Clips the face of `against` that looks against a face of `on` to the prism over that.
/// @param normal outward, of the face of `on`, in W.
/// @returns false if nothing of it is within the band.
bool faceManifold(const PlacedFace& on, const Vector3& normal, const PlacedFace& against,
                  ContactManifold& manifold, double band) {
  const Pose& X_WR = on.X_WB;
  const PolyhedronData& data = on.body.data();
  const PolyhedronData::Face& f = data.faces[at(on.face)];
  const double height = f.offset + dot(normal, X_WR.p_AB);
  Corners buffers[2];
  int now = 0;
  addCorners(against, buffers[now]);
  for (std::int32_t k = 0; k < f.ring_count && buffers[now].count > 0; ++k) {
    const PolyhedronData::RingPlane& side = data.ring[at(f.ring_begin + k)];
    const Vector3 inward = times(X_WR.R_AB, side.inward);
    const double offset = side.offset + dot(inward, X_WR.p_AB);
    if (clip(buffers[now], inward, offset, buffers[1 - now])) now = 1 - now;
  }
  const Corners& polygon = buffers[now];
  const double same = kSamePoint * std::min(data.radius, against.body.data().radius);
  Corners points;
  std::array<double, kMaxCorners> gaps;  // m
  for (int i = 0; i < polygon.count; ++i) {
    if (isFlatCorner(polygon, i)) continue;
    const double gap = dot(normal, polygon[i]) - height;
    if (gap > band) continue;
    const Vector3 p_WC = polygon[i] - (0.5 * gap) * normal;
    const auto is_same = [&](const Vector3& known) {
      return squaredNorm(known - p_WC) < same * same;
    };
    if (std::any_of(points.points.begin(), points.points.begin() + points.count, is_same)) continue;
    gaps[at(points.count)] = gap;
    points.add(p_WC);
  }
  if (points.count == 0) return false;
  if (points.count > ContactManifold::kMaxPoints) {
    reduce(manifold, points, gaps.data());
    return true;
  }
  for (int i = 0; i < points.count; ++i) manifold.points[at(i)] = {points[i], gaps[at(i)]};
  manifold.count = points.count;
  return true;
}

/// The edge of a feature that lies most along a direction of W: the edge itself, or one of those of
/// a vertex; -1 for a face.
int edgeAlong(const ConvexPolyhedron& body, const Pose& X_WB, Feature feature,
              const Vector3& direction_W) {
  if (feature.kind == FeatureKind::kEdge) return feature.index;
  if (feature.kind == FeatureKind::kFace) return -1;
  const PolyhedronData& data = body.data();
  const PolyhedronData::Vertex& vertex = data.vertices[at(feature.index)];
  const Vector3 direction = transposeTimes(X_WB.R_AB, direction_W);
  int best = -1;
  double alignment = -1.0;
  for (std::int32_t k = 0; k < vertex.fan_count; ++k) {
    const double along = std::abs(dot(data.fan[at(vertex.fan_begin + k)].direction, direction));
    if (along <= alignment) continue;
    alignment = along;
    best = data.fan_edge[at(vertex.fan_begin + k)] / 2;
  }
  return best;
}

/// The ends of the common part of two parallel edges; false if the closest features do not hold an
/// edge, or no parallel one beside it.
bool edgeManifold(const ConvexPolyhedron& A, const Pose& X_WA, const ConvexPolyhedron& B,
                  const Pose& X_WB, const ClosestFeatures& closest, ContactManifold& manifold) {
  int edge_a = -1;
  int edge_b = -1;
  if (closest.feature_a.kind == FeatureKind::kEdge) {
    edge_a = closest.feature_a.index;
    edge_b = edgeAlong(B, X_WB, closest.feature_b, times(X_WA.R_AB, A.edge(edge_a).direction));
  } else if (closest.feature_b.kind == FeatureKind::kEdge) {
    edge_b = closest.feature_b.index;
    edge_a = edgeAlong(A, X_WA, closest.feature_a, times(X_WB.R_AB, B.edge(edge_b).direction));
  }
  if (edge_a < 0 || edge_b < 0) return false;
  const PolyhedronData::Edge& a = A.edge(edge_a);
  const PolyhedronData::Edge& b = B.edge(edge_b);
  const Vector3 along = times(X_WA.R_AB, a.direction);
  const Vector3 other = times(X_WB.R_AB, b.direction);
  if (squaredNorm(cross(along, other)) > kFaceAlignment * kFaceAlignment) return false;
  const double from_a = dot(along, transform(X_WA, a.p));
  const double start_b = dot(along, transform(X_WB, b.p));
  const double end_b = start_b + b.length * dot(along, other);
  const double low = std::max(from_a, std::min(start_b, end_b));
  const double high = std::min(from_a + a.length, std::max(start_b, end_b));
  if (!(high > low)) return false;
  const Vector3 middle = 0.5 * (closest.p_WCa + closest.p_WCb);
  const double here = dot(along, middle);
  manifold.points[0] = {middle + (low - here) * along, closest.distance};
  manifold.points[1] = {middle + (high - here) * along, closest.distance};
  manifold.count = 2;
  return true;
}

/// The closest points become one of the points if all others have notably more of a gap: corners
/// that were merged, or left out of eight, may have been the nearest.
void addClosest(const ClosestFeatures& closest, ContactManifold& manifold) {
  const double enough = closest.distance + kMissedGap * std::abs(closest.distance);
  for (int i = 0; i < manifold.count; ++i) {
    if (manifold.points[at(i)].gap <= enough) return;
  }
  manifold.count = std::min(manifold.count + 1, ContactManifold::kMaxPoints);
  manifold.points[at(manifold.count - 1)] = {0.5 * (closest.p_WCa + closest.p_WCb),
                                             closest.distance};
}

}  // namespace

ContactManifold contactManifold(const ConvexPolyhedron& A, const Pose& X_WA,
                                const ConvexPolyhedron& B, const Pose& X_WB,
                                const ClosestFeatures& closest, double band) {
  const FloatingPointEnvironment environment;
  ContactManifold manifold;
  manifold.nhat_AB_W = closest.nhat_AB_W;
  const double aligned = 1.0 - 0.5 * kFaceAlignment * kFaceAlignment;
  double along_A = 0.0;
  double along_B = 0.0;
  const int face_A = faceAlong(A, X_WA, closest.nhat_AB_W, along_A);
  const int face_B = faceAlong(B, X_WB, -closest.nhat_AB_W, along_B);
  if (along_A >= aligned && along_A >= along_B) {
    const Vector3 normal = times(X_WA.R_AB, A.face(face_A).normal);
    manifold.nhat_AB_W = normal;
    const int against = normal == closest.nhat_AB_W ? face_B : faceAlong(B, X_WB, -normal, along_B);
    if (faceManifold({A, X_WA, face_A}, normal, {B, X_WB, against}, manifold, band)) {
      addClosest(closest, manifold);
      manifold.of_face = true;
      return manifold;
    }
  } else if (along_B >= aligned) {
    const Vector3 normal = times(X_WB.R_AB, B.face(face_B).normal);
    manifold.nhat_AB_W = -normal;
    const int against =
        -normal == closest.nhat_AB_W ? face_A : faceAlong(A, X_WA, -normal, along_A);
    if (faceManifold({B, X_WB, face_B}, normal, {A, X_WA, against}, manifold, band)) {
      addClosest(closest, manifold);
      manifold.of_face = true;
      return manifold;
    }
  } else if (edgeManifold(A, X_WA, B, X_WB, closest, manifold)) {
    return manifold;
  }
  manifold.nhat_AB_W = closest.nhat_AB_W;
  manifold.points[0] = {0.5 * (closest.p_WCa + closest.p_WCb), closest.distance};
  manifold.count = 1;
  return manifold;
}

}  // namespace hovercraft
