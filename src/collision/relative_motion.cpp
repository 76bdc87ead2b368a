#include "hovercraft_sim/collision/relative_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hovercraft {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

double earliestZero(double gap, double speed, double curvature) {
  const double root = std::sqrt(speed * speed + 2.0 * curvature * gap);
  if (speed > 0.0) return 2.0 * gap / (speed + root);
  return curvature > 0.0 ? (root - speed) / curvature : kNever;
}

RelativeMotion::Side RelativeMotion::sideOf(const ConvexPolyhedron& body, const StepMotion& motion,
                                            double duration) {
  const Vector3 fastest = motion.fastestTurn(duration);
  return {body, motion, fastest, norm(fastest), norm(motion.alpha_WB)};
}

RelativeMotion::RelativeMotion(const ConvexPolyhedron& A, const StepMotion& motion_A,
                               const ConvexPolyhedron& B, const StepMotion& motion_B,
                               double duration)
    : side_A_(sideOf(A, motion_A, duration)),
      side_B_(sideOf(B, motion_B, duration)),
      motion_A_(motion_A),
      motion_B_(motion_B),
      radius_A_(A.data().radius),
      radius_B_(B.data().radius),
      acceleration_(norm(motion_B.a_WB - motion_A.a_WB)),
      spin_A_(side_A_.spin),
      spin_B_(side_B_.spin),
      // That of the ends is the greatest, as it is linear in time.
      spin_(
          std::max(norm(motion_B.w_WB - motion_A.w_WB),
                   norm(motion_B.angularVelocity(duration) - motion_A.angularVelocity(duration)))),
      spin_up_(norm(motion_B.alpha_WB - motion_A.alpha_WB)),
      speed_(norm(motion_B.v_WB - motion_A.v_WB) + acceleration_ * duration),
      reach_(norm(motion_B.p_WB - motion_A.p_WB) + speed_ * duration),
      duration_(duration) {}

/// Bound on the acceleration of a body's points along n by its turn, m/s²:
/// n · (alpha × r + w × (w × r)) = (n × alpha) · r + (n × w) · (w × r), where w keeps its axis.
double RelativeMotion::curvatureAcross(const Side& side, const Vector3& n) const {
  const double radius = side.body.data().radius;
  const double across = norm(cross(side.fastest, n));
  return (across * side.spin + norm(cross(side.motion.alpha_WB, n))) * radius;
}

/// A plane across n, fixed in W, in A or in B, stays between the bodies for at least this long.
double RelativeMotion::clearTimeAnywhere(double gap, const Instant& now) const {
  const double across = norm(cross(now.w_B - now.w_A, now.n));
  const double across_A = norm(cross(now.w_A, now.n));
  const double across_B = norm(cross(now.w_B, now.n));
  const double in_W = now.closing + across_A * radius_A_ + across_B * radius_B_;
  const double in_A = now.closing + dot(now.n, cross(now.w_A, now.from_A_B)) + across * radius_B_;
  const double in_B = now.closing + dot(now.n, cross(now.w_B, now.from_A_B)) + across * radius_A_;
  const double curvature_W = std::max(0.0, dot(now.n, Vector3(motion_A_.a_WB - motion_B_.a_WB))) +
                             curvatureAcross(side_A_, now.n) + curvatureAcross(side_B_, now.n);
  return std::max(earliestZero(gap, in_W, curvature_W),
                  std::max(earliestZero(gap, in_A, turningAcceleration(side_A_, side_B_)),
                           earliestZero(gap, in_B, turningAcceleration(side_B_, side_A_))));
}

/// Speed at which the witness points, fixed to their bodies, approach along n.
double RelativeMotion::closingOfWitnesses(const ClosestFeatures& now, double t,
                                          const Instant& instant) const {
  const Vector3 r_A =
      now.p_WCa - (motion_A_.p_WB + t * (motion_A_.v_WB + (0.5 * t) * motion_A_.a_WB));
  const Vector3 r_B =
      now.p_WCb - (motion_B_.p_WB + t * (motion_B_.v_WB + (0.5 * t) * motion_B_.a_WB));
  return instant.closing +
         dot(instant.n, Vector3(cross(instant.w_A, r_A) - cross(instant.w_B, r_B)));
}

/// While the face's normal stays in the cone of the vertex, the gap is the height of this vertex
/// over the plane of the face.
double RelativeMotion::clearTimeOfVertexFace(const ClosestFeatures& now, double t,
                                             const Instant& instant) const {
  const double in_cone = spin_ > 0.0 ? -now.excess / spin_ : kNever;
  const bool face_A = now.feature_a.kind == FeatureKind::kFace;
  const double curvature =
      face_A ? turningAcceleration(side_A_, side_B_) : turningAcceleration(side_B_, side_A_);
  return std::min(in_cone,
                  earliestZero(now.distance, closingOfWitnesses(now, t, instant), curvature));
}

