#include "hovercraft_sim/records/actuators_csv.h"

#include <fmt/format.h>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft {

ActuatorsCsvWriter::ActuatorsCsvWriter(const std::string& path, const Scenario& scenario)
    : file_(path) {
  for (std::size_t vehicle = 0; vehicle < scenario.vehicles.size(); ++vehicle) {
    const VehicleScenario& craft = scenario.vehicles[vehicle];
    for (std::size_t id = 0; id < kFirstActuator + craft.actuators.size(); ++id) {
      if (id < kFirstActuator && !craft.has_engine[id]) continue;
      actuators_.push_back(
          {vehicle, static_cast<int>(id), craft.name + "," + actuatorName(craft, id)});
    }
  }
  const std::string header =
      "time,vehicle,actuator,commanded,applied,efficiency,stuck,saturated,timed_out\n";
  file_.write(header.data(), header.size());
}

void ActuatorsCsvWriter::state(const Simulation& simulation) {
  const std::string time = secondsText(simulation.timeNs());
  for (const Column& actuator : actuators_) {
    const EngineReport report = simulation.engineReport(actuator.vehicle, actuator.id);
    const std::string row = fmt::format("{},{},{},{},{},{:d},{:d},{:d}\n", time, actuator.names,
                                        numberText(report.commanded), numberText(report.applied),
                                        numberText(report.efficiency), report.stuck ? 1 : 0,
                                        report.saturated ? 1 : 0, report.timed_out ? 1 : 0);
    file_.write(row.data(), row.size());
  }
}

void ActuatorsCsvWriter::close() {
  file_.close();
}

}  // namespace hovercraft
