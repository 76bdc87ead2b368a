#pragma once

#include <string>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/hovercraft/environment.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

enum class ActuatorKind { kFan, kPropeller, kLiftFan, kRudder };

/// Which way a greater level pushes the craft: along its direction, along hinge x direction, or not
/// by itself.
enum class ActuatorPush { kAlong, kAcross, kNone };

/// What is said of a kind; what it does is in actuator_parser.cpp and actuator_forces.cpp.
struct ActuatorTraits {
  const char* name;   // in scenarios and messages; none: there is no such kind
  const char* level;  // the word for a command that is the level itself
  const char* unit;   // of the level; empty: a share
  ActuatorPush push;  // of a greater level
};

/// One kind is one line here.
constexpr ActuatorTraits traitsOf(ActuatorKind kind) {
  switch (kind) {
    case ActuatorKind::kFan:
      return {"fan", "newton", "N", ActuatorPush::kAlong};
    case ActuatorKind::kPropeller:
      return {"propeller", "per_second", "1/s", ActuatorPush::kAlong};
    case ActuatorKind::kLiftFan:
      return {"lift_fan", "share", "", ActuatorPush::kNone};
    case ActuatorKind::kRudder:
      return {"rudder", "radian", "rad", ActuatorPush::kAcross};
  }
  return {nullptr, nullptr, nullptr, ActuatorPush::kNone};
}

/// On which topic an engine or another actuator is commanded by itself, and as what.
struct CommandTopic {
  std::string name;         // relative to the craft's namespace, or absolute; empty: by its name
  bool is_float32 = false;  // std_msgs/Float32, else Float64
};

/// An actuator besides the three engines. Its level is the thrust at rest in N of a fan, the speed
/// in 1/s of a propeller, the speed as a share of the nominal one of a lift fan, the angle in rad
/// of a rudder. `motion` has limits, lag, time-out, rotor and commands of the level; place and
/// direction are those of positive thrust, of a rudder the direction of its fan's thrust, of a lift
/// fan that of its axis.
struct ActuatorScenario {
  std::string name;
  ActuatorKind kind = ActuatorKind::kFan;  // which
  EngineParameters motion;                 // of its level
  CommandTopic topic;                      // on which it is commanded by itself
  double initial = 0.0;                    // level, until the first command
  double free_speed = 0.0;  // m/s, of a fan: at which its thrust is 0; 0: it does not fall
  double air_density = kStandardAirDensity;  // kg/m³
  double diameter = 0.0;  // m, of a propeller; of a rudder that of its fan's disc
  Vector3 thrust_coefficients = Vector3::Zero();  // of a propeller: k0, k1, k2
  Vector3 torque_coefficients = Vector3::Zero();  // q0, q1, q2
  std::string fan;                                // of a rudder: in whose slipstream; empty: none
  Vector3 hinge = Vector3::UnitZ();               // unit, in B
  double area = 0.0;                              // m²
  double lift_slope = 0.0;                        // 1/rad
  double drag_at_rest = 0.0;                      // C_d0
  double drag_growth = 0.0;                       // 1/rad²
};

}  // namespace hovercraft
