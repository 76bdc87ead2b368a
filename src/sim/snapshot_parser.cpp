#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/version.h"
#include "hovercraft_sim/scenario/yaml_text.h"
#include "hovercraft_sim/sim/snapshot.h"
#include "hovercraft_sim/sim/snapshot_air.h"
#include "hovercraft_sim/sim/snapshot_sensors.h"

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

std::int64_t wholeNumber(const ConfigReader& reader, const char* key, std::int64_t least,
                         std::int64_t most) {
  if (!reader.has(key)) reader.fail(key, "the key is missing");
  const std::int64_t value = reader.wholeNumberOr(0, key);
  if (value < least || value > most) {
    reader.fail(key, fmt::format("must be {} to {}", least, most));
  }
  return value;
}

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

Quaternion parseOrientation(const ConfigReader& reader, const Quaternion& /*kind*/) {
  reader.allowOnly({"position", "q_s", "q_v", "momentum", "angular_momentum"});
  return {reader.number("q_s"), reader.vector("q_v")};
}
Matrix3 parseOrientation(const ConfigReader& reader, const Matrix3& /*kind*/) {
  reader.allowOnly({"position", "x_axis", "y_axis", "z_axis", "momentum", "angular_momentum"});
  Matrix3 R_WB;
  R_WB.col(0) = reader.vector("x_axis");
  R_WB.col(1) = reader.vector("y_axis");
  R_WB.col(2) = reader.vector("z_axis");
  return R_WB;
}

template <class Orientation>
BodyState parseBodyAs(const ConfigReader& reader, BodyModel model, const Orientation& kind) {
  const Orientation orientation = parseOrientation(reader, kind);
  requireRotation(reader, orientation);
  RigidBodyState<Orientation> body = {reader.vector("position", kCoordinate), orientation,
                                      reader.vector("momentum"), reader.vector("angular_momentum")};
  if (model != BodyModel::kPlanar) return body;
  const char* const rule = "does not fit model: planar, which moves in x, y and yaw only";
  if (!isYaw(orientation)) reader.fail("", rule);
  if (body.momentum_W.z() != 0.0) reader.fail("momentum", rule);
  const Vector3& L = body.angular_momentum_W;
  if (L.x() != 0.0 || L.y() != 0.0) reader.fail("angular_momentum", rule);
  return body;
}

BodyState parseBodyState(const ConfigReader& reader, const Scenario& scenario) {
  return scenario.orientation == OrientationKind::kQuaternion
             ? parseBodyAs(reader, scenario.model, Quaternion{1.0, Vector3::Zero()})
             : parseBodyAs(reader, scenario.model, Matrix3(Matrix3::Identity()));
}

void requireCount(const ConfigReader& reader, const char* key, std::size_t count) {
  if (reader.map(key).maps().size() == count) return;
  reader.fail(key, "must hold those of the scenario and no other");
}

EngineState parseEngine(const ConfigReader& reader, const EngineParameters& engine, Tick now) {
  reader.allowOnly({"commanded", "thrust", "command_tick", "efficiency", "stuck"});
  const EngineState state = {reader.number("commanded"), reader.number("thrust"),
                             wholeNumber(reader, "command_tick", EngineState::kNever, now),
                             reader.numberOr(1.0, "efficiency", kEfficiency),
                             reader.flagOr(false, "stuck")};
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
  command.tick = wholeNumber(reader, "tick", 0, latestTick(scenario));
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
  reader.allowOnly({"vehicle", "frame", "force", "torque", "end_tick"});
  ExternalWrench external;
  external.vehicle = parseVehicleName(reader, scenario);
  reader.text("frame");  // it must be there
  external.frame = static_cast<ExternalWrench::Frame>(reader.choiceOr(0, "frame", frameNames()));
  external.wrench = {reader.vector("force"), reader.vector("torque")};
  external.end_tick = wholeNumber(reader, "end_tick", 0, std::numeric_limits<std::int64_t>::max());
  return external;
}

std::int32_t index(const ConfigReader& reader, const char* key, std::int32_t least,
                   std::int32_t count) {
  return static_cast<std::int32_t>(wholeNumber(reader, key, least, std::int64_t{count} - 1));
}

/// A feature of a body, and where the search in its ring or fan starts.
struct SavedFeature {
  Feature feature;
  std::int32_t hint;
};

struct FeatureKeys {
  const char* kind;
  const char* index;
  const char* hint;
};

SavedFeature parseFeature(const ConfigReader& reader, const ConvexPolyhedron& hull,
                          const FeatureKeys& keys) {
  SavedFeature saved{};
  saved.feature.kind = static_cast<FeatureKind>(index(reader, keys.kind, 0, 3));
  const std::array<int, 3> counts = {hull.vertexCount(), hull.edgeCount(), hull.faceCount()};
  saved.feature.index =
      index(reader, keys.index, 0, counts[static_cast<std::size_t>(saved.feature.kind)]);
  std::int32_t places = 1;
  if (saved.feature.kind == FeatureKind::kVertex) {
    places = hull.data().vertices[static_cast<std::size_t>(saved.feature.index)].fan_count;
  } else if (saved.feature.kind == FeatureKind::kFace) {
    places = hull.face(saved.feature.index).ring_count;
  }
  saved.hint = index(reader, keys.hint, 0, places);
  return saved;
}

