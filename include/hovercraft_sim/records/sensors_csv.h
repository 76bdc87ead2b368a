#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/run_observer.h"

namespace hovercraft {

/// Writes the samples of each sensor as CSV into a file of
/// its own, FOLDER/VEHICLE.SENSOR.csv: `time,delivered` (s), then the columns of sampleFields().
/// Ranges as reportedRange(). Numbers as appendNumber().
class HOVERCRAFT_PUBLIC SensorsCsvWriter : public RunObserver {
 public:
  /// @param folder made if it is not there. @param taken files that must stay (checkOutputs()).
  /// @throws std::invalid_argument if it, or a file in it, cannot be made, or if no craft has a
  /// sensor.
  SensorsCsvWriter(const std::string& folder, const Scenario& scenario,
                   const std::vector<std::string>& taken);

  void sample(const SensorSample& sample) override;
  void close() override;

 private:
  struct Sensor {
    SensorParameters parameters;
    std::unique_ptr<OutputFile> file;
  };

  std::int64_t step_ns_;
  std::vector<std::vector<Sensor>> sensors_;  // of each vehicle
};

}  // namespace hovercraft
