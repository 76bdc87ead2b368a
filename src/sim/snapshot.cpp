#include "hovercraft_sim/sim/snapshot.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "hovercraft_sim/sim/config_reader.h"
#include "hovercraft_sim/sim/scenario_parser.h"

namespace hovercraft {
namespace {

const std::vector<std::string> kFrameNames = {"world", "body"};

std::string text(const Vector3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

/// The orientation as named vectors: a quaternion as scalar and vector, a matrix as its columns.
std::string orientationText(const Quaternion& q) {
  return fmt::format("q_s: {:.17g}, q_v: {}", q.s, text(q.v));
}
std::string orientationText(const Matrix3& R) {
  return fmt::format("x_axis: {}, y_axis: {}, z_axis: {}", text(R.col(0)), text(R.col(1)),
                     text(R.col(2)));
}

Quaternion parseQuaternion(const ConfigReader& reader) {
  return {reader.number("q_s"), reader.vector("q_v")};
}
Matrix3 parseMatrix(const ConfigReader& reader) {
  Matrix3 R;
  R.col(0) = reader.vector("x_axis");
  R.col(1) = reader.vector("y_axis");
  R.col(2) = reader.vector("z_axis");
  return R;
}

template <class Orientation>
RigidBodyState<Orientation> parseBody(const ConfigReader& body, const Orientation& orientation) {
  return {body.vector("position"), orientation, body.vector("momentum"),
          body.vector("angular_momentum")};
}

std::string bodyText(const BodyState& state) {
  return std::visit(
      [](const auto& body) {
        return fmt::format("{{position: {}, {}, momentum: {}, angular_momentum: {}}}\n",
                           text(body.p_WB), orientationText(body.orientation),
                           text(body.momentum_W), text(body.angular_momentum_W));
      },
      state);
}

std::string vehicleText(const std::string& name, const BodyState& body,
                        const EngineStates& engines) {
  std::string yaml = fmt::format("  {}:\n    body: {}", name, bodyText(body));
  for (std::size_t i = 0; i < kEngineNames.size(); ++i) {
    const EngineState& engine = engines[i];
    yaml += fmt::format("    {}: {{commanded: {:.17g}, thrust: {:.17g}, command_tick: {}}}\n",
                        kEngineNames[i], engine.commanded, engine.thrust, engine.command_tick);
  }
  return yaml;
}

std::string wrenchText(const Scenario& scenario, const ExternalWrench& external) {
  return fmt::format("  - {{vehicle: {}, frame: {}, force: {}, torque: {}, end_tick: {}}}\n",
                     scenario.vehicles[external.vehicle].name,
                     kFrameNames[static_cast<std::size_t>(external.frame)],
                     text(external.wrench.force), text(external.wrench.torque), external.end_tick);
}

std::string commandText(const Scenario& scenario, const Command& command) {
  return fmt::format("  - {{tick: {}, vehicle: {}, engines: {}, thrusts: {}}}\n", command.tick,
                     scenario.vehicles[command.vehicle].name, static_cast<int>(command.engines),
                     text(command.thrusts));
}

/// A contact by the indices of its bodies and features: these are of the same scenario.
std::string contactText(const ContactMemory& contact) {
  const FeaturePair& f = contact.features;
  std::string yaml = fmt::format(
      "  - {{a: {}, b: {}, kind_a: {}, index_a: {}, kind_b: {}, index_b: {}, hint_a: {}, hint_b: "
      "{}, resting: {}",
      contact.a, contact.b, static_cast<int>(f.a.kind), f.a.index, static_cast<int>(f.b.kind),
      f.b.index, f.hints[0], f.hints[1], contact.resting ? "true" : "false");
  if (contact.count > 0) yaml += ", points: [";
  for (int i = 0; i < contact.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    yaml += fmt::format("{}{{p: {}, force: {}}}", i > 0 ? ", " : "", text(contact.p_AC[k]),
                        text(contact.force_B_W[k]));
  }
  return yaml + (contact.count > 0 ? "]}\n" : "}\n");
}

ContactMemory parseContact(const ConfigReader& reader) {
  const auto whole = [&reader](const char* key) {
    return static_cast<std::int32_t>(reader.wholeNumberOr(0, key));
  };
  ContactMemory contact;
  contact.a = whole("a");
  contact.b = whole("b");
  contact.features = {true,
                      {static_cast<FeatureKind>(whole("kind_a")), whole("index_a")},
                      {static_cast<FeatureKind>(whole("kind_b")), whole("index_b")},
                      {whole("hint_a"), whole("hint_b")}};
  contact.resting = reader.flagOr(false, "resting");
  if (!reader.has("points")) return contact;
  for (const ConfigReader& point : reader.list("points")) {
    if (contact.count == ContactManifold::kMaxPoints) reader.fail("points", "must be at most 8");
    const auto k = static_cast<std::size_t>(contact.count++);
    contact.p_AC[k] = point.vector("p");
    contact.force_B_W[k] = point.vector("force");
  }
  return contact;
}

BodyState parseBodyState(const ConfigReader& body, OrientationKind kind) {
  if (kind == OrientationKind::kQuaternion) return parseBody(body, parseQuaternion(body));
  return parseBody(body, parseMatrix(body));
}

EngineStates parseEngines(const ConfigReader& reader) {
  EngineStates engines;
  for (std::size_t i = 0; i < kEngineNames.size(); ++i) {
    const ConfigReader engine = reader.map(kEngineNames[i]);
    engine.allowOnly({"commanded", "thrust", "command_tick"});
    engines[i] = {engine.number("commanded"), engine.number("thrust"),
                  engine.wholeNumberOr(EngineState::kNever, "command_tick")};
  }
  return engines;
}

std::size_t parseVehicleName(const ConfigReader& reader, const Scenario& scenario) {
  std::vector<std::string> names;
  for (const VehicleScenario& vehicle : scenario.vehicles) names.push_back(vehicle.name);
  return reader.choiceOr(0, "vehicle", names);
}

/// @param earliest the tick of the command before it, or of the snapshot.
Command parseCommand(const ConfigReader& reader, const Scenario& scenario, Tick earliest) {
  reader.allowOnly({"tick", "vehicle", "engines", "thrusts"});
  Command command;
  command.tick = reader.wholeNumberOr(-1, "tick");
  if (command.tick < earliest) {
    reader.fail("tick", fmt::format("must be {} or greater, in ascending order", earliest));
  }
  command.vehicle = parseVehicleName(reader, scenario);
  const std::int64_t engines = reader.wholeNumberOr(0, "engines");
  if (engines < 1 || engines > kAllEngines) {
    reader.fail("engines", "must be 1 to 7: the sum of rear 1, left 2, right 4");
  }
  command.engines = static_cast<EngineMask>(engines);
  command.thrusts = reader.vector("thrusts");
  return command;
}

CommandLog parseCommands(const ConfigReader& reader, const Scenario& scenario, Tick earliest) {
  CommandLog log;
  if (!reader.has("commands")) return log;
  for (const ConfigReader& entry : reader.list("commands")) {
    const Command command = parseCommand(entry, scenario, earliest);
    log.push(command);
    earliest = command.tick;
  }
  return log;
}

ExternalWrench parseWrench(const ConfigReader& reader, const Scenario& scenario) {
  reader.allowOnly({"vehicle", "frame", "force", "torque", "end_tick"});
  ExternalWrench external;
  external.vehicle = parseVehicleName(reader, scenario);
  external.frame = static_cast<ExternalWrench::Frame>(reader.choiceOr(0, "frame", kFrameNames));
  external.wrench = {reader.vector("force"), reader.vector("torque")};
  external.end_tick = reader.wholeNumberOr(0, "end_tick");
  return external;
}

}  // namespace

std::string toSnapshot(const Simulation& simulation) {
  const Scenario& scenario = simulation.scenario();
  const SimulationState& state = simulation.state();
  std::string yaml = fmt::format("tick: {}\nseed: {}\nhash: '{:016x}'\nvehicles:\n", state.tick,
                                 state.seed, simulation.hash());
  const std::size_t vehicle_count = scenario.vehicles.size();
  for (std::size_t i = 0; i < vehicle_count; ++i) {
    yaml += vehicleText(scenario.vehicles[i].name, state.bodies[i], state.engines[i]);
  }
  if (!state.wrenches.empty()) yaml += "wrenches:\n";
  for (const ExternalWrench& external : state.wrenches) yaml += wrenchText(scenario, external);
  if (state.bodies.size() > vehicle_count) yaml += "bodies:\n";
  for (std::size_t i = vehicle_count; i < state.bodies.size(); ++i) {
    yaml += fmt::format("  {}: {}", scenario.world->bodies[i - vehicle_count].name,
                        bodyText(state.bodies[i]));
  }
  if (!state.contacts.empty()) yaml += "contacts:\n";
  for (const ContactMemory& contact : state.contacts) yaml += contactText(contact);
  const std::vector<Command> commands = state.commands.waiting();
  if (!commands.empty()) yaml += "commands:\n";
  for (const Command& command : commands) yaml += commandText(scenario, command);
  yaml += "scenario: |\n";
  std::istringstream lines(toYaml(scenario));
  for (std::string line; std::getline(lines, line);) yaml += "  " + line + "\n";
  return yaml;
}

SimulationState parseSnapshot(const std::string& text, const std::string& source,
                              const Scenario& scenario) {
  const YAML::Node tree = treeOf(text, source);
  const ConfigReader reader(tree, source);
  reader.allowOnly({"tick", "seed", "hash", "vehicles", "wrenches", "bodies", "contacts",
                    "commands", "scenario"});
  if (reader.text("scenario") != toYaml(scenario)) {
    throw std::invalid_argument(source + ": scenario: the snapshot belongs to another scenario");
  }
  SimulationState state;
  state.tick = reader.wholeNumberOr(-1, "tick");
  if (state.tick < 0) reader.fail("tick", "must be 0 or greater");
  state.seed = reader.wholeNumberOr(scenario.seed, "seed");
  const ConfigReader vehicles = reader.map("vehicles");
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    const ConfigReader entry = vehicles.map(vehicle.name);
    entry.allowOnly({"body", kEngineNames[0], kEngineNames[1], kEngineNames[2]});
    state.bodies.push_back(parseBodyState(entry.map("body"), scenario.orientation));
    state.engines.push_back(parseEngines(entry));
  }
  if (reader.has("wrenches")) {
    for (const ConfigReader& wrench : reader.list("wrenches")) {
      state.wrenches.push_back(parseWrench(wrench, scenario));
    }
  }
  if (scenario.world && !scenario.world->bodies.empty()) {
    const ConfigReader bodies = reader.map("bodies");
    for (const VehicleScenario& body : scenario.world->bodies) {
      state.bodies.push_back(parseBodyState(bodies.map(body.name), scenario.orientation));
    }
  }
  if (reader.has("contacts")) {
    for (const ConfigReader& contact : reader.list("contacts")) {
      state.contacts.push_back(parseContact(contact));
    }
  }
  state.commands = parseCommands(reader, scenario, state.tick);
  Simulation check(scenario);
  check.restore(state);
  if (reader.text("hash") != fmt::format("{:016x}", check.hash())) {
    reader.fail("hash", "is not that of the state: the snapshot was changed");
  }
  return state;
}

void saveSnapshot(const Simulation& simulation, const std::string& path) {
  const std::string unfinished = path + ".partial";
  std::ofstream stream(unfinished, std::ios::binary);
  stream << toSnapshot(simulation);
  stream.close();
  if (!stream || std::rename(unfinished.c_str(), path.c_str()) != 0) {
    const std::string reason = std::strerror(errno);
    std::remove(unfinished.c_str());
    throw std::invalid_argument(fmt::format("{}: cannot be written: {}", path, reason));
  }
}

std::string readSnapshotText(const std::string& path) {
  std::error_code no_such_path;  // what is not there cannot be read either
  if (std::filesystem::is_directory(path, no_such_path)) {
    throw std::invalid_argument(path + ": cannot be read: it is a directory, must be a file");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream.is_open() || stream.bad()) throw std::invalid_argument(path + ": cannot be read");
  return text;
}

}  // namespace hovercraft
