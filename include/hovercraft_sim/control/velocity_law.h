#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hovercraft_sim/control/allocation.h"
#include "hovercraft_sim/control/plant_actuator.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// What a velocity controller knows of its craft, in the plane.
struct VelocityPlant {
  using Actuator = PlantActuator;

  double mass = 0.0;         // kg
  double yaw_inertia = 0.0;  // kg m²
  double center_x = 0.0;     // m, the centre of mass in H
  double center_y = 0.0;
  Vector3 linear_drag = Vector3::Zero();     // N s/m, N s/m, N m s: surge, sway, yaw
  Vector3 quadratic_drag = Vector3::Zero();  // N s²/m², N s²/m², N m s²
  std::vector<Actuator> actuators;           // at most kMostActuators
};

/// Of each axis: surge, sway, yaw.
struct VelocityGains {
  Vector3 response_time =
      Vector3::Zero();  // s: the reference follows the command by a first-order lag
  Vector3 proportional = Vector3::Zero();  // N s/m, N s/m, N m s
  Vector3 integral = Vector3::Zero();      // N/m, N/m, N m
};

/// By the parameters alone: the reference is four times as slow as the slowest thrust (0.1 s at
/// least), the error dies as fast as that, and the integral takes ten times as long.
/// @param thrust_lag s, the longest time constant of a thrust.
HOVERCRAFT_PUBLIC VelocityGains velocityGainsOf(const VelocityPlant& plant, double thrust_lag);

/// Follows a commanded velocity: a reference that the thrusts can follow, feed-forward of its
/// acceleration, of drag and of the turning axes, feedback on the error from the reference with an
/// integral, allocation of the wrench to thrusts within limits. What the thrusts cannot make, the
/// reference gives up: so the integral does not wind up. What an actuator can make depends on the
/// motion and, of a rudder, on the thrust of its fan at the call before.
class HOVERCRAFT_PUBLIC VelocityLaw {
 public:
  VelocityLaw(const VelocityPlant& plant, const VelocityGains& gains);

  /// Levels of all actuators: N, or what their kinds say. @param dt s since the last call; 0 at the
  /// first one.
  Thrusts levels(const PlanarVelocity& command, const PlanarVelocity& measured, double dt);

  /// Forgets reference and integral: the next call starts from what is measured then.
  void reset() { is_started_ = false; }

  /// Whether the actuators can push sideways without turning the craft: else v is left alone.
  bool controlsSway() const { return controls_sway_; }
  /// The greatest speed that the thrusts keep up against the drag without turning, m/s. @param sign
  /// 1: ahead, -1: astern.
  double topSpeed(double sign) const;
  /// The same of the yaw rate, whatever the thrusts do besides, rad/s. @param sign 1: to the left.
  double topYawRate(double sign) const;

 private:
  Vector3 drag(const Vector3& velocity) const;
  AllocationProblem allocationAt(const PlanarVelocity& motion, const Thrusts& forces) const;
  Thrusts greatestForces() const;
  double balance(int axis, double sign, const Vector3& held) const;

  VelocityPlant plant_;
  VelocityGains gains_;
  std::array<std::size_t, kMostActuators> fans_{};  // of each rudder, its index; else the own one
  AllocationProblem allocation_;                    // at rest, every fan at its most
  Thrusts forces_{};                                // N, of the call before
  Vector3 inertia_;                                 // kg, kg, kg m²
  bool controls_sway_ = false;
  bool is_started_ = false;
  Vector3 reference_;  // m/s, m/s, rad/s
  Vector3 integral_;   // N, N, N m
};

}  // namespace hovercraft
