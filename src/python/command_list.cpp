#include "hovercraft_sim/python/command_list.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft_python {

using hovercraft::Command;
using hovercraft::Scenario;

namespace {

/// The id of each column.
std::vector<std::size_t> idsOf(const CommandTable& table,
                               const hovercraft::VehicleScenario& craft) {
  std::vector<std::string> known;
  std::vector<std::size_t> known_ids;
  const std::size_t count = parametersOf(craft).size();
  for (std::size_t id = 0; id < count; ++id) {
    if (id < hovercraft::kFirstActuator && !craft.has_engine[id]) continue;
    known.push_back(actuatorName(craft, id));
    known_ids.push_back(id);
  }
  std::vector<std::size_t> ids;
  for (const std::string& name : table.names) {
    const auto found = std::find(known.begin(), known.end(), name);
    if (found == known.end()) {
      throw std::invalid_argument(fmt::format("commands: {} = {}: must be one of: {}", craft.name,
                                              name, fmt::join(known, ", ")));
    }
    const std::size_t id = known_ids[static_cast<std::size_t>(found - known.begin())];
    if (std::find(ids.begin(), ids.end(), id) != ids.end()) {
      throw std::invalid_argument(fmt::format("commands: {}: must not stand twice", name));
    }
    ids.push_back(id);
  }
  if (ids.empty()) throw std::invalid_argument("commands: must name an engine or an actuator");
  return ids;
}

void append(std::vector<Command>& commands, const CommandTable& table, const Scenario& scenario) {
  const std::size_t vehicle = craftIndex(scenario, table.vehicle);
  const std::vector<std::size_t> ids = idsOf(table, scenario.vehicles[vehicle]);
  if (table.values.size() != table.times.size() * ids.size()) {
    throw std::invalid_argument("commands: each column must be as long as time");
  }
  std::int64_t last_ns = 0;
  for (std::size_t row = 0; row < table.times.size(); ++row) {
    const std::int64_t time_ns =
        nanosecondsOf(fmt::format("commands: time[{}]", row), table.times[row]);
    if (time_ns < last_ns) {
      throw std::invalid_argument(
          fmt::format("commands: time[{}] = {}: must not be less than the one before", row,
                      hovercraft::numberText(table.times[row])));
    }
    last_ns = time_ns;
    Command command{hovercraft::firstTickAt(time_ns, scenario.step_ns), vehicle, 0, {}};
    command.thrusts.resize(parametersOf(scenario.vehicles[vehicle]).size());
    for (std::size_t column = 0; column < ids.size(); ++column) {
      const double value = table.values[row * ids.size() + column];
      if (!std::isfinite(value)) {
        throw std::invalid_argument(
            fmt::format("commands: {}[{}]: must be finite", table.names[column], row));
      }
      command.thrusts[ids[column]] = value;
      command.engines =
          static_cast<hovercraft::EngineMask>(command.engines | hovercraft::maskOf(ids[column]));
    }
    commands.push_back(command);
  }
}

}  // namespace

CommandList::CommandList(std::vector<Command> commands) : commands_(std::move(commands)) {}

std::optional<Command> CommandList::next() {
  if (next_ == commands_.size()) return std::nullopt;
  return commands_[next_++];
}

std::size_t craftIndex(const Scenario& scenario, const std::string& name) {
  if (name.empty() && scenario.vehicles.size() == 1) return 0;
  return vehicleIndex(scenario, name);
}

std::int64_t nanosecondsOf(const std::string& what, double seconds) {
  const hovercraft::FloatingPointEnvironment environment;
  if (!std::isfinite(seconds)) throw std::invalid_argument(what + ": must be finite");
  const std::string text = hovercraft::numberText(seconds);
  if (seconds < 0.0) throw std::invalid_argument(what + " = " + text + ": must be 0 or greater");
  const double most = hovercraft::kMaxNanoseconds * 1e-9;
  if (seconds > most) {
    throw std::invalid_argument(fmt::format("{} = {}: must be at most {:.0f} s", what, text, most));
  }
  return hovercraft::parseNanoseconds(text);
}

std::vector<Command> commandsOf(const std::vector<CommandTable>& tables, const Scenario& scenario) {
  std::vector<Command> commands;
  for (const CommandTable& table : tables) append(commands, table, scenario);
  std::stable_sort(commands.begin(), commands.end(),
                   [](const Command& a, const Command& b) { return a.tick < b.tick; });
  return commands;
}

std::vector<Command> allOf(hovercraft::CommandSource& source) {
  std::vector<Command> commands;
  while (const auto command = source.next()) commands.push_back(*command);
  return commands;
}

}  // namespace hovercraft_python
