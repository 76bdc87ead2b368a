#pragma once

#include <array>
#include <cstdint>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "hovercraft_sim/hovercraft/actuator_array.h"
#include "hovercraft_sim/records/trajectory.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/command_log.h"

/// What the extension modules hand each other as arrays of numpy.

namespace hovercraft_python {

/// A command as it is handed from Python.
struct CommandRow {
  std::int64_t tick;
  std::int32_t vehicle;                                  // index
  std::uint32_t actuators;                               // a bit each, by id
  std::array<double, hovercraft::kMaxActuators> values;  // by id: N, or levels; 0 without a bit
};

/// A sample of a trajectory.
struct TrajectoryRow {
  std::int64_t time_ns;
  std::array<double, 3> position;          // m
  std::array<double, 4> orientation;       // x, y, z, w
  std::array<double, 3> velocity;          // m/s, in W
  std::array<double, 3> angular_velocity;  // rad/s, in W
};

using CommandRows = pybind11::array_t<CommandRow, pybind11::array::c_style>;
using TrajectoryRows = pybind11::array_t<TrajectoryRow, pybind11::array::c_style>;

/// Makes both known to numpy; once in a process.
void registerRows();

/// A one-dimensional array with these elements.
template <class Row>
pybind11::array_t<Row> arrayOf(const std::vector<Row>& rows) {
  return pybind11::array_t<Row>(static_cast<pybind11::ssize_t>(rows.size()), rows.data());
}

CommandRows rowsOf(const std::vector<hovercraft::Command>& commands);
/// @throws std::invalid_argument for rows that no function of these modules made.
std::vector<hovercraft::Command> commandsOf(const CommandRows& rows,
                                            const hovercraft::Scenario& scenario);

/// A list of (vehicle, source, has_velocities, holds_time_zero, rows).
pybind11::list toPython(const std::vector<hovercraft::Trajectory>& trajectories);
/// @param described as an element of toPython(). @throws std::invalid_argument unless it is one.
hovercraft::Trajectory trajectoryFrom(const pybind11::tuple& described);

}  // namespace hovercraft_python
