#include "hovercraft_sim/sim/snapshot_sensors.h"

#include <algorithm>
#include <fmt/format.h>

#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

std::string numbersText(const double* numbers, std::size_t count) {
  std::string text = "[";
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) text += ", ";
    text += yamlNumber(numbers[i]);
  }
  return text + "]";
}

std::string sensorText(const std::string& name, const SensorState& state) {
  std::string yaml = fmt::format("    {}: {{memory: {}", yamlText(name),
                                 numbersText(state.memory.data(), state.memory.size()));
  if (!state.pending.empty()) yaml += ", samples: [";
  for (std::size_t i = 0; i < state.pending.size(); ++i) {
    yaml += fmt::format("{}{{tick: {}, values: {}}}", i > 0 ? ", " : "", state.pending.tick(i),
                        numbersText(state.pending.values(i), state.pending.width()));
  }
  return yaml + (state.pending.empty() ? "}\n" : "]}\n");
}

void requireSensorCount(const ConfigReader& reader, const std::string& key, std::size_t count) {
  if (reader.map(key).maps().size() == count) return;
  reader.fail(key, "must hold those of the scenario and no other");
}

Tick tickOf(const ConfigReader& sample, Tick latest) {
  sample.text("tick");  // must be there
  const Tick tick = sample.wholeNumberOr(0, "tick");
  if (tick < 1 || tick > latest) sample.fail("tick", fmt::format("must be 1 to {}", latest));
  return tick;
}

std::vector<double> exactNumbers(const ConfigReader& reader, const char* key, std::size_t count) {
  std::vector<double> numbers = reader.numbers(key, count);
  if (numbers.size() != count) reader.fail(key, fmt::format("must be {} numbers", count));
  return numbers;
}

/// @param state of the same sensor at the start of a run: it has the sizes. Ticks are checked by
/// SensorSuite::fits().
void parseSensor(const ConfigReader& reader, Tick tick, SensorState& state) {
  reader.allowOnly({"memory", "samples"});
  state.memory = exactNumbers(reader, "memory", state.memory.size());
  if (!reader.has("samples")) return;
  const std::vector<ConfigReader> samples = reader.list("samples");
  if (samples.size() > state.pending.capacity()) {
    reader.fail("samples", fmt::format("must be at most {}", state.pending.capacity()));
  }
  for (const ConfigReader& sample : samples) {
    sample.allowOnly({"tick", "values"});
    const std::vector<double> values = exactNumbers(sample, "values", state.pending.width());
    std::copy(values.begin(), values.end(), state.pending.push(tickOf(sample, tick)));
  }
}

}  // namespace

std::string sensorStatesText(const Simulation& simulation) {
  const Scenario& scenario = simulation.scenario();
  const SimulationState& state = simulation.state();
  if (state.sensors.empty()) return "";
  std::string yaml = fmt::format("sensor_hash: '{:016x}'\nsensors:\n", simulation.sensorHash());
  std::size_t index = 0;
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    if (vehicle.sensors.empty()) continue;
    yaml += fmt::format("  {}:\n", yamlText(vehicle.name));
    for (const SensorParameters& sensor : vehicle.sensors) {
      yaml += sensorText(sensor.name, state.sensors[index++]);
    }
  }
  return yaml;
}

std::vector<SensorState> parseSensorStates(const ConfigReader& reader, Tick tick,
                                           const Simulation& started) {
  std::vector<SensorState> states = started.state().sensors;
  if (states.empty()) {
    if (reader.has("sensors")) reader.fail("sensors", "there are none in the scenario");
    return states;
  }
  const ConfigReader craft = reader.map("sensors");
  std::size_t carriers = 0;
  std::size_t index = 0;
  for (const VehicleScenario& vehicle : started.scenario().vehicles) {
    if (vehicle.sensors.empty()) continue;
    ++carriers;
    requireSensorCount(craft, vehicle.name, vehicle.sensors.size());
    const ConfigReader sensors = craft.map(vehicle.name);
    for (const SensorParameters& sensor : vehicle.sensors) {
      parseSensor(sensors.map(sensor.name), tick, states[index++]);
    }
  }
  requireSensorCount(reader, "sensors", carriers);
  if (!started.sensors()->fits(states, tick)) {
    reader.fail("sensors",
                "samples must be of ticks at which the sensor is read, ascending, and "
                "still on their way");
  }
  return states;
}

void checkSensorHash(const ConfigReader& reader, const Simulation& simulation) {
  if (simulation.sensors() == nullptr) return;
  const std::string hash = fmt::format("{:016x}", simulation.sensorHash());
  if (reader.text("sensor_hash") == hash) return;
  reader.fail("sensor_hash", fmt::format("must be that of the sensors, {}: it was changed", hash));
}

}  // namespace hovercraft
