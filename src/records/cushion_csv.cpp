#include "hovercraft_sim/records/cushion_csv.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft {

CushionCsvWriter::CushionCsvWriter(const std::string& path, const Scenario& scenario)
    : file_(path) {
  const auto has_cushion = [](const VehicleScenario& vehicle) {
    return vehicle.cushion.has_value();
  };
  if (std::none_of(scenario.vehicles.begin(), scenario.vehicles.end(), has_cushion)) {
    throw std::invalid_argument(
        fmt::format("--cushion = {}: no vehicle of the scenario has a cushion", path));
  }
  for (const VehicleScenario& vehicle : scenario.vehicles) names_.push_back(vehicle.name);
  const std::string header = "time,vehicle,cell,pressure,gap,flow,force,fan_speed,power\n";
  file_.write(header.data(), header.size());
}

void CushionCsvWriter::state(const Simulation& simulation) {
  for (std::size_t vehicle = 0; vehicle < names_.size(); ++vehicle) {
    simulation.cushionReport(vehicle, report_);
    const auto& cushion = simulation.scenario().vehicles[vehicle].cushion;
    for (std::size_t i = 0; i < report_.cells.size(); ++i) {
      const CellReport& cell = report_.cells[i];
      const std::string row = fmt::format(
          "{},{},{},{},{},{},{},{},{}\n", secondsText(simulation.timeNs()), names_[vehicle], i,
          numberText(cell.pressure), numberText(cell.gap), numberText(cell.flow),
          numberText(cell.force), numberText(report_.fan_speeds[cushion->cells[i].fan]),
          numberText(cell.pressure * cell.flow));
      file_.write(row.data(), row.size());
    }
  }
}

void CushionCsvWriter::close() {
  file_.close();
}

}  // namespace hovercraft
