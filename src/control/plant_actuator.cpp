#include "hovercraft_sim/control/plant_actuator.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/constants.h"

namespace hovercraft {
namespace {

/// T/T0 of a fan whose thrust is in the sense of `sign`.
double fanShare(const PlantActuator& fan, double speed, double sign) {
  if (!(fan.free_speed > 0.0)) return 1.0;
  return std::max(0.0, 1.0 - sign * speed / fan.free_speed);
}

/// N of a propeller per k n².
double thrustScale(const PlantActuator& propeller) {
  const double square = propeller.diameter * propeller.diameter;
  return propeller.air_density * (square * square);
}

double propellerThrust(const PlantActuator& propeller, double n, double speed) {
  const Vector3& k = propeller.thrust_coefficients;
  const double v = speed / propeller.diameter;
  return thrustScale(propeller) *
         (k[0] * n * std::abs(n) + k[1] * std::abs(n) * v + k[2] * v * std::abs(v));
}

/// The speed n of the greater root of k0 n|n| + k1 |n| v + k2 v|v| = T/scale, of the sign of T; 0
/// where the stream alone makes as much.
double propellerSpeed(const PlantActuator& propeller, double force, double speed) {
  if (force == 0.0) return 0.0;
  const double sign = force > 0.0 ? 1.0 : -1.0;
  const Vector3& k = propeller.thrust_coefficients;
  const double v = speed / propeller.diameter;
  const double b = sign * k[1] * v;
  const double rest = sign * (k[2] * v * std::abs(v) - force / thrustScale(propeller));
  const double root = b * b - 4.0 * k[0] * rest;
  if (!(root > 0.0)) return 0.0;
  return sign * std::max(0.0, (std::sqrt(root) - b) / (2.0 * k[0]));
}

/// N per rad of a rudder: its lift in the stream behind its disc.
double rudderSlope(const PlantActuator& rudder, double speed, double fan_thrust) {
  const double half = 0.5 * speed;
  double stream = std::max(0.0, speed);
  if (!rudder.fan.empty()) {
    const double disc = 0.25 * kPi * rudder.diameter * rudder.diameter;
    const double induced = std::max(0.0, fan_thrust) / (rudder.air_density * disc);
    stream = std::max(0.0, half + std::sqrt(half * half + induced));
  }
  return 0.5 * rudder.air_density * rudder.area * rudder.lift_slope * (stream * stream);
}

}  // namespace

Vector3 PlantActuator::column() const {
  const bool is_rudder = kind == Kind::kRudder;
  const double along_x = is_rudder ? across_x : direction_x;
  const double along_y = is_rudder ? across_y : direction_y;
  return {along_x, along_y, x * along_y - y * along_x};
}

double PlantActuator::speed(const PlanarVelocity& motion) const {
  return direction_x * (motion.u - motion.r * y) + direction_y * (motion.v + motion.r * x);
}

ForceRange forceRange(const PlantActuator& actuator, double speed, double fan_thrust) {
  switch (actuator.kind) {
    case PlantActuator::Kind::kPropeller:
      return {std::min(0.0, propellerThrust(actuator, actuator.min_thrust, speed)),
              std::max(0.0, propellerThrust(actuator, actuator.max_thrust, speed))};
    case PlantActuator::Kind::kRudder: {
      const double slope = rudderSlope(actuator, speed, fan_thrust);
      return {slope * actuator.min_thrust, slope * actuator.max_thrust};
    }
    case PlantActuator::Kind::kThrust:
      break;
  }
  return {actuator.min_thrust * fanShare(actuator, speed, -1.0),
          actuator.max_thrust * fanShare(actuator, speed, 1.0)};
}

double levelOf(const PlantActuator& actuator, double force, double speed, double fan_thrust) {
  double level = 0.0;
  if (actuator.kind == PlantActuator::Kind::kPropeller) {
    level = propellerSpeed(actuator, force, speed);
  } else {
    const double scale = actuator.kind == PlantActuator::Kind::kRudder
                             ? rudderSlope(actuator, speed, fan_thrust)
                             : fanShare(actuator, speed, force < 0.0 ? -1.0 : 1.0);
    if (scale > 0.0) level = force / scale;
  }
  return std::clamp(level, actuator.min_thrust, actuator.max_thrust);
}

}  // namespace hovercraft
