#include <algorithm>
#include <cmath>

#include "hovercraft_sim/contact/contact_solver.h"

/// Active sets of the solver of contacts: points whose state the sweeps have found out, solved at
/// once (Silcowitz, Niebe and Erleben 2010, "Projected Gauss-Seidel subspace minimization method
/// for interactive rigid body dynamics").

namespace hovercraft {

bool ContactSolver::canSolveActiveSet() {
  const auto moving = std::count(is_fixed_.begin(), is_fixed_.end(), false);
  if (moving < kLeastActiveBodies) return false;
  equalities_.clear();
  for (const ContactBody& body : bodies_)
    equalities_.add({body.inverse_mass, body.inverse_inertia});
  for (const Point& point : points_) {
    equalities_.add({point.a, point.b, point.directions[0], point.r_a, point.r_b});
  }
  return equalities_.order() <= kMostActiveSetWork * points_.size();
}

/// What the points are, by the impulses and velocities that the sweeps have left.
void ContactSolver::guessStates(double tolerance) {
  states_.assign(points_.size(), State::kSeparating);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    const bool is_pressed = point.lambda.x() > 0.0 ||
                            dot(point.directions[0], velocity(point)) < point.target - tolerance;
    if (!point.bilateral && !is_pressed) continue;
    states_[k] = point.bilateral || isWithinCone(point) ? State::kSticking : State::kSliding;
  }
}

/// Takes away what the points may push in their states.
void ContactSolver::takeAway() {
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Vector3& lambda = points_[k].lambda;
    if (states_[k] == State::kSticking) apply(points_[k], -lambda);
    if (states_[k] == State::kSliding) apply(points_[k], Vector3(-lambda.x(), 0.0, 0.0));
  }
}

/// Asks each point for the velocity that its state has, from where it would be without what it may
/// push in it: of all impulses that do it the least are found, as nothing is left of those that
/// push against each other.
void ContactSolver::addEqualities() {
  held_twists_.clear();
  for (const ContactBody& body : bodies_) held_twists_.push_back(body.twist);
  takeAway();
  equalities_.clearRows();
  for (std::size_t k = 0; k < points_.size(); ++k) {
    const Point& point = points_[k];
    const Vector3 v = velocity(point);
    for (int i = 0; i < directionsOf(states_[k]); ++i) {
      const double wanted = (i == 0 ? point.target : 0.0) - dot(point.directions[i], v);
      equalities_.add({point.a, point.b, point.directions[i], point.r_a, point.r_b, wanted});
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) bodies_[i].twist = held_twists_[i];
}

/// The share of a change up to which a point keeps to the laws of contact; more than 1: all of it.
double ContactSolver::shareAllowed(const Point& point, State state, const Vector3& change) {
  constexpr double kAll = 2.0;
  if (point.bilateral) return kAll;
  double share = kAll;
  if (point.lambda.x() + change.x() < 0.0) share = point.lambda.x() / -change.x();
  if (state != State::kSticking || std::isinf(point.friction)) return share;
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
    if (states_[k] == State::kSeparating) continue;
    for (int i = 0; i < directionsOf(states_[k]); ++i) {
      changes_[k][i] = equalities_.rows()[row++].impulse - points_[k].lambda[i];
    }
    share = std::min(share, shareAllowed(points_[k], states_[k], changes_[k]));
  }
  return share;
}

/// Changes the state of a point whose bound a change has met.
void ContactSolver::bind(std::size_t k, const Vector3& before, double share) {
  const double change = changes_[k].x();
  const bool parts = before.x() + change < 0.0 && before.x() <= share * -change;
  states_[k] = parts ? State::kSeparating : State::kSliding;
  if (parts) points_[k].lambda = Vector3::Zero();
}

/// Takes over the impulses up to where the first point would leave the laws of contact, which is
/// in another state from then on. @returns whether it was all of them.
bool ContactSolver::takeEqualities() {
  const double share = readChanges();
  const bool all = !(share < 1.0);
  for (std::size_t k = 0; k < points_.size(); ++k) {
    if (states_[k] == State::kSeparating) continue;
    Point& point = points_[k];
    const Vector3 before = point.lambda;
    const bool is_bound = !all && shareAllowed(point, states_[k], changes_[k]) <= share;
    point.lambda += share * changes_[k];
    if (is_bound) bind(k, before, share);
    apply(point, point.lambda - before);
  }
  return all;
}

/// Whether friction is within its bound.
bool ContactSolver::isWithinCone(const Point& point) {
  const double force =
      std::sqrt(point.lambda.y() * point.lambda.y() + point.lambda.z() * point.lambda.z());
  return point.friction > 0.0 && force <= kStuckShare * (point.friction * point.lambda.x());
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
bool ContactSolver::solveActiveSet(double tolerance) {
  keepImpulses();
  guessStates(tolerance);
  for (int pass = 0; pass < kMaxActiveSets; ++pass) {
    addEqualities();
    equalities_.solve();
    if (takeEqualities() && mendStates(tolerance)) return true;
  }
  return false;
}

/// What an active set leaves of the velocities that its points stop, m/s.
double ContactSolver::roundingOfActiveSets() const {
  double fastest = 0.0;
  for (const Point& point : points_) {
    fastest = std::max(fastest, point.lambda.x() * point.inverse_mass.x());
  }
  return kActiveSetRounding * fastest;
}

/// Solves an active set when it is time, or undoes one that was worth nothing. @param left m/s,
/// what the last sweep changed. @returns whether it did either.
bool ContactSolver::activeSetOrUndo(ActiveSets& sets, double left, int sweeps, double above) {
  const bool was_worth_nothing = sets.doubted > 0.0 && left > sets.doubted;
  sets.doubted = 0.0;
  if (was_worth_nothing) {
    restoreImpulses();
    return true;
  }
  if (!sets.are_tried || sweeps < sets.next || !(left > above)) return false;
  if (!solveActiveSet(above)) {
    sets.doubted = left;
    sets.wait *= 2;
    sets.are_tried = sets.wait <= kLongestWait;
  }
  sets.next = sweeps + sets.wait;
  return true;
}

}  // namespace hovercraft
