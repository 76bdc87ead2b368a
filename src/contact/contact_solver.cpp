#include "hovercraft_sim/contact/contact_solver.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/demand.h"

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

}  // namespace

void ContactSolver::clear() {
  bodies_.clear();
  points_.clear();
}

std::int32_t ContactSolver::add(const ContactBody& body) {
  bodies_.push_back(body);
  return static_cast<std::int32_t>(bodies_.size() - 1);
}

ContactSolver::Direction ContactSolver::direction(const Point& point, const Vector3& d) const {
  const ContactBody& A = bodies_[static_cast<std::size_t>(point.a)];
  const ContactBody& B = bodies_[static_cast<std::size_t>(point.b)];
  Direction result;
  result.d = d;
  result.linear_a = A.inverse_mass.cwiseProduct(d);
  result.linear_b = B.inverse_mass.cwiseProduct(d);
  const Vector3 arm_a = cross(point.r_a, d);
  const Vector3 arm_b = cross(point.r_b, d);
  result.angular_a = times(A.inverse_inertia, arm_a);
  result.angular_b = times(B.inverse_inertia, arm_b);
  const double inverse = (dot(d, result.linear_a) + dot(d, result.linear_b)) +
                         (dot(arm_a, result.angular_a) + dot(arm_b, result.angular_b));
  result.mass = inverse > 0.0 ? 1.0 / inverse : 0.0;
  result.lambda = 0.0;
  return result;
}

std::size_t ContactSolver::add(const ContactDemand& asked) {
  demand(asked.a >= 0 && asked.b >= 0 &&
             static_cast<std::size_t>(std::max(asked.a, asked.b)) < bodies_.size(),
         "a point of contact must name two bodies");
  Point point;
  point.a = asked.a;
  point.b = asked.b;
  point.r_a = asked.p_WC - bodies_[static_cast<std::size_t>(asked.a)].p_WB;
  point.r_b = asked.p_WC - bodies_[static_cast<std::size_t>(asked.b)].p_WB;
  point.target = asked.target;
  point.friction = asked.friction;
  point.bilateral = asked.bilateral;
  const Vector3 t = tangentTo(asked.nhat_AB_W);
  point.directions[0] = direction(point, asked.nhat_AB_W);
  point.directions[1] = direction(point, t);
  point.directions[2] = direction(point, cross(asked.nhat_AB_W, t));
  const Direction& second = point.directions[2];
  const Vector3& first = point.directions[1].d;
  point.coupling = (dot(first, second.linear_a) + dot(first, second.linear_b)) +
                   (dot(cross(point.r_a, first), second.angular_a) +
                    dot(cross(point.r_b, first), second.angular_b));
  const double inverse_s = point.directions[1].mass > 0.0 ? 1.0 / point.directions[1].mass : 0.0;
  const double inverse_t = second.mass > 0.0 ? 1.0 / second.mass : 0.0;
  const double spread = 0.5 * (inverse_s - inverse_t);
  const double largest =
      0.5 * (inverse_s + inverse_t) + std::sqrt(spread * spread + point.coupling * point.coupling);
  point.slip_mass = largest > 0.0 ? 1.0 / largest : 0.0;
  for (Direction& along : point.directions) {
    const double start = along.mass > 0.0 ? dot(along.d, asked.start) : 0.0;
    along.lambda = &along == &point.directions[0] ? std::max(0.0, start) : start;
    if (along.lambda != 0.0) apply(point, along, along.lambda);
  }
  points_.push_back(point);
  return points_.size() - 1;
}

Vector3 ContactSolver::velocity(const Point& point) const {
  const Twist& A = bodies_[static_cast<std::size_t>(point.a)].twist;
  const Twist& B = bodies_[static_cast<std::size_t>(point.b)].twist;
  return (B.v_WB - A.v_WB) + (cross(B.w_WB, point.r_b) - cross(A.w_WB, point.r_a));
}

Vector3 ContactSolver::velocityAt(std::size_t point) const {
  return velocity(points_[point]);
}

Vector3 ContactSolver::impulse(std::size_t point) const {
  const Point& at = points_[point];
  return (at.directions[0].lambda * at.directions[0].d +
          at.directions[1].lambda * at.directions[1].d) +
         at.directions[2].lambda * at.directions[2].d;
}

void ContactSolver::apply(const Point& point, const Direction& direction, double impulse) {
  Twist& A = bodies_[static_cast<std::size_t>(point.a)].twist;
  Twist& B = bodies_[static_cast<std::size_t>(point.b)].twist;
  A.v_WB -= impulse * direction.linear_a;
  A.w_WB -= impulse * direction.angular_a;
  B.v_WB += impulse * direction.linear_b;
  B.w_WB += impulse * direction.angular_b;
}

