#pragma once

#include <vector>

#include "hovercraft_sim/contact/contact_solver.h"
#include "hovercraft_sim/contact/material.h"

namespace hovercraft {

/// A point of contact in an impact.
struct ImpactPoint {
  std::int32_t a = 0;                   // index of a body of the solver
  std::int32_t b = 0;                   // likewise
  Vector3 nhat_AB_W = Vector3::Zero();  // unit, from A to B, in W
  Vector3 p_WC = Vector3::Zero();       // m
  ContactMaterial material;             // of the pair
  double plastic_speed = 0.0;           // m/s: an approach slower than this does not bounce
  double gain = 0.0;                    // m/s: of an approach, what does not bounce
  // Written:
  Vector3 impulse = Vector3::Zero();  // N s, on B
  double approach = 0.0;              // m/s, the fastest that was stopped here
  bool bounced = false;               // some of it with restitution
};

/// Impulses of all points that touch at one moment.
///
/// A round takes the points that approach or stand still and asks of each for v_n' >= -e v_n
/// (Newton), lambda_n >= 0, one of both with equality, and Coulomb friction; points that part are
/// left out of it. Rounds follow while some point approaches. With e = 1 and no friction each keeps
/// the kinetic energy, as lambda_n (v_n' + v_n) = 0 at each point; with e < 1 it loses the sum of
/// (1 - e) lambda_n |v_n| / 2. With friction Newton's law can create energy (Kane 1984); the
/// restitution of such a round is halved until it does not. Points that stick leave a round with no
/// relative velocity at all. Where nothing can bounce and nothing sticks, one round over all points
/// is the impact: the nearest velocities, as kinetic energy measures it, that approach nowhere.
/// After kMaxImpactRounds such a round ends the approach, and if friction keeps it from that, one
/// without friction: projections, which never gain.
class ImpactSolver {
 public:
  /// @param solver its bodies, whose twists are changed; its points are overwritten.
  /// @param may_leave m/s, approach that may be left in a crowd (kCrowd) in which nothing bounces.
  void resolve(ContactSolver& solver, std::vector<ImpactPoint>& points, double may_leave = 0.0);

 private:
  enum class Round { kUsual, kPlastic, kPlasticWithoutFriction };

  bool roundOf(ContactSolver& solver, std::vector<ImpactPoint>& points, double share, Round kind);
  void roundWithoutGain(ContactSolver& solver, std::vector<ImpactPoint>& points, Round kind);
  bool isApproaching(const ContactSolver& solver, const std::vector<ImpactPoint>& points) const;
  void take(const ContactSolver& solver, std::vector<ImpactPoint>& points, bool restitutes);

  double residual_ = 0.0;            // (-) of the fastest point
  double may_leave_ = 0.0;           // m/s
  std::vector<std::size_t> chosen_;  // indices of points
  std::vector<Vector3> before_;      // m/s, velocities of the chosen
  std::vector<double> speeds_;       // m/s, along the normal, of all points
  std::vector<Twist> twists_;
};

}  // namespace hovercraft
