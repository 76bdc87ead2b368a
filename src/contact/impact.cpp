#include "hovercraft_sim/contact/impact.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/contact/active_set_tolerances.h"
#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/math/index.h"

namespace hovercraft {
namespace {

Vector3 velocityAt(const ContactSolver& solver, const ImpactPoint& point) {
  const ContactBody& A = solver.bodies()[at(point.a)];
  const ContactBody& B = solver.bodies()[at(point.b)];
  return velocityOfPoint(B.twist, point.p_WC, B.p_WB) -
         velocityOfPoint(A.twist, point.p_WC, A.p_WB);
}

/// m/s, of the approach that bounces.
double bouncingSpeed(const ImpactPoint& point, double speed) {
  return std::max(0.0, -speed - point.gain);
}

double restitutionOf(const ImpactPoint& point, double speed) {
  const bool is_slow = bouncingSpeed(point, speed) < point.plastic_speed;
  return point.material.stick || is_slow ? 0.0 : point.material.restitution;
}

/// The largest speed of any point, m/s: what rounding is measured against.
double scaleOf(const ContactSolver& solver, const std::vector<ImpactPoint>& points) {
  double scale = 0.0;
  for (const ImpactPoint& point : points) {
    for (const std::int32_t index : {point.a, point.b}) {
      const ContactBody& body = solver.bodies()[at(index)];
      scale = std::max(
          scale, norm(body.twist.v_WB) + norm(body.twist.w_WB) * norm(point.p_WC - body.p_WB));
    }
  }
  return scale;
}

/// Whether nothing can bounce and nothing sticks: points that part need not be left out then.
bool isPlastic(const std::vector<ImpactPoint>& points) {
  return std::none_of(points.begin(), points.end(), [](const ImpactPoint& point) {
    return point.material.stick || point.material.restitution > 0.0;
  });
}

bool hasFriction(const std::vector<ImpactPoint>& points) {
  return std::any_of(points.begin(), points.end(), [](const ImpactPoint& point) {
    return point.material.stick || point.material.friction > 0.0;
  });
}

}  // namespace

/// One simultaneous solve. @param share of each restitution. @returns whether it added energy, by
/// more than rounding.
bool ImpactSolver::roundOf(ContactSolver& solver, std::vector<ImpactPoint>& points, double share,
                           Round kind) {
  const bool all_plastic = kind != Round::kUsual;
  const bool frictionless = kind == Round::kPlasticWithoutFriction;
  const double scale = scaleOf(solver, points);
  solver.clearPoints();
  chosen_.clear();
  before_.clear();
  speeds_.clear();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ImpactPoint& point = points[i];
    const Vector3 v = velocityAt(solver, point);
    const double speed = dot(point.nhat_AB_W, v);
    speeds_.push_back(speed);
    if (!all_plastic && speed > kStandingPoint * scale) continue;
    ContactConstraint constraint;
    constraint.a = point.a;
    constraint.b = point.b;
    constraint.nhat_AB_W = point.nhat_AB_W;
    constraint.p_WC = point.p_WC;
    constraint.target =
        all_plastic ? 0.0 : share * restitutionOf(point, speed) * bouncingSpeed(point, speed);
    constraint.friction = frictionless ? 0.0 : point.material.friction;
    constraint.bilateral = point.material.stick && !frictionless;
    chosen_.push_back(i);
    before_.push_back(v);
    solver.add(constraint);
  }
  const auto count = static_cast<int>(chosen_.size());
  const double left_over = std::max(residual_ * scale, kLeftResidual * may_leave_);
  solver.solve({std::max(kMinImpactSweeps, kMaxImpactRelaxations / std::max(1, count)), 1,
                left_over, std::max(kActiveSetPrecision * scale, left_over)});
  double gained = 0.0;
  double rounding = 0.0;
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    const Vector3 impulse = solver.impulse(k);
    gained += 0.5 * dot(impulse, Vector3(before_[k] + solver.velocityAt(k)));
    rounding += kGainRounding * scale * norm(impulse);
  }
  return gained > rounding;
}

void ImpactSolver::take(const ContactSolver& solver, std::vector<ImpactPoint>& points,
                        bool restitutes) {
  for (std::size_t k = 0; k < chosen_.size(); ++k) {
    ImpactPoint& point = points[chosen_[k]];
    const Vector3 impulse = solver.impulse(k);
    point.impulse += impulse;
    // A point that parted got an impulse because others would have made it approach.
    const double speed = speeds_[chosen_[k]];
    const double approach = speed > 0.0 ? solver.stoppedSpeed(k) : -speed;
    point.approach = std::max(point.approach, approach);
    if (restitutes && dot(impulse, point.nhat_AB_W) > 0.0 && approach > 0.0 &&
        restitutionOf(point, -approach) > 0.0) {
      point.bounced = true;
    }
  }
}

/// A round, with as much of its restitution as does not add energy.
void ImpactSolver::roundWithoutGain(ContactSolver& solver, std::vector<ImpactPoint>& points,
                                    Round kind) {
  const bool can_gain = hasFriction(points);
  twists_.clear();
  for (const ContactBody& body : solver.bodies()) twists_.push_back(body.twist);
  double share = 1.0;
  for (int halved = 0; roundOf(solver, points, share, kind); ++halved) {
    if (!can_gain || kind != Round::kUsual || !(share > 0.0)) break;
    for (std::size_t i = 0; i < twists_.size(); ++i) solver.bodies()[i].twist = twists_[i];
    share = halved < kMaxHalvedRestitutions ? 0.5 * share : 0.0;
  }
  take(solver, points, kind == Round::kUsual && share > 0.0);
}

bool ImpactSolver::isApproaching(const ContactSolver& solver,
                                 const std::vector<ImpactPoint>& points) const {
  const double standing = std::max(kStandingPoint, kUnsolvedApproach * residual_);
  const double tolerance = std::max(standing * scaleOf(solver, points), may_leave_);
  return std::any_of(points.begin(), points.end(), [&](const ImpactPoint& point) {
    return dot(point.nhat_AB_W, velocityAt(solver, point)) < -tolerance;
  });
}

void ImpactSolver::resolve(ContactSolver& solver, std::vector<ImpactPoint>& points,
                           double may_leave) {
  const bool is_plastic = isPlastic(points);
  const bool is_crowd = points.size() >= kCrowd;
  residual_ = is_crowd && !is_plastic && hasFriction(points) ? kCrowdResidual : kImpactResidual;
  may_leave_ = is_plastic && is_crowd ? may_leave : 0.0;
  for (int round = 0; round <= kMaxImpactRounds + 1; ++round) {
    if (!isApproaching(solver, points)) return;
    const Round kind = round > kMaxImpactRounds                  ? Round::kPlasticWithoutFriction
                       : round == kMaxImpactRounds || is_plastic ? Round::kPlastic
                                                                 : Round::kUsual;
    roundWithoutGain(solver, points, kind);
  }
}

}  // namespace hovercraft
