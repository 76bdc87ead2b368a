#include "hovercraft_sim/sim/actuator_parser.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/sim/scenario_names.h"
#include "hovercraft_sim/sim/step_time.h"
#include "hovercraft_sim/sim/yaml_text.h"

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

void parseMotion(const ConfigReader& reader, double default_timeout, EngineParameters& motion) {
  motion.time_constant = reader.numberOr(0.0, "time_constant", kNotNegative);
  motion.timeout_ns =
      nanosecondsOf(reader, "timeout", reader.numberOr(default_timeout, "timeout", kNotNegative));
}

EngineParameters parseEngine(const ConfigReader& reader) {
  reader.allowOnly(
      {"position", "direction", "min_thrust", "max_thrust", "time_constant", "timeout"});
  EngineParameters engine;
  engine.p_HE = reader.vector("position", kCoordinate);
  engine.direction = unitVector(reader, "direction", reader.vector("direction"));
  engine.min_thrust = reader.number("min_thrust", kNotPositive);
  engine.max_thrust = reader.number("max_thrust", kNotNegative);
  parseMotion(reader, kDefaultCommandTimeout, engine);
  return engine;
}

void parseFan(const ConfigReader& reader, ActuatorScenario& fan) {
  reader.allowOnly({"kind", "position", "direction", "min_thrust", "max_thrust", "time_constant",
                    "timeout", "initial", "free_speed"});
  fan.motion.p_HE = reader.vector("position", kCoordinate);
  fan.motion.direction = unitVector(reader, "direction", reader.vector("direction"));
  fan.motion.min_thrust = reader.number("min_thrust", kNotPositive);
  fan.motion.max_thrust = reader.number("max_thrust", kNotNegative);
  fan.free_speed = reader.numberOr(0.0, "free_speed", kNotNegative);
  parseMotion(reader, kDefaultCommandTimeout, fan.motion);
}

void parsePropeller(const ConfigReader& reader, ActuatorScenario& propeller) {
  reader.allowOnly({"kind", "position", "direction", "min_speed", "max_speed", "time_constant",
                    "timeout", "initial", "diameter", "air_density", "rotation",
                    "thrust_coefficients", "torque_coefficients"});
  propeller.motion.p_HE = reader.vector("position", kCoordinate);
  propeller.motion.direction = unitVector(reader, "direction", reader.vector("direction"));
  propeller.motion.min_thrust = reader.number("min_speed", kNotPositive);
  propeller.motion.max_thrust = reader.number("max_speed", kNotNegative);
  propeller.diameter = reader.length("diameter");
  propeller.turn = reader.choiceOr(0, "rotation", rotationNames()) == 0 ? 1.0 : -1.0;
  propeller.thrust_coefficients = reader.vector("thrust_coefficients");
  propeller.torque_coefficients = reader.vectorOr(Vector3::Zero(), "torque_coefficients");
  parseMotion(reader, kDefaultCommandTimeout, propeller.motion);
}

void parseLiftFan(const ConfigReader& reader, ActuatorScenario& fan) {
  reader.allowOnly({"kind", "position", "time_constant", "timeout", "initial"});
  fan.motion.p_HE = reader.vectorOr(Vector3::Zero(), "position", kCoordinate);
  fan.motion.max_thrust = 1.0;
  parseMotion(reader, kNoTimeout, fan.motion);
}

void parseRudder(const ConfigReader& reader, ActuatorScenario& rudder) {
  reader.allowOnly({"kind", "position", "direction", "hinge", "fan", "disc_diameter", "area",
                    "lift_slope", "drag_at_rest", "drag_growth", "air_density", "max_angle",
                    "time_constant", "timeout", "initial"});
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

std::string motionYaml(const ActuatorScenario& actuator) {
  return fmt::format(
      "time_constant: {}, timeout: {}, initial: {}}}\n", yamlNumber(actuator.motion.time_constant),
      yamlNumber(toSeconds(actuator.motion.timeout_ns)), yamlNumber(actuator.initial));
}

std::string kindYaml(const ActuatorScenario& actuator) {
  const EngineParameters& motion = actuator.motion;
  switch (actuator.kind) {
    case ActuatorKind::kFan:
      return fmt::format("direction: {}, min_thrust: {}, max_thrust: {}, free_speed: {}, ",
                         yamlVector(motion.direction), yamlNumber(motion.min_thrust),
                         yamlNumber(motion.max_thrust), yamlNumber(actuator.free_speed));
    case ActuatorKind::kPropeller:
      return fmt::format(
          "direction: {}, min_speed: {}, max_speed: {}, diameter: {}, air_density: {}, rotation: "
          "{}, thrust_coefficients: {}, torque_coefficients: {}, ",
          yamlVector(motion.direction), yamlNumber(motion.min_thrust),
          yamlNumber(motion.max_thrust), yamlNumber(actuator.diameter),
          yamlNumber(actuator.air_density), rotationNames()[actuator.turn > 0.0 ? 0 : 1],
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
      break;
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
