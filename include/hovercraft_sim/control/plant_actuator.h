#pragma once

#include <cstddef>
#include <string>

#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Velocities of base_link in its own axes: surge u and sway v, m/s; yaw rate r, rad/s.
struct PlanarVelocity {
  double u = 0.0;
  double v = 0.0;
  double r = 0.0;
};

/// An actuator as its craft's velocity controller knows it, in the plane and without its lag: the
/// force at its place that a level makes, by the equations of the simulation (doc/craft.md).
struct PlantActuator {
  /// What its level is: N at rest of a fan or engine, 1/s of a propeller, rad of a rudder.
  enum class Kind { kThrust, kPropeller, kRudder };

  std::string name;
  Kind kind = Kind::kThrust;
  double x = 0.0;  // m, from the centre of mass, in B
  double y = 0.0;
  double direction_x = 1.0;  // of positive thrust; of a rudder, that of its fan
  double direction_y = 0.0;
  double min_thrust = 0.0;  // of the level
  double max_thrust = 0.0;

  double free_speed = 0.0;                        // m/s, of a fan; 0: its thrust does not fall
  double air_density = 0.0;                       // kg/m³, of propeller and rudder
  double diameter = 0.0;                          // m; of a rudder that of its fan's disc
  Vector3 thrust_coefficients = Vector3::Zero();  // of a propeller: k0 > 0, k1, k2
  double across_x = 0.0;                          // of a rudder: of the force of a positive angle
  double across_y = 1.0;
  double area = 0.0;        // m²
  double lift_slope = 0.0;  // 1/rad
  std::string fan;          // in whose slipstream; empty: none

  /// The wrench (F_x, F_y, M_z) of 1 N.
  Vector3 column() const;
  /// Velocity of its place along its direction, m/s, in still air. @param motion of B.
  double speed(const PlanarVelocity& motion) const;
};

/// What a level can make at one moment.
struct ForceRange {
  double low = 0.0;  // N
  double high = 0.0;
};

/// @param speed of PlantActuator. @param fan_thrust N, of the fan of a rudder; else unused.
/// @returns limits around 0.
ForceRange forceRange(const PlantActuator& actuator, double speed, double fan_thrust);

/// The level, within its limits, that makes a force within forceRange() of the same arguments.
double levelOf(const PlantActuator& actuator, double force, double speed, double fan_thrust);

}  // namespace hovercraft
