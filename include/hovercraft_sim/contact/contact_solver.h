#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/contact/active_set_tolerances.h"
#include "hovercraft_sim/contact/equality_solver.h"
#include "hovercraft_sim/math/index.h"

namespace hovercraft {

/// A body as contacts see it. A fixed one has inverse mass and inertia 0; those of the planar model
/// are projected on (x, y, yaw). All in W.
struct ContactBody {
  Vector3 p_WB = Vector3::Zero();             // m, centre of mass
  Vector3 inverse_mass = Vector3::Zero();     // 1/kg, along each axis
  Matrix3 inverse_inertia = Matrix3::Zero();  // 1/(kg m²)
  Twist twist{Vector3::Zero(), Vector3::Zero()};
};

/// What is asked of one point of contact: B must leave A with at least `target` along the normal.
struct ContactConstraint {
  std::int32_t a = 0;  // index of a body
  std::int32_t b = 0;  // likewise
  Vector3 nhat_AB_W = Vector3::Zero();
  Vector3 p_WC = Vector3::Zero();   // m, where the impulse acts, on both
  double target = 0.0;              // m/s
  double friction = 0.0;            // (-); infinite: no slip
  bool bilateral = false;           // v_n = target and no slip, whatever the impulse
  Vector3 start = Vector3::Zero();  // N s, on B: the impulse to begin with
};

/// Impulses at many points at once: at each
///   0 <= lambda_n,  v_n >= target,  lambda_n (v_n - target) = 0
///   |lambda_t| <= mu lambda_n,  v_t = 0 or lambda_t against v_t at the bound
/// with v the velocity of B against A there, and twist' = twist + M⁻¹ Jᵀ lambda of every body. A
/// body takes and gives the same impulse at the same point, so that momentum and angular momentum
/// of a free pair stay.
///
/// Projected Gauss-Seidel sweeps in the order of the points, between which the search goes on as
/// conjugate gradients do (Silcowitz, Niebe and Erleben 2010, "A nonsmooth nonlinear conjugate
/// gradient method"): the sway of a stack of n bodies takes sweeps alone n⁴ of them. The last thing
/// is always a sweep, whose impulses obey the bounds. No allocation once it has grown to its
/// working size.
class ContactSolver {
 public:
  struct Limits {
    int sweeps = 0;          // at most
    int least_sweeps = 1;    // what it does in any case
    double tolerance = 0.0;  // m/s: done when no point changed by more in a sweep
    double active_set_above =
        std::numeric_limits<double>::infinity();  // m/s: a change beyond it is
                                                  // solved at once, where it can
  };

  /// Forgets all bodies and points.
  void clear();
  /// One that has no mobility and does not move is fixed, and its twist must stay 0. @returns its
  /// index.
  std::int32_t add(const ContactBody& body);
  /// Applies its starting impulse. @returns the index of the point.
  std::size_t add(const ContactConstraint& point);
  /// Forgets the points; bodies keep their twists.
  void clearPoints() { points_.clear(); }

  /// @returns the number of sweeps.
  int solve(const Limits& limits);

  /// In the order in which they were added; solve() changes their twists.
  std::vector<ContactBody>& bodies() { return bodies_; }
  /// The same.
  const std::vector<ContactBody>& bodies() const { return bodies_; }
  /// Of the points that were added since clear() or clearPoints().
  std::size_t pointCount() const { return points_.size(); }
  /// Velocity of B against A at a point, in W, m/s.
  Vector3 velocityAt(std::size_t point) const { return velocity(points_[point]); }
  /// Where it acts, m, in W.
  Vector3 positionOf(std::size_t point) const {
    const Point& solved = points_[point];
    return bodies_[at(solved.a)].p_WB + solved.r_a;
  }
  /// The speed that the impulse of a point took away there along the normal, m/s.
  double stoppedSpeed(std::size_t point) const {
    return points_[point].lambda.x() * points_[point].inverse_mass.x();
  }
  /// The impulse on B, N s, in W.
  Vector3 impulse(std::size_t point) const {
    return inWorld(points_[point], points_[point].lambda);
  }

