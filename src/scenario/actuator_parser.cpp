#include "hovercraft_sim/scenario/actuator_parser.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/actuator_keys.h"
#include "hovercraft_sim/scenario/actuator_topics.h"
#include "hovercraft_sim/scenario/command_parser.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

void checkUnit(const ConfigReader& reader, const char* key, const Vector3& vector) {
  if (std::abs(norm(vector) - 1.0) > kUnitLength) {
    reader.fail(key, fmt::format("must have length 1 (it has {:.6g})", norm(vector)));
  }
}

/// Of an engine or another actuator whose rotor does not turn with its level alone.
void parseRotor(const ConfigReader& reader, RotorParameters& rotor) {
  readKeys(reader, kRotorKeys, rotor);
  if (!(rotor.inertia > 0.0) && reader.has("rotor_speed")) {
    reader.fail("rotor_speed", "has a meaning with a rotor_inertia greater than 0 only");
  }
  if (!std::isfinite(rotor.inertia * rotor.speed)) {
    reader.fail("rotor_speed", "times rotor_inertia must be finite");
  }
}

EngineParameters parseEngine(const ConfigReader& reader) {
  EngineParameters engine = unreadEngine();
  reader.allowOnly(together({keyNames(kEngineKeys, engine),
                             {"command", "thrust_table", "type", "topic"},
                             keyNames(kRotorKeys, engine.rotor)}));
  readKeys(reader, kEngineKeys, engine);
  checkUnit(reader, "direction", engine.direction);
  parseRotor(reader, engine.rotor);
  engine.command = parseCommandMap(reader, traitsOf(ActuatorKind::kFan).level, true);
  return engine;
}

std::vector<std::string> keysOf(const ActuatorScenario& actuator) {
  std::vector<std::string> keys = together({{"kind"},
                                            keyNames(kPlaceKeys, actuator),
                                            keyNames(kLevelKeys, actuator),
                                            {"command", "type", "topic"},
                                            keyNames(kActuatorKindKeys, actuator)});
  if (actuator.kind == ActuatorKind::kFan) keys.emplace_back("thrust_table");
  if (!hasRotorKeys(actuator.kind)) return keys;
  return together({keys, keyNames(kRotorKeys, actuator.motion.rotor)});
}

/// What must hold between the keys of a kind.
void checkKind(const ConfigReader& reader, ActuatorScenario& actuator) {
  const bool is_lift_fan = actuator.kind == ActuatorKind::kLiftFan;
  checkUnit(reader, is_lift_fan ? "axis" : "direction", actuator.motion.direction);
  if (actuator.kind != ActuatorKind::kRudder) return;
  checkUnit(reader, "hinge", actuator.hinge);
  if (std::abs(dot(actuator.hinge, actuator.motion.direction)) > kUnitLength) {
    reader.fail("hinge", "must be perpendicular to direction");
  }
  if (actuator.motion.max_thrust > kMostRudderAngle) {
    reader.fail("max_angle", fmt::format("must be at most {} rad", kMostRudderAngle));
  }
  actuator.motion.min_thrust = -actuator.motion.max_thrust;
}

ActuatorScenario parseActuator(const std::string& name, const ConfigReader& reader) {
  ActuatorKind kind = ActuatorKind::kFan;
  ChoiceKey("kind", actuatorKindNames()).read(reader, "kind", kind);
  ActuatorScenario actuator = unreadActuator(kind);
  actuator.name = name;
  reader.allowOnly(keysOf(actuator));
  readKeys(reader, kPlaceKeys, actuator);
  readKeys(reader, kActuatorKindKeys, actuator);
  readKeys(reader, kLevelKeys, actuator);
  checkKind(reader, actuator);
  if (hasRotorKeys(kind)) parseRotor(reader, actuator.motion.rotor);
  actuator.motion.command =
      parseCommandMap(reader, traitsOf(kind).level, kind == ActuatorKind::kFan);
  actuator.topic = parseCommandTopic(reader);
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

/// Of a rotor that counts, with a comma before each key.
std::string rotorYaml(const RotorParameters& rotor) {
  const std::string text = keysText(kRotorKeys, rotor);
  return text.empty() ? "" : ", " + text;
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
    yaml += fmt::format("      {}: {{{}{}{}{}}}\n", kEngineNames[i], keysText(kEngineKeys, engine),
                        rotorYaml(engine.rotor),
                        commandMapYaml(engine.command, traitsOf(ActuatorKind::kFan).level),
                        commandTopicYaml(vehicle.engine_topics[i]));
  }
  return yaml;
}

std::string actuatorsYaml(const VehicleScenario& vehicle) {
  if (vehicle.actuators.empty()) return "";
  std::string yaml = "    actuators:\n";
  for (const ActuatorScenario& actuator : vehicle.actuators) {
    const ActuatorTraits traits = traitsOf(actuator.kind);
    yaml += fmt::format(
        "      {}: {{kind: {}, {}, {}{}, {}{}{}}}\n", yamlText(actuator.name), traits.name,
        keysText(kPlaceKeys, actuator), keysText(kActuatorKindKeys, actuator),
        hasRotorKeys(actuator.kind) ? rotorYaml(actuator.motion.rotor) : "",
        keysText(kLevelKeys, actuator), commandMapYaml(actuator.motion.command, traits.level),
        commandTopicYaml(actuator.topic));
  }
  return yaml;
}

}  // namespace hovercraft
