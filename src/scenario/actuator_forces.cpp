#include "hovercraft_sim/scenario/actuator_forces.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "hovercraft_sim/math/constants.h"

namespace hovercraft {
namespace {

ForcePlace placeOf(const ActuatorScenario& actuator, const VehicleScenario& vehicle) {
  return {actuator.motion.p_HE - vehicle.mass_properties.p_HB, actuator.motion.direction};
}

FanForce fanOf(std::size_t id, const ActuatorScenario& fan, const VehicleScenario& vehicle) {
  return {id, placeOf(fan, vehicle), fan.free_speed > 0.0 ? 1.0 / fan.free_speed : 0.0};
}

PropellerForce propellerOf(std::size_t id, const ActuatorScenario& propeller,
                           const VehicleScenario& vehicle) {
  const double square = propeller.diameter * propeller.diameter;
  PropellerForce force;
  force.id = id;
  force.place = placeOf(propeller, vehicle);
  force.diameter = propeller.diameter;
  force.thrust_scale = propeller.air_density * (square * square);
  force.torque_scale = propeller.motion.rotor.turn * (force.thrust_scale * propeller.diameter);
  force.thrust_coefficients = propeller.thrust_coefficients;
  force.torque_coefficients = propeller.torque_coefficients;
  return force;
}

RudderForce rudderOf(std::size_t id, const ActuatorScenario& rudder,
                     const VehicleScenario& vehicle) {
  RudderForce force;
  force.id = id;
  force.place = placeOf(rudder, vehicle);
  force.across = cross(rudder.hinge, rudder.motion.direction);
  force.half_density_area = 0.5 * rudder.air_density * rudder.area;
  force.lift_slope = rudder.lift_slope;
  force.drag_at_rest = rudder.drag_at_rest;
  force.drag_growth = rudder.drag_growth;
  for (std::size_t i = 0; i < vehicle.actuators.size(); ++i) {
    const ActuatorScenario& fan = vehicle.actuators[i];
    if (fan.name != rudder.fan) continue;
    const std::size_t fan_id = kFirstActuator + i;
    if (fan.kind == ActuatorKind::kFan) force.fan = fanOf(fan_id, fan, vehicle);
    if (fan.kind == ActuatorKind::kPropeller) force.fan = propellerOf(fan_id, fan, vehicle);
    const double disc = 0.25 * kPi * rudder.diameter * rudder.diameter;
    force.inverse_density_disc = 1.0 / (rudder.air_density * disc);
  }
  return force;
}

}  // namespace

std::vector<Force> forcesOf(const VehicleScenario& vehicle) {
  std::vector<Force> forces;
  forces.reserve(vehicle.drag_laws.size() + vehicle.actuators.size());
  for (const DragLaw& law : vehicle.drag_laws) forces.emplace_back(DragForce{law});
  for (std::size_t i = 0; i < vehicle.actuators.size(); ++i) {
    const ActuatorScenario& actuator = vehicle.actuators[i];
    const std::size_t id = kFirstActuator + i;
    switch (actuator.kind) {
      case ActuatorKind::kFan:
        forces.emplace_back(fanOf(id, actuator, vehicle));
        break;
      case ActuatorKind::kPropeller:
        forces.emplace_back(propellerOf(id, actuator, vehicle));
        break;
      case ActuatorKind::kRudder:
        forces.emplace_back(rudderOf(id, actuator, vehicle));
        break;
      case ActuatorKind::kLiftFan:
        break;
    }
  }
  return forces;
}

std::vector<Rotor> rotorsOf(const VehicleScenario& vehicle) {
  std::vector<Rotor> rotors;
  const auto add = [&](std::size_t id, const EngineParameters& actuator, bool is_thrust) {
    const RotorParameters& spins = actuator.rotor;
    const double limit = std::max(-actuator.min_thrust, actuator.max_thrust);
    if (!(spins.inertia > 0.0) || !(limit > 0.0)) return;
    const double momentum = spins.inertia * spins.speed;
    rotors.push_back({id, is_thrust,
                      spins.turn * (is_thrust ? momentum / std::sqrt(limit) : momentum),
                      is_thrust ? momentum : momentum * limit, actuator.direction});
  };
  for (std::size_t id = 0; id < vehicle.engines.size(); ++id) add(id, vehicle.engines[id], true);
  for (std::size_t i = 0; i < vehicle.actuators.size(); ++i) {
    const ActuatorScenario& actuator = vehicle.actuators[i];
    add(kFirstActuator + i, actuator.motion, actuator.kind == ActuatorKind::kFan);
  }
  return rotors;
}

std::vector<FanDrive> fanDrivesOf(const VehicleScenario& vehicle) {
  std::vector<FanDrive> drives;
  if (!vehicle.cushion) return drives;
  const std::vector<CushionFan>& fans = vehicle.cushion->fans;
  for (std::size_t fan = 0; fan < fans.size(); ++fan) {
    for (std::size_t i = 0; i < vehicle.actuators.size(); ++i) {
      if (fans[fan].lift_fan != vehicle.actuators[i].name) continue;
      drives.push_back({fan, kFirstActuator + i});
    }
  }
  return drives;
}

}  // namespace hovercraft
