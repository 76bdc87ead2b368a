#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/version.h"
#include "hovercraft_sim/scenario/yaml_text.h"
#include "hovercraft_sim/sim/snapshot.h"
#include "hovercraft_sim/sim/snapshot_air.h"
#include "hovercraft_sim/sim/snapshot_contacts.h"
#include "hovercraft_sim/sim/snapshot_sensors.h"
#include "hovercraft_sim/sim/state_fields.h"

/// A snapshot is as foreign as a scenario: it may be any file, or come in a bag. Nothing of it
/// becomes an index, a pose or a time before it was checked, whatever its hash says.

namespace hovercraft {
namespace {

/// 146 years: ticks times the step size, and what is added to them, fit 64 bits.
constexpr std::int64_t kMostTimeNs = std::int64_t{1} << 62U;

const NumberRule kEfficiency = {[](double share) { return share >= 0.0 && share <= 1.0; },
                                "must be 0 to 1"};

// The limits hold to rounding: the lag computes a thrust from two others.
constexpr double kThrustSlack = 1e-9;

Tick latestTick(const Scenario& scenario) {
  return kMostTimeNs / scenario.step_ns;
}

void requireRotation(const ConfigReader& body, const Quaternion& q_WB) {
  if (std::abs(squaredNorm(q_WB) - 1.0) <= kSavedRotation) return;
  body.fail("q_s", fmt::format("the quaternion must have length 1, to {:.0e}", kSavedRotation));
}

void requireRotation(const ConfigReader& body, const Matrix3& R_WB) {
  double error = std::abs(determinant(R_WB) - 1.0);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      error = std::max(error, std::abs(dot(R_WB.col(i), R_WB.col(j)) - (i == j ? 1.0 : 0.0)));
    }
  }
  if (error <= kSavedRotation) return;
  body.fail("x_axis",
            fmt::format("the three axes must be those of a rotation, to {:.0e}", kSavedRotation));
}

/// Whether the body's own z axis is that of the world.
bool isYaw(const Quaternion& q_WB) {
  return std::abs(q_WB.v.x()) <= kSavedRotation && std::abs(q_WB.v.y()) <= kSavedRotation;
}
bool isYaw(const Matrix3& R_WB) {
  return std::abs(R_WB(0, 2)) <= kSavedRotation && std::abs(R_WB(1, 2)) <= kSavedRotation &&
         R_WB(2, 2) > 0.0;
}

/// The names of the fields that a walk (state_fields.h) meets.
template <class Walk>
std::vector<std::string> namesOf(const Walk& walk) {
  std::vector<std::string> names;
  walk([&names](const char* name, const auto& /*value*/) { names.emplace_back(name); });
  return names;
}

template <class Orientation>
BodyState parseBodyAs(const ConfigReader& reader, BodyModel model) {
  RigidBodyState<Orientation> body;
  const auto walk = [&body](const auto& visit) { visitBody(body, visit); };
  reader.allowOnly(namesOf(walk));
  walk([&](const char* name, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Vector3>) {
      value = &value == &body.p_WB ? reader.vector(name, kCoordinate) : reader.vector(name);
    } else {
      value = reader.number(name);
    }
  });
  requireRotation(reader, body.orientation);
  if (model != BodyModel::kPlanar) return body;
  const char* const rule = "does not fit model: planar, which moves in x, y and yaw only";
  if (!isYaw(body.orientation)) reader.fail("", rule);
  if (body.momentum_W.z() != 0.0) reader.fail("momentum", rule);
  const Vector3& L = body.angular_momentum_W;
  if (L.x() != 0.0 || L.y() != 0.0) reader.fail("angular_momentum", rule);
  return body;
}

BodyState parseBodyState(const ConfigReader& reader, const Scenario& scenario) {
  return scenario.orientation == OrientationKind::kQuaternion
             ? parseBodyAs<Quaternion>(reader, scenario.model)
             : parseBodyAs<Matrix3>(reader, scenario.model);
}

