#include "hovercraft_sim/scenario/actuator_parser.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/actuator_topics.h"
#include "hovercraft_sim/scenario/command_parser.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/step_time.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

// rad: beyond it the lift of a rudder does not grow with its angle.
constexpr double kMostRudderAngle = 0.5;

// A lost command must neither drop a craft at speed nor put its rudder amidships.
constexpr double kNoTimeout = 0.0;

const std::vector<std::string>& rotationNames() {
  static const std::vector<std::string> names = {"right", "left"};
  return names;
}

Vector3 unitVector(const ConfigReader& reader, const char* key, const Vector3& vector) {
  if (std::abs(norm(vector) - 1.0) > kUnitLength) {
    reader.fail(key, fmt::format("must have length 1 (it has {:.6g})", norm(vector)));
  }
  return vector;
}

/// Of an actuator whose rotor turns at `speed` rad/s at a level of 1; where that is 0,
/// `rotor_speed` says how fast.
RotorParameters parseRotor(const ConfigReader& reader, double speed) {
  RotorParameters rotor;
  rotor.turn = reader.choiceOr(0, "rotation", rotationNames()) == 0 ? 1.0 : -1.0;
  rotor.inertia = reader.numberOr(0.0, "rotor_inertia", kNotNegative);
  rotor.speed = speed;
  if (speed > 0.0) return rotor;
  if (rotor.inertia > 0.0) {
    rotor.speed = reader.number("rotor_speed", kPositive);
  } else if (reader.has("rotor_speed")) {
    reader.fail("rotor_speed", "has a meaning with a rotor_inertia greater than 0 only");
  }
  if (!std::isfinite(rotor.inertia * rotor.speed)) {
    reader.fail("rotor_speed", "times rotor_inertia must be finite");
  }
  return rotor;
}

void parseMotion(const ConfigReader& reader, double default_timeout, EngineParameters& motion) {
  motion.time_constant = reader.numberOr(0.0, "time_constant", kNotNegative);
  motion.timeout_ns =
      nanosecondsOf(reader, "timeout", reader.numberOr(default_timeout, "timeout", kNotNegative));
}

/// The keys of all kinds, and those of one.
void allowKeys(const ConfigReader& reader, std::initializer_list<const char*> own) {
  std::vector<std::string> keys = {"kind",    "position", "time_constant", "timeout",
                                   "initial", "command",  "type",          "topic"};
  keys.insert(keys.end(), own.begin(), own.end());
  reader.allowOnly(keys);
}

EngineParameters parseEngine(const ConfigReader& reader) {
  reader.allowOnly({"position", "direction", "min_thrust", "max_thrust", "time_constant", "timeout",
                    "command", "thrust_table", "type", "topic", "rotation", "rotor_inertia",
                    "rotor_speed"});
  EngineParameters engine;
  engine.p_HE = reader.vector("position", kCoordinate);
  engine.direction = unitVector(reader, "direction", reader.vector("direction"));
  engine.min_thrust = reader.number("min_thrust", kNotPositive);
  engine.max_thrust = reader.number("max_thrust", kNotNegative);
  engine.rotor = parseRotor(reader, 0.0);
  engine.command = parseCommandMap(reader, traitsOf(ActuatorKind::kFan).level, true);
  parseMotion(reader, kDefaultCommandTimeout, engine);
  return engine;
}

void parseFan(const ConfigReader& reader, ActuatorScenario& fan) {
  allowKeys(reader, {"direction", "min_thrust", "max_thrust", "free_speed", "thrust_table",
                     "rotation", "rotor_inertia", "rotor_speed"});
  fan.motion.p_HE = reader.vector("position", kCoordinate);
  fan.motion.direction = unitVector(reader, "direction", reader.vector("direction"));
  fan.motion.min_thrust = reader.number("min_thrust", kNotPositive);
  fan.motion.max_thrust = reader.number("max_thrust", kNotNegative);
  fan.motion.rotor = parseRotor(reader, 0.0);
  fan.free_speed = reader.numberOr(0.0, "free_speed", kNotNegative);
  parseMotion(reader, kDefaultCommandTimeout, fan.motion);
}

