#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/run_observer.h"

namespace hovercraft {

/// Writes all engines and other actuators as CSV with the
/// header `time,vehicle,actuator,commanded,applied,efficiency,stuck,saturated,timed_out`: s, name,
/// name, as received, N or what the kind of the actuator says, 0 to 1, and three times 0 or 1. A
/// row for each actuator at each tick of output, by their ids. Times are exact; numbers as
/// appendNumber().
class HOVERCRAFT_PUBLIC ActuatorsCsvWriter : public RunObserver {
 public:
  /// @throws std::invalid_argument if the file cannot be opened for writing.
  ActuatorsCsvWriter(const std::string& path, const Scenario& scenario);

  void state(const Simulation& simulation) override;
  void close() override;

 private:
  struct Column {
    std::size_t vehicle = 0;
    int id = 0;
    std::string names;  // vehicle,actuator
  };

  OutputFile file_;
  std::vector<Column> actuators_;  // that the craft have
};

}  // namespace hovercraft