void requireCount(const ConfigReader& reader, const char* key, std::size_t count) {
  if (reader.map(key).maps().size() == count) return;
  reader.fail(key, "must hold those of the scenario and no other");
}

void readField(const ConfigReader& reader, const char* name, double& value) {
  value = reader.number(name);
}
void readField(const ConfigReader& reader, const char* name, Vector3& value) {
  value = reader.vector(name);
}

EngineState parseEngine(const ConfigReader& reader, const EngineParameters& engine, Tick now) {
  EngineState state;
  const auto walk = [&state](const auto& visit) {
    visitActuator(state, visit);
    visitFault(state, visit);
  };
  reader.allowOnly(namesOf(walk));
  visitActuator(state, [&](const char* name, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Tick>) {
      value = reader.wholeNumber(name, EngineState::kNever, now);
    } else {
      readField(reader, name, value);
    }
  });
  // Written where there is one.
  visitFault(state, [&](const char* name, auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, bool>) {
      value = reader.flagOr(value, name);
    } else {
      value = reader.numberOr(value, name, kEfficiency);
    }
  });
  const double slack = kThrustSlack * std::max(-engine.min_thrust, engine.max_thrust);
  if (state.thrust < engine.min_thrust - slack || state.thrust > engine.max_thrust + slack) {
    reader.fail("thrust", "must be within the limits of the engine");
  }
  return state;
}

void parseVehicle(const ConfigReader& reader, const Scenario& scenario,
                  const VehicleScenario& vehicle, SimulationState& state) {
  reader.allowOnly({"body", kEngineNames[0], kEngineNames[1], kEngineNames[2], "actuators"});
  state.bodies.push_back(parseBodyState(reader.map("body"), scenario));
  EngineStates engines;
  for (std::size_t i = 0; i < kEngineNames.size(); ++i) {
    engines[i] = parseEngine(reader.map(kEngineNames[i]), vehicle.engines[i], state.tick);
  }
  if (reader.has("actuators")) requireCount(reader, "actuators", vehicle.actuators.size());
  for (const ActuatorScenario& actuator : vehicle.actuators) {
    const ConfigReader entry = reader.map("actuators").map(actuator.name);
    engines.append(parseEngine(entry, actuator.motion, state.tick));
  }
  state.engines.push_back(engines);
}

std::size_t parseVehicleName(const ConfigReader& reader, const Scenario& scenario) {
  reader.text("vehicle");  // it must be there
  return reader.choiceOr(0, "vehicle", vehicleNames(scenario));
}

void parseCommandedActuators(const ConfigReader& reader, const VehicleScenario& vehicle,
                             Command& command) {
  command.thrusts.resize(kFirstActuator + vehicle.actuators.size());
  std::size_t found = 0;
  for (std::size_t i = 0; i < vehicle.actuators.size(); ++i) {
    const char* name = vehicle.actuators[i].name.c_str();
    if (!reader.has(name)) continue;
    ++found;
    command.thrusts[kFirstActuator + i] = reader.number(name);
    command.engines = static_cast<EngineMask>(command.engines | maskOf(kFirstActuator + i));
  }
  if (found == 0 || found != reader.size()) reader.fail("", "must name actuators of the craft");
}

/// @param earliest the tick of the command before it, or of the snapshot.
Command parseCommand(const ConfigReader& reader, const Scenario& scenario, Tick earliest) {
  reader.allowOnly({"tick", "vehicle", "engines", "thrusts", "actuators"});
  Command command;
  command.tick = reader.wholeNumber("tick", 0, latestTick(scenario));
  if (command.tick < earliest) {
    reader.fail("tick", fmt::format("must be {} or greater, in ascending order", earliest));
  }
  command.vehicle = parseVehicleName(reader, scenario);
  const std::int64_t engines = reader.wholeNumberOr(0, "engines");
  const bool has_actuators = reader.has("actuators");
  if (engines < (has_actuators ? 0 : 1) || engines > kAllEngines) {
    reader.fail("engines", fmt::format("must be {} to 7: the sum of rear 1, left 2, right 4",
                                       has_actuators ? 0 : 1));
  }
  command.engines = static_cast<EngineMask>(engines);
  command.thrusts = reader.vector("thrusts");
  if (has_actuators) {
    parseCommandedActuators(reader.map("actuators"), scenario.vehicles[command.vehicle], command);
  }
  return command;
}