void parsePropeller(const ConfigReader& reader, ActuatorScenario& propeller) {
  allowKeys(reader, {"direction", "min_speed", "max_speed", "diameter", "air_density", "rotation",
                     "rotor_inertia", "thrust_coefficients", "torque_coefficients"});
  propeller.motion.p_HE = reader.vector("position", kCoordinate);
  propeller.motion.direction = unitVector(reader, "direction", reader.vector("direction"));
  propeller.motion.min_thrust = reader.number("min_speed", kNotPositive);
  propeller.motion.max_thrust = reader.number("max_speed", kNotNegative);
  propeller.diameter = reader.length("diameter");
  propeller.motion.rotor = parseRotor(reader, 2.0 * kPi);
  propeller.thrust_coefficients = reader.vector("thrust_coefficients");
  propeller.torque_coefficients = reader.vectorOr(Vector3::Zero(), "torque_coefficients");
  parseMotion(reader, kDefaultCommandTimeout, propeller.motion);
}

void parseLiftFan(const ConfigReader& reader, ActuatorScenario& fan) {
  allowKeys(reader, {"axis", "rotation", "rotor_inertia", "rotor_speed"});
  fan.motion.direction = unitVector(reader, "axis", reader.vectorOr(Vector3::UnitZ(), "axis"));
  fan.motion.rotor = parseRotor(reader, 0.0);
  fan.motion.p_HE = reader.vectorOr(Vector3::Zero(), "position", kCoordinate);
  fan.motion.max_thrust = 1.0;
  parseMotion(reader, kNoTimeout, fan.motion);
}

void parseRudder(const ConfigReader& reader, ActuatorScenario& rudder) {
  allowKeys(reader, {"direction", "hinge", "fan", "disc_diameter", "area", "lift_slope",
                     "drag_at_rest", "drag_growth", "air_density", "max_angle"});
  rudder.motion.p_HE = reader.vector("position", kCoordinate);
  rudder.motion.direction =
      unitVector(reader, "direction", reader.vectorOr(Vector3::UnitX(), "direction"));
  rudder.hinge = unitVector(reader, "hinge", reader.vectorOr(Vector3::UnitZ(), "hinge"));
  if (std::abs(dot(rudder.hinge, rudder.motion.direction)) > kUnitLength) {
    reader.fail("hinge", "must be perpendicular to direction");
  }
  if (reader.has("fan")) rudder.fan = reader.text("fan");
  if (reader.has("disc_diameter")) rudder.diameter = reader.length("disc_diameter");
  rudder.area = reader.number("area", kPositive);
  rudder.lift_slope = reader.number("lift_slope", kNotNegative);
  rudder.drag_at_rest = reader.numberOr(0.0, "drag_at_rest", kNotNegative);
  rudder.drag_growth = reader.numberOr(0.0, "drag_growth", kNotNegative);
  rudder.motion.max_thrust = reader.numberOr(kMostRudderAngle, "max_angle", kNotNegative);
  if (rudder.motion.max_thrust > kMostRudderAngle) {
    reader.fail("max_angle", fmt::format("must be at most {} rad", kMostRudderAngle));
  }
  rudder.motion.min_thrust = -rudder.motion.max_thrust;
  parseMotion(reader, kNoTimeout, rudder.motion);
}

ActuatorScenario parseActuator(const std::string& name, const ConfigReader& reader) {
  ActuatorScenario actuator;
  actuator.name = name;
  reader.text("kind");  // it must be there
  actuator.kind = static_cast<ActuatorKind>(reader.choiceOr(0, "kind", actuatorKindNames()));
  switch (actuator.kind) {
    case ActuatorKind::kFan:
      parseFan(reader, actuator);
      break;
    case ActuatorKind::kPropeller:
      parsePropeller(reader, actuator);
      break;
    case ActuatorKind::kLiftFan:
      parseLiftFan(reader, actuator);
      break;
    case ActuatorKind::kRudder:
      parseRudder(reader, actuator);
      break;
  }
  actuator.motion.command =
      parseCommandMap(reader, traitsOf(actuator.kind).level, actuator.kind == ActuatorKind::kFan);
  actuator.topic = parseCommandTopic(reader);
  actuator.air_density = reader.numberOr(kStandardAirDensity, "air_density", kPositive);
  // A lift fan runs when the run begins.
  const double initial = actuator.kind == ActuatorKind::kLiftFan ? 1.0 : 0.0;
  actuator.initial = reader.numberOr(initial, "initial");
  if (actuator.initial < actuator.motion.min_thrust ||
      actuator.initial > actuator.motion.max_thrust) {
    reader.fail("initial", "must be within the limits of the actuator");
  }
  return actuator;
}

