#include "hovercraft_sim/sim/snapshot.h"

#include <fmt/format.h>
#include <sstream>
#include <stdexcept>

#include "hovercraft_sim/io/input_file.h"
#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/version.h"
#include "hovercraft_sim/scenario/yaml_text.h"
#include "hovercraft_sim/sim/snapshot_air.h"
#include "hovercraft_sim/sim/snapshot_sensors.h"

namespace hovercraft {
namespace {

// A snapshot of a thousand bodies that all touch has a megabyte.
constexpr std::size_t kMostSnapshotBytes = 16777216;

/// The orientation as named vectors: a quaternion as scalar and vector, a matrix as its columns.
std::string orientationText(const Quaternion& q) {
  return fmt::format("q_s: {}, q_v: {}", yamlNumber(q.s), yamlVector(q.v));
}
std::string orientationText(const Matrix3& R) {
  return fmt::format("x_axis: {}, y_axis: {}, z_axis: {}", yamlVector(R.col(0)),
                     yamlVector(R.col(1)), yamlVector(R.col(2)));
}

std::string bodyText(const BodyState& state) {
  return std::visit(
      [](const auto& body) {
        return fmt::format("{{position: {}, {}, momentum: {}, angular_momentum: {}}}\n",
                           yamlVector(body.p_WB), orientationText(body.orientation),
                           yamlVector(body.momentum_W), yamlVector(body.angular_momentum_W));
      },
      state);
}

std::string actuatorText(const EngineState& state) {
  const std::string fault =
      state.isFaulty() ? fmt::format(", efficiency: {}, stuck: {}", yamlNumber(state.efficiency),
                                     state.stuck ? "true" : "false")
                       : "";
  return fmt::format("{{commanded: {}, thrust: {}, command_tick: {}{}}}\n",
                     yamlNumber(state.commanded), yamlNumber(state.thrust), state.command_tick,
                     fault);
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
  return fmt::format("  - {{vehicle: {}, frame: {}, force: {}, torque: {}, end_tick: {}}}\n",
                     yamlText(scenario.vehicles[external.vehicle].name),
                     frameNames()[static_cast<std::size_t>(external.frame)],
                     yamlVector(external.wrench.force), yamlVector(external.wrench.torque),
                     external.end_tick);
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
    yaml += fmt::format("{}{{p: {}, force: {}}}", i > 0 ? ", " : "", yamlVector(contact.p_AC[k]),
                        yamlVector(contact.force_B_W[k]));
  }
  return yaml + (contact.count > 0 ? "]}\n" : "}\n");
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
  for (const ContactMemory& contact : state.contacts) yaml += contactText(contact);
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