CommandLog parseCommands(const ConfigReader& reader, const Scenario& scenario, Tick earliest) {
  CommandLog commands;
  if (!reader.has("commands")) return commands;
  for (const ConfigReader& entry : reader.list("commands")) {
    const Command command = parseCommand(entry, scenario, earliest);
    commands.push(command);
    earliest = command.tick;
  }
  return commands;
}

ExternalWrench parseWrench(const ConfigReader& reader, const Scenario& scenario) {
  ExternalWrench external;
  const auto walk = [&external](const auto& visit) { visitWrench(external, visit); };
  reader.allowOnly(namesOf(walk));
  walk([&](const char* name, auto& value) {
    using Value = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<Value, std::size_t>) {
      value = parseVehicleName(reader, scenario);
    } else if constexpr (std::is_same_v<Value, ExternalWrench::Frame>) {
      reader.text(name);  // it must be there
      value = static_cast<Value>(reader.choiceOr(0, name, frameNames()));
    } else if constexpr (std::is_same_v<Value, Tick>) {
      value = reader.wholeNumber(name, 0, std::numeric_limits<std::int64_t>::max());
    } else {
      readField(reader, name, value);
    }
  });
  return external;
}

SimulationState parseState(const ConfigReader& reader, const Scenario& scenario,
                           const Simulation& started) {
  SimulationState state;
  state.tick = reader.wholeNumber("tick", 0, latestTick(scenario));
  state.seed = reader.wholeNumberOr(scenario.seed, "seed");
  requireCount(reader, "vehicles", scenario.vehicles.size());
  const ConfigReader vehicles = reader.map("vehicles");
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    parseVehicle(vehicles.map(vehicle.name), scenario, vehicle, state);
  }
  if (reader.has("wrenches")) {
    for (const ConfigReader& wrench : reader.list("wrenches")) {
      state.wrenches.push_back(parseWrench(wrench, scenario));
    }
  }
  if (scenario.world && !scenario.world->bodies.empty()) {
    requireCount(reader, "bodies", scenario.world->bodies.size());
    const ConfigReader bodies = reader.map("bodies");
    for (const VehicleScenario& body : scenario.world->bodies) {
      state.bodies.push_back(parseBodyState(bodies.map(body.name), scenario));
    }
  } else if (reader.has("bodies")) {
    reader.fail("bodies", "there are none in the scenario");
  }
  parseAirState(reader, scenario, state);
  state.contacts = parseContactCaches(reader, started.world());
  state.sensors = parseSensorStates(reader, state.tick, started);
  state.commands = parseCommands(reader, scenario, state.tick);
  return state;
}

/// What a motion must be to go on from, as `~set_state` demands it too.
void requireMotion(const ConfigReader& reader, const std::string& key, const Motion& motion) {
  if (!std::isfinite(motion.energy)) reader.fail(key, "the energy must be finite");
}

void checkMotions(const ConfigReader& reader, const Simulation& simulation) {
  const Scenario& scenario = simulation.scenario();
  for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
    requireMotion(reader, "vehicles." + scenario.vehicles[i].name, simulation.motion(i));
  }
  if (!scenario.world) return;
  for (std::size_t i = 0; i < scenario.world->bodies.size(); ++i) {
    requireMotion(reader, "bodies." + scenario.world->bodies[i].name, simulation.bodyMotion(i));
  }
  if (const auto overlap = simulation.world()->overlap(simulation.state().bodies)) {
    reader.fail("", fmt::format("{} and {} overlap by {:.3g} m: must be at most the tolerance",
                                overlap->a, overlap->b, overlap->depth));
  }
}