ContactMemory parseContact(const ConfigReader& reader, const World& world) {
  reader.allowOnly({"a", "b", "kind_a", "index_a", "kind_b", "index_b", "hint_a", "hint_b",
                    "resting", "points"});
  const auto moving = static_cast<std::int32_t>(world.scene().bodies().size());
  const std::int32_t all = moving + static_cast<std::int32_t>(world.scene().obstacles().size());
  ContactMemory contact;
  contact.a = index(reader, "a", 0, moving);
  contact.b = index(reader, "b", contact.a + 1, all);
  const SavedFeature a =
      parseFeature(reader, world.scene().hullOf(contact.a), {"kind_a", "index_a", "hint_a"});
  const SavedFeature b =
      parseFeature(reader, world.scene().hullOf(contact.b), {"kind_b", "index_b", "hint_b"});
  contact.features = {true, a.feature, b.feature, {a.hint, b.hint}};
  contact.resting = reader.flagOr(false, "resting");
  if (!reader.has("points")) return contact;
  for (const ConfigReader& point : reader.list("points")) {
    if (contact.count == ContactManifold::kMaxPoints) reader.fail("points", "must be at most 8");
    point.allowOnly({"p", "force"});
    const auto k = static_cast<std::size_t>(contact.count++);
    contact.p_AC[k] = point.vector("p");
    contact.force_B_W[k] = point.vector("force");
    if (!std::isfinite(squaredNorm(contact.p_AC[k])) ||
        !std::isfinite(squaredNorm(contact.force_B_W[k]))) {
      point.fail("", "the squares of p and force must be finite");
    }
  }
  return contact;
}

/// In the order in which a step looks for them.
std::vector<ContactMemory> parseContacts(const ConfigReader& reader, const World* world) {
  std::vector<ContactMemory> contacts;
  if (!reader.has("contacts")) return contacts;
  if (world == nullptr) reader.fail("contacts", "needs a world: in the scenario");
  for (const ConfigReader& entry : reader.list("contacts")) {
    const ContactMemory contact = parseContact(entry, *world);
    const bool ascends = contacts.empty() || contacts.back().a < contact.a ||
                         (contacts.back().a == contact.a && contacts.back().b < contact.b);
    if (!ascends) entry.fail("", "pairs must stand once and in ascending order");
    contacts.push_back(contact);
  }
  return contacts;
}

SimulationState parseState(const ConfigReader& reader, const Scenario& scenario,
                           const Simulation& started) {
  SimulationState state;
  state.tick = wholeNumber(reader, "tick", 0, latestTick(scenario));
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
  state.contacts = parseContacts(reader, started.world());
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
    throw std::invalid_argument(source + ": it is not the YAML of a snapshot: it was changed");
  }
}

/// A snapshot of format 1 says neither, and is of physics version 1.
void checkVersions(const ConfigReader& reader, bool may_be_older) {
  if (reader.has("format")) wholeNumber(reader, "format", kSnapshotFormat, kSnapshotFormat);
  const std::int64_t physics = reader.wholeNumberOr(1, "physics_version");
  if (physics == kPhysicsVersion) return;
  if (may_be_older && physics > 0 && physics < kPhysicsVersion) return;
  reader.fail("physics_version", fmt::format("must be {}, that of this build: the run would go on "
                                             "with other bits",
                                             kPhysicsVersion));
}

/// Another version may have written the text with other digits or quotes.
bool isTextOf(const Scenario& scenario, const std::string& text, ScenarioSource source) {
  const std::string expected = toYaml(scenario);
  if (text == expected) return true;
  try {
    source.name += ": scenario";
    return toYaml(parseScenario(text, source)) == expected;
  } catch (const std::invalid_argument&) {
    return false;  // its message would quote the text
  }
}

}  // namespace

SimulationState parseSnapshot(const std::string& text, const std::string& source,
                              const Scenario& scenario, bool may_be_older) {
  const FloatingPointEnvironment environment;
  const ConfigReader reader(snapshotTree(text, source), source, "", false);
  reader.allowOnly({"format", "physics_version", "tick", "seed", "hash", "vehicles", "wrenches",
                    "bodies", "wind", "gusts", "contacts", "sensor_hash", "sensors", "commands",
                    "scenario"});
  checkVersions(reader, may_be_older);
  if (!isTextOf(scenario, reader.text("scenario"), {source, "", {}, {}, may_be_older})) {
    throw std::invalid_argument(source + ": scenario: the snapshot belongs to another scenario");
  }
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