double ContactSolver::relaxNormal(Point& point) {
  Direction& n = point.directions[0];
  if (!(n.mass > 0.0)) return 0.0;
  const double error = point.target - dot(n.d, velocity(point));
  double lambda = n.lambda + n.mass * error;
  if (!point.bilateral) lambda = std::max(0.0, lambda);
  const double change = lambda - n.lambda;
  n.lambda = lambda;
  if (change != 0.0) apply(point, n, change);
  return std::abs(change) / n.mass;
}

/// The impulses along both tangents that stop the slip at the point, given what it is now.
ContactSolver::Tangential ContactSolver::stopping(const Point& point, double v_s, double v_t) {
  const Direction& s = point.directions[1];
  const Direction& t = point.directions[2];
  const double k = point.coupling;
  const double determinant = s.mass > 0.0 && t.mass > 0.0 ? 1.0 / (s.mass * t.mass) - k * k : 0.0;
  if (!(determinant > 0.0)) return {s.lambda - s.mass * v_s, t.lambda - t.mass * v_t};
  return {s.lambda - (v_s / t.mass - k * v_t) / determinant,
          t.lambda - (v_t / s.mass - k * v_s) / determinant};
}

/// Both tangents at once: the impulse that stops the slip, if the cone holds it; else a step
/// against the slip, projected on the cone, whose fixed point is an impulse at the bound against
/// the slip.
double ContactSolver::relaxTangents(Point& point) {
  Direction& s = point.directions[1];
  Direction& t = point.directions[2];
  const Vector3 v = velocity(point);
  const double v_s = s.mass > 0.0 ? dot(s.d, v) : 0.0;
  const double v_t = t.mass > 0.0 ? dot(t.d, v) : 0.0;
  Tangential lambda = stopping(point, v_s, v_t);
  const double pressed = point.directions[0].lambda;
  const double bound = pressed > 0.0 ? point.friction * pressed : 0.0;
  if (!point.bilateral && lambda.s * lambda.s + lambda.t * lambda.t > bound * bound) {
    lambda = {s.lambda - point.slip_mass * v_s, t.lambda - point.slip_mass * v_t};
    const double size = std::sqrt(lambda.s * lambda.s + lambda.t * lambda.t);
    const double share = size > bound ? bound / size : 1.0;
    lambda = {share * lambda.s, share * lambda.t};
  }
  return std::max(change(point, s, lambda.s), change(point, t, lambda.t));
}

/// @returns the change of the velocity along a direction that its new impulse makes, m/s.
double ContactSolver::change(const Point& point, Direction& along, double lambda) {
  if (!(along.mass > 0.0)) return 0.0;
  const double by = lambda - along.lambda;
  along.lambda = lambda;
  if (by != 0.0) apply(point, along, by);
  return std::abs(by) / along.mass;
}

/// @returns the largest change of a velocity that it made, m/s.
double ContactSolver::relax(Point& point) {
  const double changed = relaxNormal(point);
  if (!(point.friction > 0.0) && !point.bilateral) return changed;
  return std::max(changed, relaxTangents(point));
}

/// Sets every impulse aside, to see afterwards what a sweep did.
void ContactSolver::keepImpulses() {
  before_.resize(3 * points_.size());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) before_[3 * k + i] = points_[k].directions[i].lambda;
  }
}

/// The change of the last sweep as a step of the search, and how long it is (J).
double ContactSolver::lengthOfSweep() const {
  double length = 0.0;
  for (std::size_t k = 0; k < points_.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Direction& along = points_[k].directions[i];
      if (!(along.mass > 0.0)) continue;
      const double change = along.lambda - before_[3 * k + i];
      length += change * change / along.mass;
    }
  }
  return length;
}

/// Goes on by `share` of the last search direction, and makes the next one of both.
void ContactSolver::goOn(double share) {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    Point& point = points_[k];
    for (std::size_t i = 0; i < 3; ++i) {
      Direction& along = point.directions[i];
      const double ahead = share * search_[3 * k + i];
      search_[3 * k + i] = ahead + (along.lambda - before_[3 * k + i]);
      if (ahead == 0.0 || !(along.mass > 0.0)) continue;
      along.lambda += ahead;
      apply(point, along, ahead);
    }
  }
}

int ContactSolver::solve(const Limits& limits) {
  search_.assign(3 * points_.size(), 0.0);
  double last_length = 0.0;
  int sweep = 0;
  while (true) {
    keepImpulses();
    double changed = 0.0;
    for (Point& point : points_) changed = std::max(changed, relax(point));
    ++sweep;
    if (sweep >= limits.sweeps) break;
    if (changed <= limits.tolerance && sweep >= limits.least_sweeps) break;
    const double length = lengthOfSweep();
    goOn(last_length > 0.0 && length <= last_length ? length / last_length : 0.0);
    last_length = length;
  }
  return sweep;
}

}  // namespace hovercraft
