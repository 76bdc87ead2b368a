#include "hovercraft_sim/contact/contact_solver.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/index.h"

namespace hovercraft {
namespace {

/// Bound on a component of the normal (-) below which its axis serves to build a tangent: just
/// above 1/√3, so that one always does, and no common direction is near it.
constexpr double kSmallComponent = 0.6;

/// A unit vector across n; horizontal axes first, so that a vertical wall has one level tangent.
Vector3 tangentTo(const Vector3& n) {
  const Vector3 axis = std::abs(n.z()) < kSmallComponent   ? Vector3(0.0, 0.0, 1.0)
                       : std::abs(n.x()) < kSmallComponent ? Vector3(1.0, 0.0, 0.0)
                                                           : Vector3(0.0, 1.0, 0.0);
  const Vector3 across = cross(axis, n);
  return across / norm(across);
}

/// To the bit: of a zero of the other sign other tangents are made.
bool isSame(const Vector3& a, const Vector3& b) {
  for (int i = 0; i < 3; ++i) {
    if (a[i] != b[i] || std::signbit(a[i]) != std::signbit(b[i])) return false;
  }
  return true;
}

}  // namespace

void ContactSolver::clear() {
  bodies_.clear();
  is_fixed_.clear();
  points_.clear();
}

std::int32_t ContactSolver::add(const ContactBody& body) {
  bodies_.push_back(body);
  is_fixed_.push_back(
      (body.inverse_mass.array() == 0.0).all() && (body.inverse_inertia.array() == 0.0).all() &&
      (body.twist.v_WB.array() == 0.0).all() && (body.twist.w_WB.array() == 0.0).all());
  return static_cast<std::int32_t>(bodies_.size() - 1);
}

/// What a unit impulse on B along a direction, and against A, makes of the velocity of B against A
/// there, 1/kg.
inline Vector3 ContactSolver::velocityAlong(const Point& point, int direction) const {
  const Vector3 inverse_mass =
      bodies_[at(point.a)].inverse_mass + bodies_[at(point.b)].inverse_mass;
  const Vector3 linear = inverse_mass.cwiseProduct(point.directions[direction]);
  return linear +
         (cross(point.spin_a[direction], point.r_a) + cross(point.spin_b[direction], point.r_b));
}

/// What the impulses of a point do, from the velocities that a unit impulse along each direction
/// makes.
void ContactSolver::weigh(Point& point, const Vector3 (&velocities)[3]) {
  const Vector3& s = point.directions[1];
  const Vector3& t = point.directions[2];
  for (int i = 0; i < 3; ++i) {
    point.inverse_mass[i] = std::max(0.0, dot(point.directions[i], velocities[i]));
  }
  const auto inverse = [](double x) { return x > 0.0 ? 1.0 / x : 0.0; };
  const double k_s = point.inverse_mass.y();
  const double k_t = point.inverse_mass.z();
  const double k_st = dot(t, velocities[1]);
  point.normal_to_s = dot(s, velocities[0]);
  point.normal_to_t = dot(t, velocities[0]);
  point.normal_mass = inverse(point.inverse_mass.x());
  const double per_determinant = inverse(k_s * k_t - k_st * k_st);
  point.stop_ss = per_determinant > 0.0 ? k_t * per_determinant : inverse(k_s);
  point.stop_st = -k_st * per_determinant;
  point.stop_tt = per_determinant > 0.0 ? k_s * per_determinant : inverse(k_t);
  const double spread = 0.5 * (k_s - k_t);
  point.slip_mass = inverse(0.5 * (k_s + k_t) + std::sqrt(spread * spread + k_st * k_st));
}

/// Its directions: those of the last point, if that has the same normal.
inline void ContactSolver::turnPoint(Point& point, const Vector3& nhat_AB_W) const {
  point.directions[0] = nhat_AB_W;
  if (points_.size() > 1) {
    const Point& last = points_[points_.size() - 2];
    if (isSame(last.directions[0], nhat_AB_W)) {
      point.directions[1] = last.directions[1];
      point.directions[2] = last.directions[2];
      return;
    }
  }
  point.directions[1] = tangentTo(nhat_AB_W);
  point.directions[2] = cross(nhat_AB_W, point.directions[1]);
}

std::size_t ContactSolver::add(const ContactConstraint& constraint) {
  demand(constraint.a >= 0 && constraint.b >= 0 &&
             at(std::max(constraint.a, constraint.b)) < bodies_.size(),
         "a point of contact must name two bodies");
  const ContactBody& A = bodies_[at(constraint.a)];
  const ContactBody& B = bodies_[at(constraint.b)];
  points_.emplace_back();
  Point& point = points_.back();
  point.a = constraint.a;
  point.b = constraint.b;
  point.r_a = constraint.p_WC - A.p_WB;
  point.r_b = constraint.p_WC - B.p_WB;
  point.target = constraint.target;
  point.friction = constraint.friction;
  point.bilateral = constraint.bilateral;
  point.b_is_fixed = is_fixed_[at(constraint.b)];
  turnPoint(point, constraint.nhat_AB_W);
  for (int i = 0; i < 3; ++i) {
    point.spin_a[i] = times(A.inverse_inertia, cross(point.r_a, point.directions[i]));
    point.spin_b[i] = times(B.inverse_inertia, cross(point.r_b, point.directions[i]));
  }
  weigh(point, {velocityAlong(point, 0), velocityAlong(point, 1), velocityAlong(point, 2)});
  for (int i = 0; i < 3; ++i) {
    point.lambda[i] =
        point.inverse_mass[i] > 0.0 ? dot(point.directions[i], constraint.start) : 0.0;
  }
  point.lambda[0] = std::max(0.0, point.lambda[0]);
  // No sweep looks along the tangents of these.
  if (!point.bilateral && !(point.friction > 0.0)) point.lambda[1] = point.lambda[2] = 0.0;
  if (squaredNorm(point.lambda) > 0.0) apply(point, point.lambda);
  return points_.size() - 1;
}

/// Both tangents at once: the impulse that stops the slip v, if the cone holds it; else a step
/// against the slip, projected on the cone, whose fixed point is an impulse at the bound against
/// the slip.
inline void ContactSolver::relaxTangents(Point& point, double v_s, double v_t) {
  double s = point.lambda.y() - (point.stop_ss * v_s + point.stop_st * v_t);
  double t = point.lambda.z() - (point.stop_st * v_s + point.stop_tt * v_t);
  const double pressed = point.lambda.x();
  const double bound = pressed > 0.0 ? point.friction * pressed : 0.0;
  if (!point.bilateral && s * s + t * t > bound * bound) {
    s = point.inverse_mass.y() > 0.0 ? point.lambda.y() - point.slip_mass * v_s : 0.0;
    t = point.inverse_mass.z() > 0.0 ? point.lambda.z() - point.slip_mass * v_t : 0.0;
    const double size = std::sqrt(s * s + t * t);
    const double share = size > bound ? bound / size : 1.0;
    s *= share;
    t *= share;
  }
  point.lambda.y() = s;
  point.lambda.z() = t;
}

/// The normal, then the tangents as it leaves them. @returns the largest change of a velocity along
/// one of them that its new impulse makes, m/s.
inline double ContactSolver::relax(Point& point) {
  const Vector3 before = point.lambda;
  const Vector3 v = velocity(point);
  const double pressed =
      before.x() + point.normal_mass * (point.target - dot(point.directions[0], v));
  if (!point.bilateral && !(pressed > 0.0) && squaredNorm(before) == 0.0) return 0.0;  // parts
  point.lambda.x() = point.bilateral ? pressed : std::max(0.0, pressed);
  if (point.friction > 0.0 || point.bilateral) {
    const double by = point.lambda.x() - before.x();
    relaxTangents(point, dot(point.directions[1], v) + point.normal_to_s * by,
                  dot(point.directions[2], v) + point.normal_to_t * by);
  }
  const Vector3 by = point.lambda - before;
  const double changed = by.cwiseAbs().cwiseProduct(point.inverse_mass).maxCoeff();
  if (changed > 0.0) apply(point, by);
  return changed;
}

ContactSolver::Change ContactSolver::sweep() {
  Change sum;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Point& point = points_[k];
    before_[k] = point.lambda;
    sum.largest = std::max(sum.largest, relax(point));
    const Vector3 by = point.lambda - before_[k];
    sum.energy += dot(by, Vector3(by.cwiseProduct(point.inverse_mass)));
    sum.any = sum.any || (by.array() != 0.0).any();
  }
  return sum;
}

