#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/io/csv_reader.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/command_source.h"

namespace hovercraft {

/// Commands from a CSV file with the header `time,rear,left,right` (one vehicle) or
/// `time,vehicle,rear,left,right`: seconds, never decreasing, and thrusts in N. A row takes effect
/// at the first tick with t >= time and holds until the next one; it is not for an engine whose
/// field is empty. With actuators besides the engines the columns after time and vehicle are those
/// of engines and actuators by their names, in any order, each at most once.
class HOVERCRAFT_PUBLIC CsvCommandSource : public CommandSource {
 public:
  /// @throws std::invalid_argument if the file cannot be read or its header is not right for the
  /// scenario.
  CsvCommandSource(const std::string& path, const Scenario& scenario,
                   InputKind kind = InputKind::kFile);

  [[nodiscard]] std::optional<Command> next() override;

 private:
  void requireEngineColumns() const;
  void requireColumns(const Scenario& scenario) const;
  std::size_t vehicleOfRow() const;

  CsvReader reader_;
  std::int64_t step_ns_;
  std::vector<std::string> vehicles_;
  bool has_vehicle_column_;
  std::size_t first_value_ = 1;                // column
  std::vector<std::vector<std::size_t>> ids_;  // by vehicle and column; kMaxActuators: has none
  std::int64_t last_time_ns_ = 0;
};

}  // namespace hovercraft
