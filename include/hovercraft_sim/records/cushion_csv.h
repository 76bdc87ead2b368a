#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/run_observer.h"

namespace hovercraft {

/// Writes the cells of all cushions as CSV with the header
/// `time,vehicle,cell,pressure,gap,flow,force,fan_speed,power`: s, name, number from 0 in the order
/// of the scenario, Pa, m, m³/s, N, of its fan a share of the nominal speed, W into the air of this
/// cell. Times are exact; numbers as appendNumber().
class HOVERCRAFT_PUBLIC CushionCsvWriter : public RunObserver {
 public:
  /// @throws std::invalid_argument if the file cannot be opened for writing, or no vehicle has a
  /// cushion.
  CushionCsvWriter(const std::string& path, const Scenario& scenario);

  void state(const Simulation& simulation) override;
  void close() override;

 private:
  OutputFile file_;
  std::vector<std::string> names_;  // of the vehicles
  CushionReport report_;
};

}  // namespace hovercraft
