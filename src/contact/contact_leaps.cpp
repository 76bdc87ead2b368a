#include <algorithm>
#include <cmath>

#include "hovercraft_sim/contact/contact_solver.h"
#include "hovercraft_sim/math/contact_tolerances.h"

/// Leaps of the solver of contacts: what the sweeps have found out, solved at once.

namespace hovercraft {

bool ContactSolver::canLeap() {
  const auto moving = std::count(is_fixed_.begin(), is_fixed_.end(), false);
  if (moving < kLeastLeapBodies) return false;
  equalities_.clear();
  for (const ContactBody& body : bodies_)
    equalities_.add({body.inverse_mass, body.inverse_inertia});
  for (const Point& point : points_) {
    equalities_.add({point.a, point.b, point.directions[0], point.r_a, point.r_b});
  }
  return equalities_.order() <= kMostLeapWork * points_.size();
}

/// What the points are, by the impulses and velocities that the sweeps have left.
void ContactSolver::guessKinds(double tolerance) {
  kinds_.assign(points_.size(), Kind::kParts);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    const bool is_pressed = point.lambda.x() > 0.0 ||
                            dot(point.directions[0], velocity(point)) < point.target - tolerance;
    if (!point.bilateral && !is_pressed) continue;
    kinds_[k] = point.bilateral || isHeld(point) ? Kind::kHolds : Kind::kSlides;
  }
}

/// Takes away what the kinds of the points may push.
void ContactSolver::letGo() {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Vector3& lambda = points_[k].lambda;
    if (kinds_[k] == Kind::kHolds) apply(points_[k], -lambda);
    if (kinds_[k] == Kind::kSlides) apply(points_[k], Vector3(-lambda.x(), 0.0, 0.0));
  }
}

/// Asks each point for the velocity that its kind has, from where it would be without what its
/// kind may push: of all impulses that do it the least are found, as nothing is left of those that
/// push against each other.
void ContactSolver::addEqualities() {
  held_twists_.clear();
  for (const ContactBody& body : bodies_) held_twists_.push_back(body.twist);
  letGo();
  equalities_.clearRows();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    const Vector3 v = velocity(point);
    for (int i = 0; i < directionsOf(kinds_[k]); ++i) {
      const double wanted = (i == 0 ? point.target : 0.0) - dot(point.directions[i], v);
      equalities_.add({point.a, point.b, point.directions[i], point.r_a, point.r_b, wanted});
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].twist = held_twists_[i];
}

/// The share of a change up to which a point keeps to the laws of contact; more than 1: all of it.
double ContactSolver::shareAllowed(const Point& point, Kind kind, const Vector3& change) {
  constexpr double kAll = 2.0;
  if (point.bilateral) return kAll;
  double share = kAll;
  if (point.lambda.x() + change.x() < 0.0) share = point.lambda.x() / -change.x();
  if (kind != Kind::kHolds || std::isinf(point.friction)) return share;
  // |t + share dt|² = (mu (n + share dn))²
  const double squared = point.friction * point.friction;
  const double n = point.lambda.x();
  const double dn = change.x();
  const double a = change.y() * change.y() + change.z() * change.z() - squared * (dn * dn);
  const double b =
      point.lambda.y() * change.y() + point.lambda.z() * change.z() - squared * (n * dn);
  const double c =
      point.lambda.y() * point.lambda.y() + point.lambda.z() * point.lambda.z() - squared * (n * n);
  if (c >= 0.0) return a + 2.0 * b > 0.0 ? 0.0 : share;
  const double root = b * b - a * c;
  const double below = b + (root > 0.0 ? std::sqrt(root) : 0.0);
  return below > 0.0 && root >= 0.0 ? std::min(share, -c / below) : share;
}

/// What the equalities change. @returns the share of it up to which every point keeps to the laws
/// of contact, at most 1.
double ContactSolver::readChanges() {
  double share = 1.0;
  std::size_t row = 0;
  changes_.assign(points_.size(), Vector3::Zero());
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (kinds_[k] == Kind::kParts) continue;
    for (int i = 0; i < directionsOf(kinds_[k]); ++i) {
      changes_[k][i] = equalities_.rows()[row++].impulse - points_[k].lambda[i];
    }
    share = std::min(share, shareAllowed(points_[k], kinds_[k], changes_[k]));
  }
  return share;
}

/// Makes another kind of a point whose bound a change has met.
void ContactSolver::bind(std::size_t k, const Vector3& before, double share) {
  const double change = changes_[k].x();
  const bool parts = before.x() + change < 0.0 && before.x() <= share * -change;
  kinds_[k] = parts ? Kind::kParts : Kind::kSlides;
  if (parts) points_[k].lambda = Vector3::Zero();
}

/// Takes over the impulses up to where the first point would leave the laws of contact, which is
/// another kind of point from then on. @returns whether it was all of them.
bool ContactSolver::takeEqualities() {
  const double share = readChanges();
  const bool all = !(share < 1.0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (kinds_[k] == Kind::kParts) continue;
    Point& point = points_[k];
    const Vector3 before = point.lambda;
    const bool is_bound = !all && shareAllowed(point, kinds_[k], changes_[k]) <= share;
    point.lambda += share * changes_[k];
    if (is_bound) bind(k, before, share);
    apply(point, point.lambda - before);
  }
  return all;
}

/// Whether friction is within its bound.
bool ContactSolver::isHeld(const Point& point) {
  const double force =
      std::sqrt(point.lambda.y() * point.lambda.y() + point.lambda.z() * point.lambda.z());
  return point.friction > 0.0 && force <= kHeldShare * (point.friction * point.lambda.x());
}

void ContactSolver::keepImpulses() {
  kept_.clear();
  kept_twists_.clear();
  for (const Point& point : points_) kept_.push_back(point.lambda);
  for (const ContactBody& body : bodies_) kept_twists_.push_back(body.twist);
}

void ContactSolver::restoreImpulses() {
  for (std::size_t k = 0; k < points_.size(); ++k) points_[k].lambda = kept_[k];
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].twist = kept_twists_[i];
}

/// Solves all points at once, as what they are guessed to be, and mends the guess. @returns whether
/// it came to an end.
bool ContactSolver::leap(double tolerance) {
  keepImpulses();
  guessKinds(tolerance);
  for (int pass = 0; pass < kMaxLeapPasses; ++pass) {
    addEqualities();
    equalities_.solve();
    if (takeEqualities() && mendKinds(tolerance)) return true;
  }
  return false;
}

/// Leaps when it is time, or undoes a leap that was worth nothing. @param left m/s, what the last
/// sweep changed. @returns whether it did either.
bool ContactSolver::leapOrUndo(Leaps& leaps, double left, int sweeps, double above) {
  const bool was_worth_nothing = leaps.doubted > 0.0 && left > leaps.doubted;
  leaps.doubted = 0.0;
  if (was_worth_nothing) {
    restoreImpulses();
    return true;
  }
  if (!leaps.are_allowed || sweeps < leaps.next || !(left > above)) return false;
  if (!leap(above)) {
    leaps.doubted = left;
    leaps.wait *= 2;
    leaps.are_allowed = leaps.wait <= kLongestWait;
  }
  leaps.next = sweeps + leaps.wait;
  return true;
}

}  // namespace hovercraft
