#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/scenario/actuator_scenario.h"
#include "hovercraft_sim/scenario/key_table.h"

/// The keys of engines and other actuators (key_table.h). How they are commanded is
/// command_parser.h and actuator_topics.h.

namespace hovercraft {

/// rad: beyond it the lift of a rudder does not grow with its angle.
constexpr double kMostRudderAngle = 0.5;

/// An engine or another actuator before its keys are read: the defaults of its kind.
inline EngineParameters unreadEngine() {
  EngineParameters engine;
  engine.timeout_ns = static_cast<std::int64_t>(kDefaultCommandTimeout * kNanosecondsPerSecond);
  return engine;
}
inline ActuatorScenario unreadActuator(ActuatorKind kind) {
  ActuatorScenario actuator;
  actuator.kind = kind;
  // A lost command must neither drop a craft at speed nor put its rudder amidships.
  const bool stops = kind == ActuatorKind::kFan || kind == ActuatorKind::kPropeller;
  if (stops) actuator.motion = unreadEngine();
  if (kind == ActuatorKind::kPropeller) actuator.motion.rotor.speed = 2.0 * kPi;
  if (kind == ActuatorKind::kRudder) actuator.motion.max_thrust = kMostRudderAngle;
  if (kind == ActuatorKind::kLiftFan) {
    actuator.motion.direction = Vector3::UnitZ();
    actuator.motion.max_thrust = 1.0;
    actuator.initial = 1.0;  // it runs when the run begins
  }
  return actuator;
}

/// Which way a rotor turns: right or left for 1 or -1.
struct RotationKey : ChoiceKey {
  explicit RotationKey(const char* its_name) : ChoiceKey(its_name, turns()) {}
  void read(const ConfigReader& reader, const char* full_name, double& value) const {
    std::size_t choice = 0;
    ChoiceKey::read(reader, full_name, choice);
    value = choice == 0 ? 1.0 : -1.0;
  }
  std::string text(double value) const { return (*names)[value > 0.0 ? 0 : 1]; }

  static const std::vector<std::string>& turns() {
    static const std::vector<std::string> names_of_turns = {"right", "left"};
    return names_of_turns;
  }
};

/// Of RotorParameters whose speed is not that of the level; written where there is a rotor.
inline constexpr auto kRotorKeys = [](auto& rotor, auto&& visit) {
  const bool is_there = rotor.inertia > 0.0;
  visit(optional(writtenIf(is_there, RotationKey("rotation"))), rotor.turn);
  visit(optional(writtenIf(is_there, NumberKey("rotor_inertia", "kg m²", kNotNegative))),
        rotor.inertia);
  visit(onlyIf(rotor.inertia > 0.0, NumberKey("rotor_speed", "rad/s", kPositive)), rotor.speed);
};

/// Of EngineParameters: a thrust and its limits.
inline constexpr auto kThrustKeys = [](auto& motion, auto&& visit) {
  visit(VectorKey("direction", ""), motion.direction);
  visit(NumberKey("min_thrust", "N", kNotPositive), motion.min_thrust);
  visit(NumberKey("max_thrust", "N", kNotNegative), motion.max_thrust);
};
/// How it follows its commands.
inline constexpr auto kLagKeys = [](auto& motion, auto&& visit) {
  visit(optional(NumberKey("time_constant", "s", kNotNegative)), motion.time_constant);
  visit(optional(DurationKey("timeout", kNotNegative)), motion.timeout_ns);
};

/// Of EngineParameters of an engine, besides its rotor and its commands.
inline constexpr auto kEngineKeys = [](auto& engine, auto&& visit) {
  visit(VectorKey("position", "m", kCoordinate), engine.p_HE);
  kThrustKeys(engine, visit);
  kLagKeys(engine, visit);
};

/// Of an ActuatorScenario: where it is.
inline constexpr auto kPlaceKeys = [](auto& actuator, auto&& visit) {
  const VectorKey position("position", "m", kCoordinate);
  const bool is_lift_fan = actuator.kind == ActuatorKind::kLiftFan;
  visit(is_lift_fan ? optional(position) : position, actuator.motion.p_HE);
};
/// How its level follows its commands, and from where.
inline constexpr auto kLevelKeys = [](auto& actuator, auto&& visit) {
  kLagKeys(actuator.motion, visit);
  visit(optional(NumberKey("initial", "")), actuator.initial);
};

inline constexpr auto kFanKeys = [](auto& fan, auto&& visit) {
  kThrustKeys(fan.motion, visit);
  visit(optional(NumberKey("free_speed", "m/s", kNotNegative)), fan.free_speed);
};

inline constexpr auto kPropellerKeys = [](auto& propeller, auto&& visit) {
  auto& motion = propeller.motion;
  visit(VectorKey("direction", ""), motion.direction);
  visit(NumberKey("min_speed", "1/s", kNotPositive), motion.min_thrust);
  visit(NumberKey("max_speed", "1/s", kNotNegative), motion.max_thrust);
  visit(LengthKey("diameter", "m"), propeller.diameter);
  visit(optional(NumberKey("air_density", "kg/m³", kPositive)), propeller.air_density);
  visit(optional(RotationKey("rotation")), motion.rotor.turn);
  visit(optional(writtenIf(motion.rotor.inertia > 0.0,
                           NumberKey("rotor_inertia", "kg m²", kNotNegative))),
        motion.rotor.inertia);
  visit(VectorKey("thrust_coefficients", ""), propeller.thrust_coefficients);
  visit(optional(VectorKey("torque_coefficients", "")), propeller.torque_coefficients);
};

inline constexpr auto kLiftFanKeys = [](auto& fan, auto&& visit) {
  visit(optional(VectorKey("axis", "")), fan.motion.direction);
};

inline constexpr auto kRudderKeys = [](auto& rudder, auto&& visit) {
  visit(optional(VectorKey("direction", "")), rudder.motion.direction);
  visit(optional(VectorKey("hinge", "")), rudder.hinge);
  visit(optional(writtenIf(!rudder.fan.empty(), TextKey("fan"))), rudder.fan);
  visit(optional(writtenIf(!rudder.fan.empty(), LengthKey("disc_diameter", "m"))), rudder.diameter);
  visit(NumberKey("area", "m²", kPositive), rudder.area);
  visit(NumberKey("lift_slope", "1/rad", kNotNegative), rudder.lift_slope);
  visit(optional(NumberKey("drag_at_rest", "", kNotNegative)), rudder.drag_at_rest);
  visit(optional(NumberKey("drag_growth", "1/rad²", kNotNegative)), rudder.drag_growth);
  visit(optional(NumberKey("air_density", "kg/m³", kPositive)), rudder.air_density);
  visit(optional(NumberKey("max_angle", "rad", kNotNegative)), rudder.motion.max_thrust);
};

/// Of an ActuatorScenario those of its kind alone, besides a rotor that is not of its level.
inline constexpr auto kActuatorKindKeys = [](auto& actuator, auto&& visit) {
  switch (actuator.kind) {
    case ActuatorKind::kFan:
      return kFanKeys(actuator, visit);
    case ActuatorKind::kPropeller:
      return kPropellerKeys(actuator, visit);
    case ActuatorKind::kLiftFan:
      return kLiftFanKeys(actuator, visit);
    case ActuatorKind::kRudder:
      return kRudderKeys(actuator, visit);
  }
};

/// Whether it has kRotorKeys.
inline bool hasRotorKeys(ActuatorKind kind) {
  return kind == ActuatorKind::kFan || kind == ActuatorKind::kLiftFan;
}

}  // namespace hovercraft
