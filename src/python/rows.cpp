#include "hovercraft_sim/python/rows.h"

#include <algorithm>
#include <stdexcept>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft_python {

namespace py = pybind11;

using hovercraft::Command;
using hovercraft::Trajectory;
using hovercraft::Vector3;

void registerRows() {
  PYBIND11_NUMPY_DTYPE(CommandRow, tick, vehicle, actuators, values);
  PYBIND11_NUMPY_DTYPE(TrajectoryRow, time_ns, position, orientation, velocity, angular_velocity);
}

namespace {

std::array<double, 3> numbersOf(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

Vector3 vectorOf(const std::array<double, 3>& numbers) {
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace

CommandRows rowsOf(const std::vector<Command>& commands) {
  std::vector<CommandRow> rows;
  rows.reserve(commands.size());
  for (const Command& command : commands) {
    CommandRow row = {
        command.tick, static_cast<std::int32_t>(command.vehicle), command.engines, {}};
    for (std::size_t id = 0; id < command.thrusts.size(); ++id)
      row.values[id] = command.thrusts[id];
    rows.push_back(row);
  }
  return arrayOf(rows);
}

std::vector<Command> commandsOf(const CommandRows& rows, const hovercraft::Scenario& scenario) {
  if (rows.ndim() != 1) throw std::invalid_argument("commands: must have one dimension");
  std::vector<Command> commands;
  const CommandRow* const data = rows.data();
  hovercraft::Tick last = 0;
  for (py::ssize_t i = 0; i < rows.size(); ++i) {
    const CommandRow& row = data[i];
    const bool is_known =
        row.vehicle >= 0 && static_cast<std::size_t>(row.vehicle) < scenario.vehicles.size();
    if (!is_known || row.tick < last) {
      throw std::invalid_argument("commands: must be of this scenario, in the order of ticks");
    }
    last = row.tick;
    Command command{row.tick, static_cast<std::size_t>(row.vehicle), 0, {}};
    command.thrusts.resize(parametersOf(scenario.vehicles[command.vehicle]).size());
    if ((row.actuators >> command.thrusts.size()) != 0) {
      throw std::invalid_argument("commands: must be for actuators of the craft");
    }
    command.engines = static_cast<hovercraft::EngineMask>(row.actuators);
    for (std::size_t id = 0; id < command.thrusts.size(); ++id)
      command.thrusts[id] = row.values[id];
    if (!hovercraft::allFinite(command.thrusts)) {
      throw std::invalid_argument("commands: must be finite");
    }
    commands.push_back(command);
  }
  return commands;
}

py::list toPython(const std::vector<Trajectory>& trajectories) {
  py::list list;
  for (const Trajectory& trajectory : trajectories) {
    std::vector<TrajectoryRow> rows;
    rows.reserve(trajectory.samples.size());
    for (const hovercraft::TrajectorySample& sample : trajectory.samples) {
      const Vector3& v = sample.q_WB.v;
      rows.push_back({sample.time_ns,
                      numbersOf(sample.p_WB),
                      {v.x(), v.y(), v.z(), sample.q_WB.s},
                      numbersOf(sample.v_WB),
                      numbersOf(sample.w_WB)});
    }
    list.append(py::make_tuple(trajectory.vehicle, trajectory.source, trajectory.has_velocities,
                               trajectory.holds_time_zero, arrayOf(rows)));
  }
  return list;
}

Trajectory trajectoryFrom(const py::tuple& described) {
  if (described.size() != 5) throw std::invalid_argument("a trajectory must have five parts");
  Trajectory trajectory;
  trajectory.vehicle = described[0].cast<std::string>();
  trajectory.source = described[1].cast<std::string>();
  trajectory.has_velocities = described[2].cast<bool>();
  trajectory.holds_time_zero = described[3].cast<bool>();
  const auto rows = described[4].cast<TrajectoryRows>();
  if (rows.ndim() != 1) throw std::invalid_argument("a trajectory must have one dimension");
  const TrajectoryRow* const data = rows.data();
  for (py::ssize_t i = 0; i < rows.size(); ++i) {
    const TrajectoryRow& row = data[i];
    if (i > 0 && row.time_ns <= data[i - 1].time_ns) {
      throw std::invalid_argument("time: must increase from row to row");
    }
    hovercraft::TrajectorySample sample;
    sample.time_ns = row.time_ns;
    sample.p_WB = vectorOf(row.position);
    sample.q_WB = {row.orientation[3],
                   Vector3(row.orientation[0], row.orientation[1], row.orientation[2])};
    sample.v_WB = vectorOf(row.velocity);
    sample.w_WB = vectorOf(row.angular_velocity);
    trajectory.samples.push_back(sample);
  }
  return trajectory;
}

}  // namespace hovercraft_python