 private:
  struct Point {
    std::int32_t a;
    std::int32_t b;
    Vector3 r_a;  // m, from the centre of mass
    Vector3 r_b;
    Vector3 directions[3];  // unit, in W: normal and two tangents
    Vector3 spin_a[3];      // rad/s per N s: what a unit impulse along each would turn A by
    Vector3 spin_b[3];
    Vector3 lambda;        // N s, along them, on B
    Vector3 inverse_mass;  // 1/kg: what a unit impulse along each does along itself
    double normal_to_s;    // 1/kg: ... along the normal does along the first tangent
    double normal_to_t;    // ... along the second
    double normal_mass;    // kg; 0 where neither body can move
    double stop_ss;        // kg: the impulse along the tangents that stops a slip along them
    double stop_st;
    double stop_tt;
    double slip_mass;  // kg, the least along any tangent
    double target;     // m/s
    double friction;
    bool bilateral;
    bool b_is_fixed;  // B needs no arithmetic: what it would add is 0
  };

  /// What a point is taken for in an active set.
  enum class State : std::uint8_t { kSeparating, kSliding, kSticking };

  /// Along how many directions it is given a velocity.
  static constexpr int directionsOf(State state) {
    return state == State::kSticking ? 3 : state == State::kSliding ? 1 : 0;
  }

  /// When to try an active set next.
  struct ActiveSets {
    bool are_tried = false;
    int wait = kSweepsBeforeActiveSet;  // sweeps between two
    int next = kSweepsBeforeActiveSet;  // the sweep after which the next is due
    double doubted = 0.0;               // m/s: what was left before one that came to no end
  };

  /// What a sweep changed.
  struct Change {
    double largest = 0.0;  // m/s, of the points
    double energy = 0.0;   // J
    bool any = false;      // some impulse
  };

  static Vector3 combined(const Vector3 (&vectors)[3], const Vector3& shares) {
    return (shares.x() * vectors[0] + shares.y() * vectors[1]) + shares.z() * vectors[2];
  }
  static Vector3 inWorld(const Point& point, const Vector3& along) {
    return combined(point.directions, along);
  }
  Vector3 velocity(const Point& point) const {
    const Twist& A = bodies_[at(point.a)].twist;
    const Twist& B = bodies_[at(point.b)].twist;
    if (point.b_is_fixed) return (B.v_WB - A.v_WB) - cross(A.w_WB, point.r_a);
    return (B.v_WB - A.v_WB) + (cross(B.w_WB, point.r_b) - cross(A.w_WB, point.r_a));
  }
  /// @param along N s, an impulse on B along the point's directions, and against A.
  void apply(const Point& point, const Vector3& along) {
    ContactBody& A = bodies_[at(point.a)];
    ContactBody& B = bodies_[at(point.b)];
    const Vector3 impulse = inWorld(point, along);
    A.twist.v_WB -= A.inverse_mass.cwiseProduct(impulse);
    A.twist.w_WB -= combined(point.spin_a, along);
    if (point.b_is_fixed) return;
    B.twist.v_WB += B.inverse_mass.cwiseProduct(impulse);
    B.twist.w_WB += combined(point.spin_b, along);
  }
  void turnPoint(Point& point, const Vector3& nhat_AB_W) const;
  Vector3 velocityAlong(const Point& point, int direction) const;
  static void weigh(Point& point, const Vector3 (&velocities)[3]);
  static void relaxTangents(Point& point, double v_s, double v_t);
  double relax(Point& point);
  Change sweep();
  void goOn(double share);
  bool canSolveActiveSet();
  bool solveActiveSet(double tolerance);
  double roundingOfActiveSets() const;
  void guessStates(double tolerance);
  void takeAway();
  void addEqualities();
  double readChanges();
  void bind(std::size_t k, const Vector3& before, double share);
  bool activeSetOrUndo(ActiveSets& sets, double left, int sweeps, double above);
  bool takeEqualities();
  bool mendStates(double tolerance);
  static bool isWithinCone(const Point& point);
  static double shareAllowed(const Point& point, State state, const Vector3& change);
  void keepImpulses();
  void restoreImpulses();

  std::vector<ContactBody> bodies_;
  std::vector<bool> is_fixed_;  // of each body
  std::vector<Point> points_;
  std::vector<Vector3> before_;  // N s: the impulses before the last sweep
  std::vector<Vector3> search_;  // N s
  EqualitySolver equalities_;
  std::vector<Vector3> changes_;    // N s, of the points in an active set
  std::vector<State> states_;       // of each point
  std::vector<Twist> held_twists_;  // of the bodies, while rows are made
  std::vector<Vector3> kept_;       // N s: the impulses before an active set
  std::vector<Twist> kept_twists_;  // of the bodies
};

}  // namespace hovercraft
