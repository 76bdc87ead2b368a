#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "hovercraft_sim/analysis/closest_report.h"
#include "hovercraft_sim/analysis/compare.h"
#include "hovercraft_sim/analysis/mass_report.h"
#include "hovercraft_sim/python/command_list.h"
#include "hovercraft_sim/python/held_scenario.h"
#include "hovercraft_sim/python/recorder.h"
#include "hovercraft_sim/python/rows.h"
#include "hovercraft_sim/python/stepped_batch.h"
#include "hovercraft_sim/python/stepped_simulation.h"
#include "hovercraft_sim/python/studies.h"
#include "hovercraft_sim/records/commands_csv.h"
#include "hovercraft_sim/records/states_csv.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/version.h"
#include "hovercraft_sim/scenario/world_builder.h"

/// The extension module hovercraft_core._core: the core as Python's package hovercraft_core asks
/// for it. It knows no ROS.

namespace hovercraft_python {
namespace {

namespace py = pybind11;

using PackageFolder = std::function<std::string(const std::string&)>;

/// Lets Python's signals in; ends the call with the exception of a handler.
void lookAtSignals() {
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

py::dict toPython(const Recording& recording) {
  py::list states;
  for (const auto& rows : recording.states) states.append(arrayOf(rows));
  py::list actuators;
  for (const auto& rows : recording.actuators) actuators.append(arrayOf(rows));
  py::list samples;
  for (const auto& craft : recording.samples) {
    py::list sensors;
    for (const SampleColumns& columns : craft) {
      sensors.append(py::make_tuple(arrayOf(columns.measured), arrayOf(columns.delivered),
                                    arrayOf(columns.values)));
    }
    samples.append(sensors);
  }
  py::dict result;
  result["states"] = states;
  result["actuators"] = actuators;
  result["contacts"] = arrayOf(recording.contacts);
  result["names"] = recording.names;
  result["samples"] = samples;
  return result;
}

/// By id: the name, and whether the craft has it.
std::vector<std::pair<std::string, bool>> actuatorsOf(const hovercraft::VehicleScenario& craft) {
  std::vector<std::pair<std::string, bool>> actuators;
  const std::size_t count = parametersOf(craft).size();
  for (std::size_t id = 0; id < count; ++id) {
    const bool is_there = id >= hovercraft::kFirstActuator || craft.has_engine[id];
    actuators.emplace_back(actuatorName(craft, id), is_there);
  }
  return actuators;
}

/// Of each sensor: name, kind, names of its numbers.
py::list sensorsOf(const hovercraft::VehicleScenario& craft) {
  py::list list;
  for (const hovercraft::SensorParameters& sensor : craft.sensors) {
    const auto kind = static_cast<std::size_t>(sensor.kind());
    list.append(py::make_tuple(sensor.name, hovercraft::sensorKindNames()[kind],
                               hovercraft::sampleFields(sensor)));
  }
  return list;
}

/// Least and greatest thrust (N) or level.
std::pair<double, double> limitsOf(const HeldScenario& self, const std::string& vehicle,
                                   const std::string& actuator) {
  const auto& vehicles = self.scenario()->vehicles;
  const hovercraft::VehicleScenario& craft = vehicles[craftIndex(*self.scenario(), vehicle)];
  const auto parameters = parametersOf(craft);
  for (std::size_t id = 0; id < parameters.size(); ++id) {
    if (actuatorName(craft, id) == actuator) {
      return {parameters[id].min_thrust, parameters[id].max_thrust};
    }
  }
  throw std::invalid_argument("actuator = " + actuator + ": the craft has none of this name");
}

void bindScenario(py::module_& module) {
  py::class_<HeldScenario>(module, "Scenario")
      .def(py::init([](const std::string& text, const std::string& name,
                       const std::string& directory, PackageFolder package_folder) {
             return std::make_unique<HeldScenario>(
                 text, hovercraft::ScenarioSource{name, directory, std::move(package_folder), {}});
           }),
           py::arg("text"), py::arg("name"), py::arg("directory"), py::arg("package_folder"))
      .def_static("load", &HeldScenario::load)
      .def("set", &HeldScenario::set)
      .def("with_values",
           [](const HeldScenario& self, const std::string& assignments) {
             HeldScenario changed(self);
             changed.set(assignments);
             return changed;
           })
      .def("yaml", [](const HeldScenario& self) { return toYaml(*self.scenario()); })
      .def("step_ns", [](const HeldScenario& self) { return self.scenario()->step_ns; })
      .def("seed", [](const HeldScenario& self) { return self.scenario()->seed; })
      .def("vehicles",
           [](const HeldScenario& self) {
             py::list list;
             for (const auto& craft : self.scenario()->vehicles) {
               list.append(py::make_tuple(craft.name, actuatorsOf(craft), sensorsOf(craft)));
             }
             return list;
           })
      .def("limits", limitsOf)
      .def("obstacles",
           [](const HeldScenario& self) -> std::optional<std::vector<std::string>> {
             if (!self.scenario()->world) return std::nullopt;
             std::vector<std::string> names;
             for (const auto& one : self.scenario()->world->obstacles) names.push_back(one.name);
             return names;
           })
      .def("bodies", [](const HeldScenario& self) {
        std::vector<std::string> names;
        if (self.scenario()->world) {
          for (const auto& body : self.scenario()->world->bodies) names.push_back(body.name);
        }
        return names;
      });
}

py::dict runOf(SteppedSimulation& self, const CommandRows& rows, double duration,
               std::int64_t every) {
  std::vector<hovercraft::Command> commands = commandsOf(rows, *self.scenario());
  Recording recording;
  {
    const py::gil_scoped_release release;
    recording = self.run(std::move(commands), duration, every, lookAtSignals);
  }
  return toPython(recording);
}

void commandOf(SteppedSimulation& self, std::size_t vehicle,
               const std::vector<std::pair<std::size_t, double>>& values) {
  const auto& vehicles = self.scenario()->vehicles;
  if (vehicle >= vehicles.size()) throw std::invalid_argument("command: no such vehicle");
  hovercraft::Command command{0, vehicle, 0, {}};
  command.thrusts.resize(parametersOf(vehicles[vehicle]).size());
  for (const auto& [id, value] : values) {
    if (id >= command.thrusts.size()) throw std::invalid_argument("command: no such actuator");
    command.thrusts[id] = value;
    command.engines = static_cast<hovercraft::EngineMask>(command.engines | hovercraft::maskOf(id));
  }
  if (!allFinite(command.thrusts)) throw std::invalid_argument("command: must be finite");
  self.command(command);
}

void bindSimulation(py::module_& module) {
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<SavedState>(module, "Saved").doc() = "What Simulation.save() returns.";
  py::class_<SteppedSimulation>(module, "Simulation")
      .def(py::init([](const HeldScenario& scenario, std::optional<std::int64_t> seed) {
        ScenarioPointer held = scenario.scenario();  // another thread may set() meanwhile
        const py::gil_scoped_release release;
        return std::make_unique<SteppedSimulation>(std::move(held), seed);
      }))
      .def("step",
           [](SteppedSimulation& self, std::int64_t count) {
             const py::gil_scoped_release release;
             self.step(count, lookAtSignals);
           })
      .def("run", runOf)
      .def("command", commandOf)
      .def(
          "apply_wrench",
          [](SteppedSimulation& self, const std::string& vehicle, const Triple& force,
             const Triple& torque, double duration, const std::string& frame) {
            self.applyWrench(vehicle, {force, torque, duration, frame});
          },
          Released())
      .def(
          "set_state",
          [](SteppedSimulation& self, const std::string& vehicle, const Triple& position,
             const Quadruple& orientation, const Triple& velocity, const Triple& angular_velocity) {
            self.setMotion(vehicle, {position, orientation, velocity, angular_velocity});
          },
          Released())
      .def("set_wind", &SteppedSimulation::setWind, Released())
      .def("reset", &SteppedSimulation::reset, Released())
      .def("save", &SteppedSimulation::save, Released())
      .def("restore", &SteppedSimulation::restore, Released())
      .def("snapshot", &SteppedSimulation::snapshot, Released())
      .def("restore_snapshot", &SteppedSimulation::restoreSnapshot, Released())
      .def("hash", &SteppedSimulation::hash, Released())
      .def("sensor_hash", &SteppedSimulation::sensorHash, Released())
      .def("tick", &SteppedSimulation::tick, Released())
      .def("time_ns", &SteppedSimulation::timeNs, Released())
      .def("seed", &SteppedSimulation::seed, Released())
      .def("yaml", [](const SteppedSimulation& self) { return toYaml(*self.scenario()); })
      .def("states",
           [](SteppedSimulation& self) {
             std::vector<StateRow> rows;
             {
               const py::gil_scoped_release release;
               rows = self.states();
             }
             return arrayOf(rows);
           })
      .def("actuators", [](SteppedSimulation& self, std::size_t vehicle) {
        if (vehicle >= self.scenario()->vehicles.size()) {
          throw std::invalid_argument("actuators: no such vehicle");
        }
        return arrayOf(self.actuators(vehicle));
      });
}

using Table =
    std::tuple<std::string, std::vector<std::string>, std::vector<double>, std::vector<double>>;

CommandRows tableCommands(const SteppedSimulation& simulation, const std::vector<Table>& tables) {
  std::vector<CommandTable> read;
  read.reserve(tables.size());
  for (const auto& [vehicle, names, times, values] : tables) {
    read.push_back({vehicle, names, times, values});
  }
  return rowsOf(commandsOf(read, *simulation.scenario()));
}

CommandRows csvCommands(const SteppedSimulation& simulation, const std::string& path) {
  hovercraft::CsvCommandSource source(path, *simulation.scenario());
  return rowsOf(allOf(source));
}

py::dict toPython(const hovercraft::ErrorSummary& summary) {
  py::dict result;
  result["max"] = summary.max;
  result["max_time"] = 1e-9 * static_cast<double>(summary.max_time_ns);
  result["rms"] = summary.rms;
  result["final"] = summary.final;
  return result;
}

/// A row of the errors over time.
struct ErrorRow {
  double time;
  double position;
  double attitude;
  double relative_position;
  double relative_attitude;
};

hovercraft::SampleMatching matchingOf(const std::string& name) {
  static const std::map<std::string, hovercraft::SampleMatching> matchings = {
      {"exact", hovercraft::SampleMatching::kExact},
      {"common", hovercraft::SampleMatching::kCommon},
      {"interpolated", hovercraft::SampleMatching::kInterpolated}};
  const auto found = matchings.find(name);
  if (found == matchings.end()) {
    throw std::invalid_argument("matching = " + name + ": must be exact, common or interpolated");
  }
  return found->second;
}

py::dict toPython(const hovercraft::Comparison& comparison,
                  const hovercraft::CompareOptions& options) {
  std::vector<ErrorRow> rows;
  rows.reserve(comparison.errors.size());
  for (const hovercraft::TrajectoryError& error : comparison.errors) {
    rows.push_back({1e-9 * static_cast<double>(error.time_ns), error.position, error.attitude,
                    error.relative_position, error.relative_attitude});
  }
  py::dict result;
  result["is_within"] = comparison.is_within;
  result["position"] = toPython(comparison.position);
  result["attitude"] = toPython(comparison.attitude);
  result["relative_position"] = toPython(comparison.relative_position);
  result["relative_attitude"] = toPython(comparison.relative_attitude);
  result["errors"] = arrayOf(rows);
  result["text"] = toText(comparison, options);
  return result;
}

/// @param tolerances m and rad, of position and attitude.
py::dict comparisonOf(const py::tuple& a, const py::tuple& b,
                      const std::array<std::optional<double>, 2>& tolerances,
                      const std::string& matching, bool relative, bool from_start) {
  hovercraft::CompareOptions options;
  options.position_tolerance = tolerances[0];
  options.attitude_tolerance = tolerances[1];
  options.relative = relative;
  options.from_start = from_start;
  options.matching = matchingOf(matching);
  return toPython(compareTrajectories(trajectoryFrom(a), trajectoryFrom(b), options), options);
}

std::string closestJson(const std::string& a, const std::string& b,
                        const std::vector<double>& pose_a, const std::vector<double>& pose_b,
                        bool hull, const Triple& scale) {
  hovercraft::ClosestRequest request;
  request.mesh_a = a;
  request.mesh_b = b;
  request.pose_a = pose_a;
  request.pose_b = pose_b;
  request.hull = hull;
  request.json = true;
  request.scale = hovercraft::Vector3(scale[0], scale[1], scale[2]);
  try {
    return hovercraft::closestReport(request);
  } catch (const std::runtime_error& error) {  // the bound on its steps
    throw std::invalid_argument(error.what());
  }
}

std::string massJson(const std::string& file, std::optional<double> density,
                     std::optional<double> mass, std::optional<Triple> scale,
                     const std::string& vehicle, const PackageFolder& package_folder) {
  hovercraft::MassReportRequest request;
  request.file = file;
  request.density = density;
  request.mass = mass;
  if (scale) request.scale = hovercraft::Vector3((*scale)[0], (*scale)[1], (*scale)[2]);
  request.vehicle = vehicle;
  request.json = true;
  return toJson(bodiesOf(request, [&](const std::string& path) {
    return hovercraft::loadScenario(path, package_folder);
  }));
}

}  // namespace

PYBIND11_MODULE(_core, module) {
  PYBIND11_NUMPY_DTYPE(StateRow, tick, time, position, orientation, velocity, angular_velocity,
                       momentum, angular_momentum, energy);
  PYBIND11_NUMPY_DTYPE(ActuatorRow, commanded, applied, age, saturated, timed_out);
  PYBIND11_NUMPY_DTYPE(ContactRow, tick, time, kind, a, b, point, normal, impulse);
  PYBIND11_NUMPY_DTYPE(ErrorRow, time, position, attitude, relative_position, relative_attitude);
  registerRows();
  bindScenario(module);
  bindSimulation(module);
  bindBatch(module, lookAtSignals);
  bindStudies(module);
  module.attr("version") = hovercraft::versionText("hovercraft_core");
  module.def("table_commands", tableCommands);
  module.def("csv_commands", csvCommands);
  module.def("csv_trajectories",
             [](const std::string& path) { return toPython(hovercraft::readStatesCsv(path)); });
  module.def("compare", comparisonOf);
  module.def("closest", closestJson);
  module.def("mass_properties", massJson);
}

}  // namespace hovercraft_python
