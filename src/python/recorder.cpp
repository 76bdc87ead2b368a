#include "hovercraft_sim/python/recorder.h"

#include <algorithm>
#include <stdexcept>

#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/sensors/laser_model.h"

namespace hovercraft_python {

using hovercraft::Simulation;
using hovercraft::Vector3;

namespace {

std::array<double, 3> arrayOf(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

StateRow stateRow(const Simulation& simulation, std::size_t body) {
  const std::size_t vehicles = simulation.scenario().vehicles.size();
  return stateRow(
      simulation.tick(), simulation.scenario().step_ns,
      body < vehicles ? simulation.motion(body) : simulation.bodyMotion(body - vehicles));
}

StateRow stateRow(hovercraft::Tick tick, std::int64_t step_ns, const hovercraft::Motion& motion) {
  return {tick,
          hovercraft::toSeconds(tick * step_ns),
          arrayOf(motion.p_WB),
          {motion.q_WB.v.x(), motion.q_WB.v.y(), motion.q_WB.v.z(), motion.q_WB.s},
          arrayOf(motion.twist.v_WB),
          arrayOf(motion.twist.w_WB),
          arrayOf(motion.momentum_W),
          arrayOf(motion.angular_momentum_W),
          motion.energy};
}

ActuatorRow actuatorRow(const hovercraft::EngineReport& report) {
  return {report.commanded, report.applied, report.command_age, report.saturated, report.timed_out};
}

std::vector<ActuatorRow> actuatorRows(const Simulation& simulation, std::size_t vehicle) {
  std::vector<ActuatorRow> rows;
  const std::size_t count = simulation.state().engines[vehicle].size();
  rows.reserve(count);
  for (std::size_t id = 0; id < count; ++id) {
    rows.push_back(actuatorRow(simulation.engineReport(vehicle, static_cast<int>(id))));
  }
  return rows;
}

Recorder::Recorder(const hovercraft::Scenario& scenario, std::uint64_t rows) : scenario_(scenario) {
  const std::size_t loose = scenario.world ? scenario.world->bodies.size() : 0;
  recording.states.resize(scenario.vehicles.size() + loose);
  row_bytes_ = recording.states.size() * sizeof(StateRow);
  for (const hovercraft::VehicleScenario& vehicle : scenario.vehicles) {
    row_bytes_ += parametersOf(vehicle).size() * sizeof(ActuatorRow);
    recording.samples.emplace_back(vehicle.sensors.size());
  }
  recording.actuators.resize(scenario.vehicles.size());
  if (rows > kMostBytes / row_bytes_) grow(kMostBytes + 1);
}

void Recorder::grow(std::size_t bytes) {
  bytes_ += bytes;
  if (bytes_ <= kMostBytes) return;
  throw std::invalid_argument(
      "run: its arrays must take at most 4 GiB: take a greater every, or a shorter duration");
}

void Recorder::state(const Simulation& simulation) {
  grow(row_bytes_);
  for (std::size_t body = 0; body < recording.states.size(); ++body) {
    recording.states[body].push_back(stateRow(simulation, body));
  }
  for (std::size_t vehicle = 0; vehicle < recording.actuators.size(); ++vehicle) {
    for (const ActuatorRow& row : actuatorRows(simulation, vehicle)) {
      recording.actuators[vehicle].push_back(row);
    }
  }
}

std::int32_t Recorder::indexOf(std::string_view name) {
  auto& names = recording.names;
  const auto found = std::find(names.begin(), names.end(), name);
  const auto index = static_cast<std::int32_t>(found - names.begin());
  if (found == names.end()) names.emplace_back(name);
  return index;
}

void Recorder::contact(const hovercraft::ContactEvent& event) {
  grow(sizeof(ContactRow));
  recording.contacts.push_back({event.tick, event.time, static_cast<std::int32_t>(event.kind),
                                indexOf(event.a), indexOf(event.b), arrayOf(event.p_WC),
                                arrayOf(event.nhat_AB_W), arrayOf(event.impulse_B_W)});
}

void Recorder::sample(const hovercraft::SensorSample& sample) {
  grow((sample.count + 2) * sizeof(double));
  SampleColumns& columns = recording.samples[sample.vehicle][sample.sensor];
  columns.measured.push_back(sample.measured);
  columns.delivered.push_back(sample.delivered);
  const auto& sensor = scenario_.vehicles[sample.vehicle].sensors[sample.sensor];
  const auto* const laser = std::get_if<hovercraft::LaserParameters>(&sensor.model);
  for (std::size_t i = 0; i < sample.count; ++i) {
    const double value = sample.values[i];
    columns.values.push_back(laser != nullptr ? hovercraft::reportedRange(*laser, value) : value);
  }
}

}  // namespace hovercraft_python
