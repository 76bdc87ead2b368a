#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {

/// The walk over pairs of features. Axes of W, origin in the origin of A, so that the place of the
/// pair in the world costs no digits. Side 0 is A, side 1 is B.
class FeatureWalk {
 public:
  enum class [[nodiscard]] End{kClosest, kOverlap, kStepLimit, kImpatient};

  FeatureWalk(const ConvexPolyhedron& A, const Pose& X_WA, const ConvexPolyhedron& B,
              const Pose& X_WB)
      : body_{&A.data(), &B.data()},
        rotation_{&X_WA.R_AB, &X_WB.R_AB},
        shift_(X_WB.p_AB - X_WA.p_AB),
        scale_(body_[0]->radius + body_[1]->radius +
               ((std::abs(shift_.x()) + std::abs(shift_.y())) + std::abs(shift_.z()))),
        rounding_(kPointRounding * scale_) {}

  /// Starts from a pair of features.
  void start(const FeaturePair& pair) {
    feature_ = {pair.a, pair.b};
    hints_ = pair.hints;
  }

  /// Starts from the support vertices along `direction` (from A to B), then goes from vertex to
  /// vertex while that brings them closer.
  void startAlong(const Vector3& direction);

  /// From the middle of A to the middle of B.
  Vector3 middleToMiddle() const {
    return times(*rotation_[1], body_[1]->center) + shift_ - times(*rotation_[0], body_[0]->center);
  }

  /// Walks until the pair is certified, the bodies seem to overlap, or the bound is reached.
  /// @param patience steps after which the walk is given up as kImpatient; 0: never.
  End run(std::int32_t patience = 0);

  const std::array<Feature, 2>& features() const { return feature_; }
  const std::array<std::int32_t, 2>& hints() const { return hints_; }
  double distance() const { return distance_; }
  double scale() const { return scale_; }
  const Vector3& normal() const { return normal_; }                  // unit, from A to B
  const Vector3& point(int side) const { return point_[at(side)]; }  // from A's origin
  int steps() const { return steps_; }
  int climbs() const { return climbs_; }
  double excess() const { return excess_; }
  double edgeSine() const { return edge_sine_; }

 private:
  using Data = PolyhedronData;
  enum class [[nodiscard]] Outcome{kMoved, kClosest, kOverlap, kUncertain};
  enum class [[nodiscard]] Verdict{kInside, kOutside, kUncertain};

  /// The edge of a vertex along which a direction climbs most.
  struct Slope {
    double value;      // m, or without unit for a unit direction; may be a bound where negative
    std::int32_t fan;  // place in PolyhedronData::fan
  };

  /// The closest points of two edges.
  struct EdgePoints {
    double s = 0.0;      // m, from vertex[0] of A's edge
    double t = 0.0;      // m, from vertex[0] of B's edge
    bool end_A = false;  // the point is an end of the edge
    bool end_B = false;
    Vector3 u{0.0, 0.0, 0.0};  // m, from A's point to B's, axes of W
  };

  /// The part of an edge over a face, from share `from` to share `to` of its length, and the sides
  /// of the face that cut it there, -1 for none.
  struct Cut {
    double from = 0.0;
    double to = 1.0;
    std::int32_t from_side = -1;
    std::int32_t to_side = -1;
  };

  /// The lines of two edges, axes of W.
  struct Crossing {
    Vector3 a;   // m, vertex[0] of A's edge
    Vector3 b;   // m, of B's
    Vector3 da;  // unit
    Vector3 db;
    Vector3 w;  // m, b - a
    Vector3 n;  // da × db
  };

  Outcome step();
  Outcome vertexVertex();
  Outcome vertexEdge(int x);
  Outcome vertexFace(int x);
  Outcome edgeEdge();
  Outcome edgeFace(int x);

  Slope steepest(int side, const Vector3& direction);
  Slope steepestOfAll(int side, const Vector3& direction) const;
  Slope steepestOfMany(int side, const Vector3& direction);
  std::int32_t ringOutside(int side, const Data::Face& face, const Vector3& p);
  std::int32_t ringOutsideOfAll(int side, const Data::Face& face, const Vector3& p) const;
  std::int32_t ringOutsideOfMany(int side, const Data::Face& face, const Vector3& p);
  Outcome edgesMeet(const Vector3& normal, double length, double error);
  Outcome leaveFace(int x, const Vector3& p);
  bool cutToPrism(int y, const Vector3& start, const Vector3& end, Cut& cut) const;
  Outcome nearestSide(int x, const Vector3& p, const Vector3& q);
  Vector3 preciseDifference() const;
  EdgePoints edgePoints(const Crossing& crossing, double nn) const;
  EdgePoints preciseEdges() const;
  bool leaveEnds(const EdgePoints& points);
  Vector3 preciseVertexEdge(int x) const;
  bool moveVertex(int side);

  const Data::Vertex& vertex(int side) const {
    return body_[side]->vertices[at(feature_[at(side)].index)];
  }
  const Data::Edge& edge(int side) const {
    return body_[side]->edges[at(feature_[at(side)].index)];
  }
  const Data::Face& face(int side) const {
    return body_[side]->faces[at(feature_[at(side)].index)];
  }
  Vector3 toWorld(int side, const Vector3& p) const {
    return side == 0 ? times(*rotation_[0], p) : Vector3(times(*rotation_[1], p) + shift_);
  }
  Vector3 toBody(int side, const Vector3& p) const {
    return transposeTimes(*rotation_[side], side == 0 ? p : Vector3(p - shift_));
  }
  void setFeature(int side, FeatureKind kind, std::int32_t index) {
    feature_[at(side)] = {kind, index};
    hints_[at(side)] = 0;
  }
  void moveAlong(int side, const Slope& slope) {
    setFeature(side, FeatureKind::kEdge, body_[side]->fan_edge[at(slope.fan)] / 2);
  }
  /// Whether a slope over a difference of length `length` leaves the region.
  Verdict judge(double slope, double length) const {
    if (slope <= -rounding_) return Verdict::kInside;
    const double slack = kVoronoiSlack * length;
    if (slope > slack && (precise_ || slope > rounding_)) return Verdict::kOutside;
    return precise_ || rounding_ <= slack ? Verdict::kInside : Verdict::kUncertain;
  }
  /// How far (m) a point may pass the end of an edge or the side of a face and still count as on
  /// it: with differences better than the points themselves, the walk does not go back down for
  /// what is rounding.
  double margin() const { return precise_ ? rounding_ : 0.0; }
  /// Witness points `from` on side x and `to` on the other, u = to - from of length `length`.
  void setAnswer(int x, const Vector3& from, const Vector3& to, const Vector3& unit,
                 double length) {
    edge_sine_ = 0.0;
    point_[at(x)] = from;
    point_[at(1 - x)] = to;
    normal_ = x == 0 ? unit : Vector3(-unit);
    distance_ = length;
  }

  const Data* body_[2];
  const Matrix3* rotation_[2];
  Vector3 shift_;    // p_AB in W
  double scale_;     // m, bound on every coordinate
  double rounding_;  // m, of the difference of two points
  bool precise_ = false;
  std::array<Feature, 2> feature_;
  std::array<std::int32_t, 2> hints_{};
  std::array<Vector3, 2> point_{Vector3(0.0, 0.0, 0.0), Vector3(0.0, 0.0, 0.0)};
  Vector3 normal_{0.0, 0.0, 0.0};
  double distance_ = 0.0;
  double excess_ = 0.0;
  double edge_sine_ = 0.0;
  int steps_ = 0;
  int climbs_ = 0;
};

}  // namespace hovercraft
