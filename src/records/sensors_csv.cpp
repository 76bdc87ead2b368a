#include "hovercraft_sim/records/sensors_csv.h"

#include <filesystem>
#include <fmt/format.h>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/sensors/laser_model.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft {
namespace {

namespace fs = std::filesystem;

void makeFolder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && fs::is_directory(folder, error)) return;
  throw std::invalid_argument(
      fmt::format("--sensors = {}: must be a folder, or a name where one can be made", folder));
}

std::string headerOf(const SensorParameters& sensor) {
  std::string header = "time,delivered";
  for (const std::string& field : sampleFields(sensor)) header += "," + field;
  return header + "\n";
}

}  // namespace

SensorsCsvWriter::SensorsCsvWriter(const std::string& folder, const Scenario& scenario,
                                   const std::vector<std::string>& taken)
    : step_ns_(scenario.step_ns) {
  std::vector<OutputOption> outputs;
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    for (const SensorParameters& sensor : vehicle.sensors) {
      const fs::path path = fs::path(folder) / (vehicle.name + "." + sensor.name + ".csv");
      outputs.push_back({"--sensors", path.string()});
    }
  }
  if (outputs.empty()) {
    throw std::invalid_argument("--sensors = " + folder + ": no vehicle of the scenario has any");
  }
  makeFolder(folder);
  std::vector<std::string> inputs;
  for (const std::string& path : taken) {
    if (!path.empty() && path != "-") inputs.push_back(path);
  }
  checkOutputs(outputs, inputs);
  auto output = outputs.begin();
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    sensors_.emplace_back();
    for (const SensorParameters& sensor : vehicle.sensors) {
      auto file = std::make_unique<OutputFile>((output++)->path);
      const std::string header = headerOf(sensor);
      file->write(header.data(), header.size());
      sensors_.back().push_back({sensor, std::move(file)});
    }
  }
}

void SensorsCsvWriter::sample(const SensorSample& sample) {
  const Sensor& sensor = sensors_[sample.vehicle][sample.sensor];
  const auto* const laser = std::get_if<LaserParameters>(&sensor.parameters.model);
  fmt::memory_buffer row;
  appendSeconds(row, sample.measured * step_ns_);
  row.push_back(',');
  appendSeconds(row, sample.delivered * step_ns_);
  for (std::size_t i = 0; i < sample.count; ++i) {
    row.push_back(',');
    appendNumber(row,
                 laser != nullptr ? reportedRange(*laser, sample.values[i]) : sample.values[i]);
  }
  row.push_back('\n');
  sensor.file->write(row.data(), row.size());
}

void SensorsCsvWriter::close() {
  for (auto& craft : sensors_) {
    for (Sensor& sensor : craft) sensor.file->close();
  }
}

}  // namespace hovercraft
