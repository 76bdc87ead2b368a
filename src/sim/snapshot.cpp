#include "hovercraft_sim/sim/snapshot.h"

#include <fmt/format.h>
#include <sstream>
#include <stdexcept>
#include <type_traits>

#include "hovercraft_sim/io/input_file.h"
#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/version.h"
#include "hovercraft_sim/scenario/yaml_text.h"
#include "hovercraft_sim/sim/snapshot_air.h"
#include "hovercraft_sim/sim/snapshot_sensors.h"
#include "hovercraft_sim/sim/state_fields.h"

namespace hovercraft {
namespace {

// A snapshot of a thousand bodies that all touch has a megabyte.
constexpr std::size_t kMostSnapshotBytes = 16777216;

/// Fields as `name: value`, with commas between them.
class FieldsText {
 public:
  template <class Value>
  void operator()(const char* name, const Value& value) {
    if (!text_.empty()) text_ += ", ";
    text_ += fmt::format("{}: {}", name, textOf(value));
  }
  const std::string& text() const { return text_; }

 private:
  static std::string textOf(double number) { return yamlNumber(number); }
  static std::string textOf(const Vector3& v) { return yamlVector(v); }
  static std::string textOf(bool flag) { return flag ? "true" : "false"; }
  static std::string textOf(std::int64_t number) { return fmt::format("{}", number); }
  static std::string textOf(std::int32_t number) { return fmt::format("{}", number); }
  static std::string textOf(FeatureKind kind) { return fmt::format("{}", static_cast<int>(kind)); }
  static std::string textOf(ExternalWrench::Frame frame) {
    return frameNames()[static_cast<std::size_t>(frame)];
  }
  static std::string textOf(const std::string& text) { return text; }

  std::string text_;
};

std::string bodyText(const BodyState& state) {
  FieldsText fields;
  std::visit([&fields](const auto& body) { visitBody(body, fields); }, state);
  return fmt::format("{{{}}}\n", fields.text());
}

std::string actuatorText(const EngineState& state) {
  FieldsText fields;
  visitActuator(state, fields);
  if (state.isFaulty()) visitFault(state, fields);
  return fmt::format("{{{}}}\n", fields.text());
}

std::string vehicleText(const VehicleScenario& vehicle, const BodyState& body,
                        const EngineStates& states) {
  std::string yaml = fmt::format("  {}:\n    body: {}", yamlText(vehicle.name), bodyText(body));
  for (std::size_t i = 0; i < kEngineNames.size(); ++i) {
    yaml += fmt::format("    {}: {}", kEngineNames[i], actuatorText(states[i]));
  }
  if (!vehicle.actuators.empty()) yaml += "    actuators:\n";
  for (std::size_t i = 0; i < vehicle.actuators.size(); ++i) {
    yaml += fmt::format("      {}: {}", yamlText(vehicle.actuators[i].name),
                        actuatorText(states[kFirstActuator + i]));
  }
  return yaml;
}

std::string wrenchText(const Scenario& scenario, const ExternalWrench& external) {
  FieldsText fields;
  visitWrench(external, [&](const char* name, const auto& value) {
    // A craft by its name.
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::size_t>) {
      fields(name, yamlText(scenario.vehicles[value].name));
    } else {
      fields(name, value);
    }
  });
  return fmt::format("  - {{{}}}\n", fields.text());
}

/// The values for actuators besides the engines by name, if there are any.
std::string commandText(const Scenario& scenario, const Command& command) {
  const VehicleScenario& vehicle = scenario.vehicles[command.vehicle];
  const Vector3 thrusts(command.thrusts[0], command.thrusts[1], command.thrusts[2]);
  std::string yaml =
      fmt::format("  - {{tick: {}, vehicle: {}, engines: {}, thrusts: {}", command.tick,
                  yamlText(vehicle.name), command.engines & kAllEngines, yamlVector(thrusts));
  std::string values;
  for (std::size_t i = 0; i < vehicle.actuators.size(); ++i) {
    if ((command.engines & maskOf(kFirstActuator + i)) == 0) continue;
    values +=
        fmt::format("{}{}: {}", values.empty() ? "" : ", ", yamlText(vehicle.actuators[i].name),
                    yamlNumber(command.thrusts[kFirstActuator + i]));
  }
  if (!values.empty()) yaml += fmt::format(", actuators: {{{}}}", values);
  return yaml + "}\n";
}

/// A contact by the indices of its bodies and features: these are of the same scenario.
std::string contactText(const ContactCache& contact) {
  FieldsText fields;
  visitPair(contact, fields);
  visitFeatures(contact, fields);
  std::string points;
  for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
    FieldsText point;
    visitPoint(contact, k, point);
    points += fmt::format("{}{{{}}}", k > 0 ? ", " : "", point.text());
  }
  if (contact.count > 0) fields("points", "[" + points + "]");
  return fmt::format("  - {{{}}}\n", fields.text());
}

}  // namespace

std::string toSnapshot(const Simulation& simulation) {
  const FloatingPointEnvironment environment;
  const Scenario& scenario = simulation.scenario();
  const SimulationState& state = simulation.state();
  std::string yaml = fmt::format(
      "format: {}\nphysics_version: {}\ntick: {}\nseed: {}\nhash: '{:016x}'\nvehicles:\n",
      kSnapshotFormat, kPhysicsVersion, state.tick, state.seed, simulation.hash());
  const std::size_t vehicle_count = scenario.vehicles.size();
  for (std::size_t i = 0; i < vehicle_count; ++i) {
    yaml += vehicleText(scenario.vehicles[i], state.bodies[i], state.engines[i]);
  }
  if (!state.wrenches.empty()) yaml += "wrenches:\n";
  for (const ExternalWrench& external : state.wrenches) yaml += wrenchText(scenario, external);
  if (state.bodies.size() > vehicle_count) yaml += "bodies:\n";
  for (std::size_t i = vehicle_count; i < state.bodies.size(); ++i) {
    yaml += fmt::format("  {}: {}", yamlText(scenario.world->bodies[i - vehicle_count].name),
                        bodyText(state.bodies[i]));
  }
  if (!state.contacts.empty()) yaml += "contacts:\n";
  for (const ContactCache& contact : state.contacts) yaml += contactText(contact);
  yaml += airText(scenario, state);
  yaml += sensorStatesText(simulation);
  const std::vector<Command> commands = state.commands.waiting();
  if (!commands.empty()) yaml += "commands:\n";
  for (const Command& command : commands) yaml += commandText(scenario, command);
  yaml += "scenario: |\n";
  std::istringstream lines(toYaml(scenario));
  for (std::string line; std::getline(lines, line);) yaml += "  " + line + "\n";
  return yaml;
}

void saveSnapshot(const Simulation& simulation, const std::string& path) {
  const std::string text = toSnapshot(simulation);
  if (text.size() > kMostSnapshotBytes) {
    throw std::invalid_argument(
        fmt::format("{}: the snapshot has {} bytes: must be at most {}, or it could not be loaded",
                    path, text.size(), kMostSnapshotBytes));
  }
  writeWholeFile(path, text);
}

std::string readSnapshotText(const std::string& path) {
  return readWholeFile(path, kMostSnapshotBytes);
}

}  // namespace hovercraft
