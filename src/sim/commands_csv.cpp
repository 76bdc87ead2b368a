#include "hovercraft_sim/sim/commands_csv.h"

#include <algorithm>
#include <fmt/format.h>

#include "hovercraft_sim/sim/number_text.h"

namespace hovercraft {
namespace {

constexpr std::size_t kTimeColumn = 0;
constexpr std::size_t kVehicleColumn = 1;

}  // namespace

CsvCommandSource::CsvCommandSource(const std::string& path, const Scenario& scenario,
                                   InputKind kind)
    : reader_(path, kind),
      step_ns_(scenario.step_ns),
      has_vehicle_column_(reader_.hasColumn("vehicle")) {
  const char* with_vehicle = "time,vehicle,rear,left,right";
  if (scenario.vehicles.size() == 1) {
    reader_.requireHeader({"time,rear,left,right", with_vehicle});
  } else {
    reader_.requireHeader({with_vehicle});
  }
  for (const VehicleScenario& vehicle : scenario.vehicles) vehicles_.push_back(vehicle.name);
}

std::size_t CsvCommandSource::vehicleOfRow() const {
  if (!has_vehicle_column_) return 0;
  const auto found = std::find(vehicles_.begin(), vehicles_.end(), reader_.text(kVehicleColumn));
  if (found == vehicles_.end()) {
    reader_.fail(kVehicleColumn,
                 fmt::format("must be a vehicle of the scenario: {}", fmt::join(vehicles_, ", ")));
  }
  return static_cast<std::size_t>(found - vehicles_.begin());
}

std::optional<Command> CsvCommandSource::next() {
  if (!reader_.next()) return std::nullopt;
  const std::int64_t time_ns = reader_.timeNs(kTimeColumn);
  if (time_ns < last_time_ns_) {
    reader_.fail(kTimeColumn, fmt::format("must not be less than the time before it, {}",
                                          secondsText(last_time_ns_)));
  }
  last_time_ns_ = time_ns;

  Command command{firstTickAt(time_ns, step_ns_), vehicleOfRow(), 0, Vector3::Zero()};
  const std::size_t first_engine = has_vehicle_column_ ? 2 : 1;
  for (int i = 0; i < kEngineCount; ++i) {
    const std::size_t column = first_engine + static_cast<std::size_t>(i);
    if (reader_.text(column).empty()) continue;
    command.thrusts[i] = reader_.number(column);
    command.engines = static_cast<EngineMask>(command.engines | maskOf(static_cast<EngineId>(i)));
  }
  if (command.engines == 0) reader_.fail("must have a thrust for at least one engine");
  return command;
}

}  // namespace hovercraft
