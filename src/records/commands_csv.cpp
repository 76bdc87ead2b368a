#include "hovercraft_sim/records/commands_csv.h"

#include <algorithm>
#include <fmt/format.h>

#include "hovercraft_sim/io/number_text.h"

namespace hovercraft {
namespace {

constexpr std::size_t kTimeColumn = 0;
constexpr std::size_t kVehicleColumn = 1;

/// The id of each column's actuator, from column `first` on; kMaxActuators where the craft has
/// none.
std::vector<std::size_t> idsOfColumns(const VehicleScenario& vehicle,
                                      const std::vector<std::string>& header, std::size_t first) {
  std::vector<std::size_t> ids(header.size(), kMaxActuators);
  for (std::size_t column = first; column < header.size(); ++column) {
    for (std::size_t i = 0; i < kEngineNames.size(); ++i) {
      if (header[column] == kEngineNames[i]) ids[column] = i;
    }
    for (std::size_t i = 0; i < vehicle.actuators.size(); ++i) {
      if (header[column] == vehicle.actuators[i].name) ids[column] = kFirstActuator + i;
    }
  }
  return ids;
}

}  // namespace

CsvCommandSource::CsvCommandSource(const std::string& path, const Scenario& scenario,
                                   InputKind kind)
    : reader_(path, kind),
      step_ns_(scenario.step_ns),
      has_vehicle_column_(reader_.hasColumn("vehicle")),
      first_value_(has_vehicle_column_ ? 2 : 1) {
  for (const VehicleScenario& vehicle : scenario.vehicles) vehicles_.push_back(vehicle.name);
  const bool has_actuators =
      std::any_of(scenario.vehicles.begin(), scenario.vehicles.end(),
                  [](const VehicleScenario& vehicle) { return !vehicle.actuators.empty(); });
  if (!has_actuators || reader_.header().size() < first_value_) requireEngineColumns();
  if (has_actuators) requireColumns(scenario);
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    ids_.push_back(idsOfColumns(vehicle, reader_.header(), first_value_));
  }
}

/// The header of craft without actuators besides their engines.
void CsvCommandSource::requireEngineColumns() const {
  const char* with_vehicle = "time,vehicle,rear,left,right";
  if (vehicles_.size() == 1) {
    reader_.requireHeader({"time,rear,left,right", with_vehicle});
  } else {
    reader_.requireHeader({with_vehicle});
  }
}

void CsvCommandSource::requireColumns(const Scenario& scenario) const {
  const std::vector<std::string>& header = reader_.header();
  const bool begins_well = header.size() > first_value_ && header[kTimeColumn] == "time" &&
                           (!has_vehicle_column_ || header[kVehicleColumn] == "vehicle") &&
                           (has_vehicle_column_ || vehicles_.size() == 1);
  if (!begins_well) reader_.fail("the header must be time, vehicle if there are several, names");
  for (std::size_t column = first_value_; column < header.size(); ++column) {
    const auto has_it = [&](const VehicleScenario& vehicle) {
      return idsOfColumns(vehicle, header, first_value_)[column] < kMaxActuators;
    };
    const auto place = header.begin() + static_cast<std::ptrdiff_t>(column);
    if (std::none_of(scenario.vehicles.begin(), scenario.vehicles.end(), has_it) ||
        std::find(header.begin(), place, *place) != place) {
      reader_.fail(
          fmt::format("the header: {} must be an engine or an actuator, and stand once", *place));
    }
  }
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

  Command command{firstTickAt(time_ns, step_ns_), vehicleOfRow(), 0, {}};
  const std::vector<std::size_t>& ids = ids_[command.vehicle];
  for (std::size_t column = first_value_; column < ids.size(); ++column) {
    if (reader_.text(column).empty()) continue;
    const std::size_t id = ids[column];
    if (id == kMaxActuators) reader_.fail(column, "the vehicle has no such actuator");
    if (command.thrusts.size() <= id) command.thrusts.resize(id + 1);
    command.thrusts[id] = reader_.number(column);
    command.engines = static_cast<EngineMask>(command.engines | maskOf(id));
  }
  if (command.engines == 0) reader_.fail("must have a thrust for at least one engine");
  return command;
}

}  // namespace hovercraft
