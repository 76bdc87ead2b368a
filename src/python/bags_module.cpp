#include <cstdint>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "hovercraft_sim/bags/bag_writer.h"
#include "hovercraft_sim/bags/commands_bag.h"
#include "hovercraft_sim/bags/trajectory_file.h"
#include "hovercraft_sim/python/command_list.h"
#include "hovercraft_sim/python/rows.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/run.h"
#include "hovercraft_sim/sim/snapshot.h"

/// The extension module hovercraft_core._bags: bags, by the package's own reader and writer. It is
/// loaded when a bag is asked for, as it needs the libraries of ROS.

namespace hovercraft_python {
namespace {

namespace py = pybind11;

hovercraft::Scenario scenarioOf(const std::string& yaml) {
  return hovercraft::parseScenario(yaml, {"scenario", "", {}, {}});
}

CommandRows bagCommands(const std::string& path, const std::string& scenario) {
  hovercraft_ros::BagCommandSource source(path, scenarioOf(scenario));
  return rowsOf(allOf(source));
}

/// Flies again what was flown, into a bag.
/// @param snapshot where the run began.
void writeBag(const std::string& path, const std::string& yaml, const std::string& snapshot,
              const CommandRows& rows, std::int64_t last_tick, std::int64_t every) {
  const hovercraft::Scenario scenario = scenarioOf(yaml);
  CommandList commands(commandsOf(rows, scenario));
  hovercraft::Simulation simulation(scenario);
  simulation.restore(hovercraft::parseSnapshot(snapshot, "snapshot", scenario));
  const py::gil_scoped_release release;
  hovercraft_ros::BagWriter writer(path, scenario);
  hovercraft::RunPlan plan;
  plan.last_tick = last_tick;
  plan.every = every;
  hovercraft::run(simulation, commands, writer, plan);
}

}  // namespace

PYBIND11_MODULE(_bags, module) {
  // Their types are known to numpy from there, for all extension modules of a process.
  py::module_::import("hovercraft_core._core");
  module.def("bag_commands", bagCommands);
  module.def("bag_trajectories", [](const std::string& path) {
    return toPython(hovercraft_ros::readBagTrajectories(path));
  });
  module.def("write_bag", writeBag);
}

}  // namespace hovercraft_python