/// While the common normal of the edges' lines stays in the cones of both, the gap is the distance
/// of the lines, g / s with g = w · (e_A × e_B) and s the sine of their angle. In the axes of A:
/// |N'| <= w, |N''| <= w² + w_A w_B + |alpha| for N = e_A × e_B, and s stays above half of what it
/// is now for as long as the cones allow.
double RelativeMotion::clearTimeOfEdges(const ClosestFeatures& now, double t, double sine,
                                        const Instant& instant) const {
  const double s = 0.5 * sine;
  const double in_cone = spin_ > 0.0 ? std::min(1.0, -now.excess) * s / spin_ : kNever;
  const double second = spin_ * spin_ + spin_A_ * spin_B_ + spin_up_;
  const double size = reach_ + radius_A_ + radius_B_;
  const double speed = speed_ + spin_B_ * radius_B_ + spin_A_ * (reach_ + radius_B_);
  const double g_first = speed + size * spin_;
  const double g_second =
      turningAcceleration(side_A_, side_B_) + 2.0 * speed * spin_ + size * second;
  const double s_second = second + spin_ * spin_ / s;
  const double curvature = g_second / s + 2.0 * g_first * spin_ / (s * s) +
                           size * s_second / (s * s) + 2.0 * size * spin_ * spin_ / (s * s * s);
  return std::min(in_cone,
                  earliestZero(now.distance, closingOfWitnesses(now, t, instant), curvature));
}

/// Bound on the second derivative, 1/s², of the slope of an edge e over a face that moves too:
/// |w' × e| + |w × (w × e)|, w the velocity of the turn of one body against the other. |w × e|
/// grows no faster than by Grönwall's bound, and exp(x) <= 1 + 2 x up to 1. An edge along the one
/// axis of all turns keeps its slope: that is what holds in the planar model, where upright edges
/// are level with faces for ever.
/// @param turning the side that turns faster. @param wobble bound on |w'| but for the angular
/// accelerations. @param swept |w × e| now.
double RelativeMotion::slopeCurvature(const Side& turning, double wobble, const Vector3& e,
                                      double swept) const {
  if (spin_up_ > 0.0) {
    if (wobble > 0.0) return wobble + spin_up_ + spin_ * spin_;
    return (spin_up_ + spin_ * spin_) * (norm(cross(turning.fastest, e)) / turning.spin);
  }
  const double angle = spin_ * duration_;
  const double fastest =
      angle > 1.0 ? spin_ : std::min(spin_, (1.0 + 2.0 * angle) * (swept + wobble * duration_));
  return wobble + spin_ * fastest;
}

/// For how long a vertex stays the lowest of its body over a face that moves too: until the slope
/// m · e of one of its edges e, which falls at -m · (w × e) now, is 0.
double RelativeMotion::timeLowest(const Side& face_side, const Side& other, const Vector3& up,
                                  const Pose& X_WV, int vertex, double t) const {
  const PolyhedronData& data = other.body.data();
  const auto& corner = data.vertices[static_cast<std::size_t>(vertex)];
  if (corner.fan_count > PolyhedronData::kLongLoop) return 0.0;
  const Vector3 w = other.motion.angularVelocity(t) - face_side.motion.angularVelocity(t);
  const double wobble = norm(cross(face_side.fastest, other.fastest));
  const Side& turning = other.spin > face_side.spin ? other : face_side;
  double least = kNever;
  for (std::int32_t i = corner.fan_begin; i < corner.fan_begin + corner.fan_count; ++i) {
    const Vector3 e = times(X_WV.R_AB, data.fan[static_cast<std::size_t>(i)].direction);
    const Vector3 swept = cross(w, e);
    const double slope = dot(up, e);
    if (slope < 0.0) return 0.0;
    least = std::min(least, earliestZero(slope, -dot(up, swept),
                                         slopeCurvature(turning, wobble, e, norm(swept))));
  }
  return least;
}

