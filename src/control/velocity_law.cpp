#include "hovercraft_sim/control/velocity_law.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

constexpr double kReferencePerLag = 4.0;   // a second-order loop of this ratio does not overshoot
constexpr double kFastestReference = 0.1;  // s: some ten samples of a controller
constexpr double kIntegralTimes = 10.0;    // slower than the error
// An error of yaw counts so much more than one of speed of the same share: it is made first.
constexpr double kYawFirst = 100.0;
constexpr double kLongestStep = 0.1;  // s: after a pause the law does not leap

Vector3 asVector(const PlanarVelocity& velocity) {
  return {velocity.u, velocity.v, velocity.r};
}

AllocationProblem allocationOf(const VelocityPlant& plant) {
  demand(plant.actuators.size() <= kMostActuators, "an allocation has at most 8 actuators");
  AllocationProblem problem;
  problem.count = plant.actuators.size();
  Vector3 span = Vector3::Zero();
  for (std::size_t i = 0; i < problem.count; ++i) {
    const VelocityPlant::Actuator& a = plant.actuators[i];
    problem.columns[i] = {a.direction_x, a.direction_y, a.x * a.direction_y - a.y * a.direction_x};
    problem.low[i] = a.min_thrust;
    problem.high[i] = a.max_thrust;
    span += (a.max_thrust - a.min_thrust) * problem.columns[i].cwiseAbs();
  }
  for (int axis = 0; axis < 3; ++axis) {
    problem.weights[axis] = span[axis] > 0.0 ? 1.0 / span[axis] : 0.0;
  }
  return problem;
}

/// Whether a push to either side can be made alone.
bool canPushSideways(const AllocationProblem& problem) {
  constexpr double kShare = 0.02;   // of all that pushes sideways
  constexpr double kMissing = 0.1;  // of that push
  if (problem.weights.y() == 0.0) return false;
  for (const double sign : {-1.0, 1.0}) {
    const Vector3 push(0.0, sign * kShare / problem.weights.y(), 0.0);
    const Vector3 error = wrenchOf(problem, allocate(problem, push)) - push;
    if (norm(error.cwiseProduct(problem.weights)) > kMissing * kShare) return false;
  }
  return true;
}

}  // namespace

VelocityGains velocityGainsOf(const VelocityPlant& plant, double thrust_lag) {
  const FloatingPointEnvironment environment;
  const double response = std::max(kFastestReference, kReferencePerLag * thrust_lag);
  const Vector3 inertia(plant.mass, plant.mass, plant.yaw_inertia);
  VelocityGains gains;
  gains.response_time = Vector3::Constant(response);
  gains.proportional = inertia / response;
  gains.integral = gains.proportional / (kIntegralTimes * response);
  return gains;
}

VelocityLaw::VelocityLaw(const VelocityPlant& plant, const VelocityGains& gains)
    : plant_(plant),
      gains_(gains),
      allocation_(allocationOf(plant)),
      inertia_(plant.mass, plant.mass, plant.yaw_inertia),
      controls_sway_(canPushSideways(allocation_)) {
  allocation_.weights.z() *= kYawFirst;
  if (!controls_sway_) allocation_.weights.y() = 0.0;
  const double weight = std::max(allocation_.weights.x(), allocation_.weights.z());
  allocation_.effort = 1e-4 * weight;
}

Vector3 VelocityLaw::drag(const Vector3& velocity) const {
  const Vector3 slope =
      plant_.linear_drag + plant_.quadratic_drag.cwiseProduct(velocity.cwiseAbs());
  return slope.cwiseProduct(velocity);
}

Thrusts VelocityLaw::thrusts(const PlanarVelocity& command, const PlanarVelocity& measured,
                             double dt) {
  const FloatingPointEnvironment environment;
  dt = std::clamp(dt, 0.0, kLongestStep);
  // The law is about the centre of mass.
  Vector3 now = asVector(measured);
  now.x() -= now.z() * plant_.center_y;
  now.y() += now.z() * plant_.center_x;
  Vector3 wanted = asVector(command);
  wanted.x() -= wanted.z() * plant_.center_y;
  wanted.y() += wanted.z() * plant_.center_x;
  if (!is_started_) {
    reference_ = now;
    integral_ = Vector3::Zero();
    is_started_ = true;
  }
  if (!controls_sway_) wanted.y() = reference_.y() = now.y();

  const Vector3 error = reference_ - now;
  const Vector3 rate = (wanted - reference_).cwiseQuotient(gains_.response_time);
  // In axes that turn, m (du/dt - v r) and m (dv/dt + u r) are the forces.
  const Vector3 turning = plant_.mass * Vector3(-now.y() * now.z(), now.x() * now.z(), 0.0);
  const Vector3 kept = drag(reference_) + turning;
  const Vector3 feedback = gains_.proportional.cwiseProduct(error) + integral_;
  const Vector3 demanded = inertia_.cwiseProduct(rate) + kept + feedback;
  const Thrusts result = allocate(allocation_, demanded);
  const Vector3 missing = wrenchOf(allocation_, result) - demanded;
  reference_ += dt * (rate + missing.cwiseQuotient(inertia_));
  integral_ += dt * gains_.integral.cwiseProduct(error);
  return result;
}

namespace {

/// The speed x at which first x + second |x| x is the force.
double balance(double force, double first, double second) {
  if (!(force > 0.0)) return 0.0;
  if (second > 0.0) {
    return (std::sqrt(first * first + 4.0 * second * force) - first) / (2.0 * second);
  }
  return first > 0.0 ? force / first : 0.0;
}

/// The most of one axis of the wrench that the thrusts give; the others as they come, but for those
/// that `held` weighs.
double most(AllocationProblem problem, int axis, double sign, const Vector3& held) {
  double span = 0.0;
  for (std::size_t i = 0; i < problem.count; ++i) {
    span += std::max(std::abs(problem.low[i]), std::abs(problem.high[i])) *
            std::abs(problem.columns[i][axis]);
  }
  problem.weights = held;
  problem.weights[axis] = 1.0;
  problem.effort = 1e-6;
  Vector3 wrench = Vector3::Zero();
  wrench[axis] = sign * span;
  return sign * wrenchOf(problem, allocate(problem, wrench))[axis];
}

}  // namespace

double VelocityLaw::topSpeed(double sign) const {
  const Vector3 straight(0.0, controls_sway_ ? 1e3 : 0.0, 1e3);
  return balance(most(allocation_, 0, sign, straight), plant_.linear_drag.x(),
                 plant_.quadratic_drag.x());
}

double VelocityLaw::topYawRate(double sign) const {
  return balance(most(allocation_, 2, sign, Vector3::Zero()), plant_.linear_drag.z(),
                 plant_.quadratic_drag.z());
}

}  // namespace hovercraft
