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
constexpr double kFastest = 1e6;      // m/s, rad/s: no craft is
constexpr double kLongestStep = 0.1;  // s: after a pause the law does not leap

Vector3 asVector(const PlanarVelocity& velocity) {
  return {velocity.u, velocity.v, velocity.r};
}

/// Of each rudder the index of its fan; of all others their own.
std::array<std::size_t, kMostActuators> fansOf(const VelocityPlant& plant) {
  demand(plant.actuators.size() <= kMostActuators, "an allocation has at most 11 actuators");
  std::array<std::size_t, kMostActuators> fans{};
  for (std::size_t i = 0; i < plant.actuators.size(); ++i) {
    fans[i] = i;
    for (std::size_t k = 0; k < plant.actuators.size(); ++k) {
      if (plant.actuators[k].name == plant.actuators[i].fan) fans[i] = k;
    }
  }
  return fans;
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
      fans_(fansOf(plant)),
      inertia_(plant.mass, plant.mass, plant.yaw_inertia) {
  const FloatingPointEnvironment environment;
  allocation_ = allocationAt({}, greatestForces());
  Vector3 span = Vector3::Zero();
  for (std::size_t i = 0; i < allocation_.count; ++i) {
    span += (allocation_.high[i] - allocation_.low[i]) * allocation_.columns[i].cwiseAbs();
  }
  for (int axis = 0; axis < 3; ++axis) {
    allocation_.weights[axis] = span[axis] > 0.0 ? 1.0 / span[axis] : 0.0;
  }
  controls_sway_ = canPushSideways(allocation_);
  allocation_.weights.z() *= kYawFirst;
  if (!controls_sway_) allocation_.weights.y() = 0.0;
  const double weight = std::max(allocation_.weights.x(), allocation_.weights.z());
  allocation_.effort = 1e-4 * weight;
}

/// What the actuators can make in a motion of B. @param forces of the fans, N.
AllocationProblem VelocityLaw::allocationAt(const PlanarVelocity& motion,
                                            const Thrusts& forces) const {
  AllocationProblem problem;
  problem.weights = allocation_.weights;
  problem.effort = allocation_.effort;
  problem.count = plant_.actuators.size();
  for (std::size_t i = 0; i < problem.count; ++i) {
    const PlantActuator& actuator = plant_.actuators[i];
    const ForceRange range = forceRange(actuator, actuator.speed(motion), forces[fans_[i]]);
    problem.columns[i] = actuator.column();
    problem.low[i] = range.low;
    problem.high[i] = range.high;
  }
  return problem;
}

/// At rest, N.
Thrusts VelocityLaw::greatestForces() const {
  Thrusts forces{};
  for (std::size_t i = 0; i < plant_.actuators.size(); ++i) {
    forces[i] = forceRange(plant_.actuators[i], 0.0, 0.0).high;
  }
  return forces;
}

Vector3 VelocityLaw::drag(const Vector3& velocity) const {
  const Vector3 slope =
      plant_.linear_drag + plant_.quadratic_drag.cwiseProduct(velocity.cwiseAbs());
  return slope.cwiseProduct(velocity);
}

Thrusts VelocityLaw::levels(const PlanarVelocity& command, const PlanarVelocity& measured,
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
    forces_ = Thrusts{};
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
  const PlanarVelocity motion = {now.x(), now.y(), now.z()};
  const AllocationProblem problem = allocationAt(motion, forces_);
  const Thrusts forces = allocate(problem, demanded);
  const Vector3 missing = wrenchOf(problem, forces) - demanded;
  reference_ += dt * (rate + missing.cwiseQuotient(inertia_));
  integral_ += dt * gains_.integral.cwiseProduct(error);
  Thrusts result{};
  for (std::size_t i = 0; i < problem.count; ++i) {
    const PlantActuator& actuator = plant_.actuators[i];
    result[i] = levelOf(actuator, forces[i], actuator.speed(motion), forces_[fans_[i]]);
  }
  forces_ = forces;
  return result;
}

namespace {

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

/// The rate of one axis at which its drag takes all that the actuators can give it, by bisection; 0
/// without drag.
double VelocityLaw::balance(int axis, double sign, const Vector3& held) const {
  constexpr int kHalvings = 60;
  if (plant_.linear_drag[axis] + plant_.quadratic_drag[axis] == 0.0) return 0.0;
  const Thrusts full = greatestForces();
  const auto is_kept = [&](double rate) {
    Vector3 motion = Vector3::Zero();
    motion[axis] = sign * rate;
    const AllocationProblem problem = allocationAt({motion.x(), motion.y(), motion.z()}, full);
    const double push = most(problem, axis, sign, held);
    return push > 0.0 && push >= sign * drag(motion)[axis];
  };
  double low = 0.0;
  double high = 1.0;
  while (is_kept(high) && high < kFastest) high *= 2.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (is_kept(middle) ? low : high) = middle;
  }
  return low;
}

double VelocityLaw::topSpeed(double sign) const {
  const FloatingPointEnvironment environment;
  return FloatingPointEnvironment::computed(
      balance(0, sign, {0.0, controls_sway_ ? 1e3 : 0.0, 1e3}));
}

double VelocityLaw::topYawRate(double sign) const {
  const FloatingPointEnvironment environment;
  return FloatingPointEnvironment::computed(balance(2, sign, Vector3::Zero()));
}

}  // namespace hovercraft