/// Goes on by `share` of the last search direction, and makes the next one of both.
void ContactSolver::goOn(double share) {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Point& point = points_[k];
    const Vector3 ahead = share * search_[k];
    search_[k] = (point.lambda - before_[k]) + ahead;
    if (squaredNorm(ahead) == 0.0) continue;
    point.lambda += ahead;
    apply(point, ahead);
  }
}

/// Turns the friction of what slides against the slip, and looks at what parts. @returns whether
/// all was well.
bool ContactSolver::mendStates(double tolerance) {
  bool well = true;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Point& point = points_[k];
    const Vector3 v = velocity(point);
    if (states_[k] == State::kSeparating &&
        dot(point.directions[0], v) < point.target - tolerance) {
      states_[k] = State::kSliding;
      well = false;
    }
    if (states_[k] != State::kSliding || !(point.friction > 0.0)) continue;
    const Vector3 before = point.lambda;
    relaxTangents(point, dot(point.directions[1], v), dot(point.directions[2], v));
    const Vector3 by = point.lambda - before;
    if (!(by.cwiseAbs().cwiseProduct(point.inverse_mass).maxCoeff() > tolerance)) continue;
    apply(point, by);
    well = false;
    if (isWithinCone(point)) states_[k] = State::kSticking;
  }
  return well;
}

int ContactSolver::solve(const Limits& limits) {
  search_.assign(points_.size(), Vector3::Zero());
  before_.resize(points_.size());
  double last_energy = 0.0;
  ActiveSets sets;
  sets.are_tried = canSolveActiveSet();
  for (int sweeps = 1;; ++sweeps) {
    const Change change = sweep();
    double above = limits.active_set_above;
    double tolerance = limits.tolerance;
    if (sets.are_tried) {
      above = std::max(above, roundingOfActiveSets());
      tolerance = std::min(tolerance, above);
    }
    const bool solved = change.largest <= tolerance &&
                        (sweeps >= limits.least_sweeps || change.largest <= kNoChange);
    // After a sweep that changed nothing all that follow change nothing.
    if (solved || sweeps >= limits.sweeps || !change.any) return sweeps;
    if (activeSetOrUndo(sets, change.largest, sweeps, above)) {
      last_energy = 0.0;
      continue;
    }
    goOn(last_energy > 0.0 && change.energy <= last_energy ? change.energy / last_energy : 0.0);
    last_energy = change.energy;
  }
}

}  // namespace hovercraft