/// A vertex over a face of the other body: as long as it is the lowest of its body, its height over
/// the plane of the face is a gap.
double RelativeMotion::clearTimeOverFace(const Side& face_side, int face, const Side& other,
                                         int vertex, const Instant& instant) const {
  const double t = instant.time;
  const Pose X_WF = face_side.motion.at(t);
  const Pose X_WV = other.motion.at(t);
  const PolyhedronData::Face& plane = face_side.body.face(face);
  const Vector3 up = times(X_WF.R_AB, plane.normal);
  const Vector3 p = transform(X_WV, other.body.vertex(vertex));
  const double gap = dot(up, Vector3(p - X_WF.p_AB)) - plane.offset - instant.margin;
  if (!(gap > 0.0)) return 0.0;
  const auto velocity = [&](const Side& side, const Pose& X_WB) -> Vector3 {
    return (side.motion.v_WB + t * side.motion.a_WB) +
           cross(side.motion.angularVelocity(t), p - X_WB.p_AB);
  };
  const double closing = dot(up, Vector3(velocity(face_side, X_WF) - velocity(other, X_WV)));
  const double curvature = turningAcceleration(face_side, other);
  return std::min(timeLowest(face_side, other, up, X_WV, vertex, t),
                  earliestZero(gap, closing, curvature));
}

/// For a vertex or an edge over an edge: over the face beside it that looks at the other body most.
double RelativeMotion::clearTimeBesideEdge(const ClosestFeatures& now, bool edge_of_A,
                                           const Instant& instant) const {
  const Side& side = edge_of_A ? side_A_ : side_B_;
  const Side& other = edge_of_A ? side_B_ : side_A_;
  const Feature edge = edge_of_A ? now.feature_a : now.feature_b;
  const Feature feature = edge_of_A ? now.feature_b : now.feature_a;
  const Vector3 towards = transposeTimes(side.motion.at(instant.time).R_AB,
                                         edge_of_A ? instant.n : Vector3(-instant.n));
  const PolyhedronData::Edge& data = side.body.edge(edge.index);
  const bool second = dot(side.body.face(data.face[1]).normal, towards) >
                      dot(side.body.face(data.face[0]).normal, towards);
  const int vertex = feature.kind == FeatureKind::kVertex
                         ? feature.index
                         : other.body.edge(feature.index).vertex[0];
  return clearTimeOverFace(side, data.face[second ? 1 : 0], other, vertex, instant);
}

/// The same for all pairs of features that are level with a face, as happens in the planar model.
double RelativeMotion::clearTimeOverFaces(const ClosestFeatures& now,
                                          const Instant& instant) const {
  const FeatureKind a = now.feature_a.kind;
  const FeatureKind b = now.feature_b.kind;
  if (a == FeatureKind::kFace && b == FeatureKind::kVertex) {
    return clearTimeOverFace(side_A_, now.feature_a.index, side_B_, now.feature_b.index, instant);
  }
  if (b == FeatureKind::kFace && a == FeatureKind::kVertex) {
    return clearTimeOverFace(side_B_, now.feature_b.index, side_A_, now.feature_a.index, instant);
  }
  double clear = 0.0;
  if (a == FeatureKind::kEdge && b != FeatureKind::kFace) {
    clear = clearTimeBesideEdge(now, true, instant);
  }
  if (b == FeatureKind::kEdge && a != FeatureKind::kFace) {
    clear = std::max(clear, clearTimeBesideEdge(now, false, instant));
  }
  return clear;
}

double RelativeMotion::clearTime(const ClosestFeatures& closest, double t, double margin) const {
  ClosestFeatures now = closest;
  now.distance -= margin;
  Instant instant{
      now.nhat_AB_W,
      (motion_B_.v_WB - motion_A_.v_WB) + t * (motion_B_.a_WB - motion_A_.a_WB),
      (motion_B_.p_WB - motion_A_.p_WB) +
          t * ((motion_B_.v_WB - motion_A_.v_WB) + (0.5 * t) * (motion_B_.a_WB - motion_A_.a_WB)),
      motion_A_.angularVelocity(t),
      motion_B_.angularVelocity(t),
      0.0,
      t,
      margin};
  instant.closing = -dot(instant.n, instant.v);
  double clear = clearTimeAnywhere(now.distance, instant);
  const FeatureKind a = now.feature_a.kind;
  const FeatureKind b = now.feature_b.kind;
  if (a == FeatureKind::kFace || b == FeatureKind::kFace) {
    clear = std::max(clear, clearTimeOfVertexFace(now, t, instant));
  } else if (a == FeatureKind::kEdge && b == FeatureKind::kEdge && now.edge_sine > 0.0) {
    clear = std::max(clear, clearTimeOfEdges(now, t, now.edge_sine, instant));
  }
  if (t + clear < duration_) clear = std::max(clear, clearTimeOverFaces(now, instant));
  return clear;
}

}  // namespace hovercraft