/// The stream of a rudder is that of a fan or propeller of the craft.
void checkFanOf(const ConfigReader& reader, ActuatorScenario& rudder,
                const std::vector<ActuatorScenario>& actuators) {
  if (rudder.fan.empty()) {
    if (rudder.diameter > 0.0) reader.fail("disc_diameter", "needs a fan");
    return;
  }
  const auto fan = std::find_if(actuators.begin(), actuators.end(),
                                [&](const auto& other) { return other.name == rudder.fan; });
  if (fan == actuators.end() ||
      (fan->kind != ActuatorKind::kFan && fan->kind != ActuatorKind::kPropeller)) {
    reader.fail("fan", "must name a fan or a propeller of the actuators");
  }
  if (fan->kind == ActuatorKind::kPropeller && rudder.diameter == 0.0) {
    rudder.diameter = fan->diameter;
  }
  if (rudder.diameter == 0.0) reader.fail("disc_diameter", "the key is missing: that of the fan");
}

std::string rotationName(const RotorParameters& rotor) {
  return rotationNames()[rotor.turn > 0.0 ? 0 : 1];
}

std::string ofRotor(const RotorParameters& rotor) {
  return rotor.inertia > 0.0 ? ", rotor_inertia: " + yamlNumber(rotor.inertia) : "";
}

/// Of a rotor that counts, with a comma before each key; the rotation is said where it is not yet.
std::string rotorYaml(const RotorParameters& rotor) {
  if (!(rotor.inertia > 0.0)) return "";
  return fmt::format(", rotation: {}, rotor_inertia: {}, rotor_speed: {}", rotationName(rotor),
                     yamlNumber(rotor.inertia), yamlNumber(rotor.speed));
}

std::string motionYaml(const ActuatorScenario& actuator) {
  return fmt::format("time_constant: {}, timeout: {}, initial: {}{}{}}}\n",
                     yamlNumber(actuator.motion.time_constant),
                     yamlNumber(toSeconds(actuator.motion.timeout_ns)),
                     yamlNumber(actuator.initial),
                     commandMapYaml(actuator.motion.command, traitsOf(actuator.kind).level),
                     commandTopicYaml(actuator.topic));
}

std::string kindYaml(const ActuatorScenario& actuator) {
  const EngineParameters& motion = actuator.motion;
  switch (actuator.kind) {
    case ActuatorKind::kFan:
      return fmt::format("direction: {}, min_thrust: {}, max_thrust: {}, free_speed: {}{}, ",
                         yamlVector(motion.direction), yamlNumber(motion.min_thrust),
                         yamlNumber(motion.max_thrust), yamlNumber(actuator.free_speed),
                         rotorYaml(motion.rotor));
    case ActuatorKind::kPropeller:
      return fmt::format(
          "direction: {}, min_speed: {}, max_speed: {}, diameter: {}, air_density: {}, rotation: "
          "{}{}, thrust_coefficients: {}, torque_coefficients: {}, ",
          yamlVector(motion.direction), yamlNumber(motion.min_thrust),
          yamlNumber(motion.max_thrust), yamlNumber(actuator.diameter),
          yamlNumber(actuator.air_density), rotationName(motion.rotor), ofRotor(motion.rotor),
          yamlVector(actuator.thrust_coefficients), yamlVector(actuator.torque_coefficients));
    case ActuatorKind::kRudder: {
      const std::string fan =
          actuator.fan.empty() ? ""
                               : fmt::format("fan: {}, disc_diameter: {}, ", yamlText(actuator.fan),
                                             yamlNumber(actuator.diameter));
      return fmt::format(
          "direction: {}, hinge: {}, {}area: {}, lift_slope: {}, drag_at_rest: {}, drag_growth: "
          "{}, air_density: {}, max_angle: {}, ",
          yamlVector(motion.direction), yamlVector(actuator.hinge), fan, yamlNumber(actuator.area),
          yamlNumber(actuator.lift_slope), yamlNumber(actuator.drag_at_rest),
          yamlNumber(actuator.drag_growth), yamlNumber(actuator.air_density),
          yamlNumber(motion.max_thrust));
    }
    case ActuatorKind::kLiftFan:
      return fmt::format("axis: {}{}, ", yamlVector(motion.direction), rotorYaml(motion.rotor));
  }
  return "";
}

}  // namespace

