#include "hovercraft_sim/live/command_schedule.h"

#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/run_events.h"
#include "hovercraft_sim/scenario/scenario_names.h"

namespace hovercraft_ros {

using hovercraft::Command;
using hovercraft::Tick;
using hovercraft_sim::AppliedCommand;

void CommandSchedule::add(const std::vector<Command>& commands) {
  for (const Command& command : commands) waiting_.emplace(command.tick, command);
}

std::optional<Command> CommandSchedule::takeDue(Tick tick) {
  const auto first = waiting_.begin();
  if (first == waiting_.end() || first->first > tick) return std::nullopt;
  Command command = first->second;
  waiting_.erase(first);
  return command;
}

std::optional<Tick> CommandSchedule::next() const {
  if (waiting_.empty()) return std::nullopt;
  return waiting_.begin()->first;
}

namespace {

template <class Require>
void checkActuators(const AppliedCommand& wanted, const hovercraft::VehicleScenario& craft,
                    const Require& require) {
  require(wanted.ids.size() == wanted.values.size(), "ids and values: must be as many");
  std::size_t least = hovercraft::kFirstActuator;
  const std::size_t end = hovercraft::kFirstActuator + craft.actuators.size();
  for (std::size_t i = 0; i < wanted.ids.size(); ++i) {
    const std::size_t id = wanted.ids[i];
    require(id >= least && id < end,
            fmt::format("ids[{}] = {}: must be an actuator of the craft, ascending", i, id));
    require(std::isfinite(wanted.values[i]), "values: must be finite");
    least = id + 1;
  }
}

}  // namespace

std::vector<Command> scheduledCommands(const hovercraft::Scenario& scenario,
                                       const hovercraft_sim::ScheduleCommands::Request& request,
                                       std::uint32_t episode, Tick tick) {
  const std::size_t vehicle = vehicleIndex(scenario, request.vehicle);
  std::vector<Command> commands;
  for (const AppliedCommand& wanted : request.commands) {
    const auto require = [&](bool holds, const std::string& rule) {
      if (holds) return;
      throw std::invalid_argument(fmt::format("commands[{}]: {}", commands.size(), rule));
    };
    require(wanted.episode == episode,
            fmt::format("episode = {}: must be that of the run, {}", wanted.episode, episode));
    require(wanted.tick <= static_cast<std::uint64_t>(std::numeric_limits<Tick>::max()) &&
                static_cast<Tick>(wanted.tick) >= tick,
            fmt::format("tick = {}: must be {}, where the run stands, or later, and fit 63 bits",
                        wanted.tick, tick));
    require(
        (wanted.engines != 0 || !wanted.ids.empty()) && wanted.engines <= hovercraft::kAllEngines,
        fmt::format("engines = {}: must be 1 to 7", wanted.engines));
    checkActuators(wanted, scenario.vehicles[vehicle], require);
    require(std::isfinite(wanted.rear) && std::isfinite(wanted.left) && std::isfinite(wanted.right),
            "a thrust must be finite");
    commands.push_back(toCommand(wanted, vehicle));
  }
  return commands;
}

}  // namespace hovercraft_ros