/// @throws std::invalid_argument without a word of the text.
ConfigNode snapshotTree(const std::string& text, const std::string& source) {
  const std::string first_key = "format: ";
  const std::string first_key_of_format_1 = "tick: ";
  if (text.compare(0, first_key.size(), first_key) != 0 &&
      text.compare(0, first_key_of_format_1.size(), first_key_of_format_1) != 0) {
    throw std::invalid_argument(source + ": it is no snapshot");
  }
  try {
    return treeOf(text, source);
  } catch (const std::invalid_argument&) {
    throw std::invalid_argument(source +
                                ": it is not the YAML of a snapshot: it was cut or changed");
  }
}

/// A snapshot of format 1 says neither, and is of physics version 1.
void checkVersions(const ConfigReader& reader, bool may_be_older) {
  if (reader.has("format")) reader.wholeNumber("format", kSnapshotFormat, kSnapshotFormat);
  const std::int64_t physics = reader.wholeNumberOr(1, "physics_version");
  if (physics == kPhysicsVersion) return;
  if (may_be_older && physics > 0 && physics < kPhysicsVersion) return;
  reader.fail("physics_version", fmt::format("must be {}, that of this build: the run would go on "
                                             "with other bits",
                                             kPhysicsVersion));
}

/// The scenario is what a snapshot ends with: a file that was cut has a part of it, or nothing.
void requireEnd(const ConfigNode& snapshot, const std::string& source) {
  const ConfigNode* const end = snapshot.find("scenario");
  const bool is_there = end != nullptr && !end->isNull() && !(end->isText() && end->text().empty());
  if (is_there) return;
  throw std::invalid_argument(
      source + ": scenario: the key is missing, with which a snapshot ends: it was cut");
}

/// Another version may have written the text with other digits or quotes.
/// @throws std::invalid_argument if the text is not that of `scenario`.
void requireTextOf(const Scenario& scenario, const ConfigReader& reader, bool may_be_older) {
  const std::string& source = reader.source();
  const std::string text = reader.text("scenario");
  const std::string expected = toYaml(scenario);
  if (text == expected) return;
  std::string parsed;
  try {
    parsed = toYaml(parseScenario(text, {source + ": scenario", "", {}, {}, may_be_older}));
  } catch (const std::invalid_argument&) {  // its message would quote the text
    throw std::invalid_argument(source + ": scenario: it is none: the snapshot was cut or changed");
  }
  if (parsed == expected) return;
  const std::size_t end = text.find_last_not_of('\n');
  if (end != std::string::npos && expected.compare(0, end + 1, text, 0, end + 1) == 0) {
    throw std::invalid_argument(source + ": scenario: it ends too early: the snapshot was cut");
  }
  throw std::invalid_argument(source + ": scenario: the snapshot belongs to another scenario");
}

}  // namespace

SimulationState parseSnapshot(const std::string& text, const std::string& source,
                              const Scenario& scenario, bool may_be_older) {
  const FloatingPointEnvironment environment;
  const ConfigNode tree = snapshotTree(text, source);
  requireEnd(tree, source);
  const ConfigReader reader(tree, source, "", false);
  reader.allowOnly({"format", "physics_version", "tick", "seed", "hash", "vehicles", "wrenches",
                    "bodies", "wind", "gusts", "contacts", "sensor_hash", "sensors", "commands",
                    "scenario"});
  checkVersions(reader, may_be_older);
  requireTextOf(scenario, reader, may_be_older);
  Simulation check(scenario);
  SimulationState state = parseState(reader, scenario, check);
  check.restore(state);
  const std::string hash = fmt::format("{:016x}", check.hash());
  if (reader.text("hash") != hash) {
    reader.fail("hash", fmt::format("must be that of the state, {}: it was changed", hash));
  }
  checkSensorHash(reader, check);
  checkAir(reader, check);
  checkMotions(reader, check);
  return state;
}

}  // namespace hovercraft