void parseEngines(const ConfigReader& craft, VehicleScenario& vehicle) {
  vehicle.has_engine = {false, false, false};
  if (!craft.has("engines") && craft.has("actuators")) return;
  const ConfigReader engines = craft.map("engines");
  engines.allowOnly({kEngineNames[0], kEngineNames[1], kEngineNames[2]});
  for (std::size_t i = 0; i < kEngineNames.size(); ++i) {
    if (!engines.has(kEngineNames[i])) continue;
    vehicle.engines[i] = parseEngine(engines.map(kEngineNames[i]));
    vehicle.engine_topics[i] = parseCommandTopic(engines.map(kEngineNames[i]));
    vehicle.has_engine[i] = true;
  }
}

std::vector<ActuatorScenario> parseActuators(const ConfigReader& reader) {
  std::vector<ActuatorScenario> actuators;
  const auto entries = reader.maps();
  if (entries.size() > kMaxActuators - kFirstActuator) {
    reader.fail("", fmt::format("must be at most {}", kMaxActuators - kFirstActuator));
  }
  for (const auto& [name, entry] : entries) {
    if (!isGraphName(name)) {
      entry.fail("", "the name of an actuator is a ROS name: a letter, then letters, digits and _");
    }
    if (std::find(kEngineNames.begin(), kEngineNames.end(), name) != kEngineNames.end()) {
      entry.fail("", "must not be called as an engine");
    }
    actuators.push_back(parseActuator(name, entry));
  }
  for (std::size_t i = 0; i < actuators.size(); ++i) {
    if (actuators[i].kind == ActuatorKind::kRudder) {
      checkFanOf(entries[i].second, actuators[i], actuators);
    }
  }
  return actuators;
}

std::string enginesYaml(const VehicleScenario& vehicle) {
  if (!vehicle.has_engine[0] && !vehicle.has_engine[1] && !vehicle.has_engine[2]) {
    return vehicle.actuators.empty() ? "    engines: {}\n" : "";
  }
  std::string yaml = "    engines:\n";
  for (std::size_t i = 0; i < kEngineNames.size(); ++i) {
    if (!vehicle.has_engine[i]) continue;
    const EngineParameters& engine = vehicle.engines[i];
    yaml += fmt::format(
        "      {}: {{position: {}, direction: {}, min_thrust: {}, max_thrust: {}, "
        "time_constant: {}, timeout: {}{}{}{}}}\n",
        kEngineNames[i], yamlVector(engine.p_HE), yamlVector(engine.direction),
        yamlNumber(engine.min_thrust), yamlNumber(engine.max_thrust),
        yamlNumber(engine.time_constant), yamlNumber(toSeconds(engine.timeout_ns)),
        rotorYaml(engine.rotor), commandMapYaml(engine.command, traitsOf(ActuatorKind::kFan).level),
        commandTopicYaml(vehicle.engine_topics[i]));
  }
  return yaml;
}

std::string actuatorsYaml(const VehicleScenario& vehicle) {
  if (vehicle.actuators.empty()) return "";
  std::string yaml = "    actuators:\n";
  for (const ActuatorScenario& actuator : vehicle.actuators) {
    yaml += fmt::format("      {}: {{kind: {}, position: {}, {}{}", yamlText(actuator.name),
                        actuatorKindNames()[static_cast<std::size_t>(actuator.kind)],
                        yamlVector(actuator.motion.p_HE), kindYaml(actuator), motionYaml(actuator));
  }
  return yaml;
}

}  // namespace hovercraft
