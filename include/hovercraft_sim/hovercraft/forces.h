#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>
#include <vector>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/hovercraft/actuator_array.h"
#include "hovercraft_sim/hovercraft/drag_laws.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

/// The forces of actuators besides the three engines, and of laws of drag. Each is a value that
/// takes what holds at a stage of a step and gives a wrench about the centre of mass in B: + - * /
/// and sqrt only, no memory. All places and directions are in B.

namespace hovercraft {

/// What a force may depend on, besides constants.
struct ForceInputs {
  const ActuatorArray<double>& levels;  // of all actuators: N, or what their kinds say
  Vector3 u_B;                          // velocity of the centre of mass relative to the air, m/s
  Vector3 w_WB_B;                       // rad/s
};

/// Where an actuator sits.
struct ForcePlace {
  Vector3 p_BE = Vector3::Zero();        // m
  Vector3 direction = Vector3::UnitX();  // unit vector of positive thrust

  /// Velocity of the place relative to the air along the direction, m/s.
  double airSpeed(const ForceInputs& inputs) const {
    return dot(inputs.u_B + cross(inputs.w_WB_B, p_BE), direction);
  }
  /// At the place, N.
  Wrench wrench(const Vector3& force) const { return {force, cross(p_BE, force)}; }
};

/// A fan whose thrust falls with the speed of the air into its disc: T = T0 max(0, 1 - V/V0), and
/// of a thrust backwards 1 + V/V0.
struct FanForce {
  std::size_t id = 0;               // its level is the thrust at rest T0, N
  ForcePlace place;                 // of its disc
  double inverse_free_speed = 0.0;  // 1/V0, s/m; 0: the thrust does not fall

  /// N, along its direction.
  double thrust(const ForceInputs& inputs) const {
    const double at_rest = inputs.levels[id];
    const double share = place.airSpeed(inputs) * inverse_free_speed;
    return at_rest * std::max(0.0, at_rest < 0.0 ? 1.0 + share : 1.0 - share);
  }
  /// In B.
  Wrench wrench(const ForceInputs& inputs) const {
    return place.wrench(thrust(inputs) * place.direction);
  }
};

/// A propeller or ducted fan by its advance ratio J = V/(n D): T = rho D^4 (k0 n|n| + k1 |n| V/D +
/// k2 V|V|/D^2), finite at n = 0; its torque Q of the same form, times D, turns the hull against
/// its sense of rotation.
struct PropellerForce {
  std::size_t id = 0;         // its level is the speed n, 1/s, positive in its sense of rotation
  ForcePlace place;           // of its disc
  double diameter = 1.0;      // m
  double thrust_scale = 0.0;  // rho D^4, kg m
  double torque_scale = 0.0;  // rho D^5, with the sign of the sense of rotation
  Vector3 thrust_coefficients = Vector3::Zero();  // k0, k1, k2
  Vector3 torque_coefficients = Vector3::Zero();  // q0, q1, q2

  /// @param n speed, 1/s. @param v speed of the air over the diameter, 1/s.
  double form(const Vector3& k, double n, double v) const {
    return (k.x() * n * std::abs(n) + k.y() * std::abs(n) * v) + k.z() * v * std::abs(v);
  }
  /// N, along its direction.
  double thrust(const ForceInputs& inputs) const {
    return thrust_scale *
           form(thrust_coefficients, inputs.levels[id], place.airSpeed(inputs) / diameter);
  }
  /// In B: of the thrust at its place, and its torque.
  Wrench wrench(const ForceInputs& inputs) const {
    const double torque = torque_scale * form(torque_coefficients, inputs.levels[id],
                                              place.airSpeed(inputs) / diameter);
    Wrench result = place.wrench(thrust(inputs) * place.direction);
    result.torque -= torque * place.direction;
    return result;
  }
};

/// A rudder in the slipstream of a fan or propeller: V_d = V/2 + sqrt(V^2/4 + T/(rho A)) by
/// momentum theory, q = rho V_d^2/2, lift q S C_la delta across the stream, drag q S (C_d0 + k
/// delta^2) along it. T is that of the fan, V that of its own place; without a fan V_d = V, and no
/// force where that is not forwards.
struct RudderForce {
  std::size_t id = 0;  // its level is the angle delta, rad, right-handed about the hinge
  ForcePlace place;    // direction: that of the fan's thrust, against the stream
  Vector3 across = Vector3::UnitY();                           // unit: hinge x direction
  double half_density_area = 0.0;                              // rho S/2, kg/m
  double lift_slope = 0.0;                                     // C_la, 1/rad
  double drag_at_rest = 0.0;                                   // C_d0
  double drag_growth = 0.0;                                    // k, 1/rad^2
  double inverse_density_disc = 0.0;                           // 1/(rho A), m/kg
  std::variant<std::monostate, FanForce, PropellerForce> fan;  // in whose slipstream it is; none

  /// N; 0 without a fan.
  double thrustOfFan(const ForceInputs& inputs) const {
    if (const auto* found = std::get_if<FanForce>(&fan)) return found->thrust(inputs);
    if (const auto* found = std::get_if<PropellerForce>(&fan)) return found->thrust(inputs);
    return 0.0;
  }
  /// In B.
  Wrench wrench(const ForceInputs& inputs) const {
    const double half = 0.5 * place.airSpeed(inputs);
    const double induced = std::max(0.0, thrustOfFan(inputs)) * inverse_density_disc;
    const double v = std::max(0.0, half + std::sqrt(half * half + induced));
    const double delta = inputs.levels[id];
    const double scale = half_density_area * (v * v);
    const double drag = drag_at_rest + drag_growth * (delta * delta);
    return place.wrench((scale * (lift_slope * delta)) * across - (scale * drag) * place.direction);
  }
};

/// The drag of the hull by a law.
struct DragForce {
  DragLaw law;  // which one

  Wrench wrench(const ForceInputs& inputs) const { return wrenchInBody(law, inputs.u_B); }  // in B
};

/// One kind is one alternative.
using Force = std::variant<FanForce, PropellerForce, RudderForce, DragForce>;

/// Their sum, in their order. Out of line, so that a craft without any keeps its registers.
HOVERCRAFT_PUBLIC Wrench wrenchInBody(const std::vector<Force>& forces, const ForceInputs& inputs);

}  // namespace hovercraft
