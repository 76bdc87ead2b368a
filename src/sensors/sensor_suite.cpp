#include "hovercraft_sim/sensors/sensor_suite.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/noise.h"

namespace hovercraft {

struct SensorSuite::Sensor {
  std::size_t vehicle = 0;
  std::size_t index = 0;  // among those of the vehicle
  Tick period = 1;
  Tick latency = 0;
  double drop = 0.0;
  std::uint32_t drop_stream = 0;
  std::unique_ptr<SensorModel> model;

  std::size_t capacity() const { return static_cast<std::size_t>(latency / period) + 1; }
  bool isDropped(std::int64_t seed, Tick tick) const {
    return drop > 0.0 && NoiseChannel(seed, drop_stream).uniform(tick) < drop;
  }
};

SensorSuite::SensorSuite(std::vector<SensorCarrier> carriers, SensorSurroundings surroundings,
                         std::int64_t step_ns)
    : carriers_(std::move(carriers)),
      surroundings_(std::make_unique<SensorSurroundings>(std::move(surroundings))) {
  const FloatingPointEnvironment environment;
  const RayGround* const ground = surroundings_->ground ? &*surroundings_->ground : nullptr;
  for (std::size_t vehicle = 0; vehicle < carriers_.size(); ++vehicle) {
    const SensorCarrier& carrier = carriers_[vehicle];
    const SensorSite site = {carrier.name,
                             static_cast<std::int32_t>(vehicle),
                             carrier.p_HB,
                             toSeconds(step_ns),
                             &surroundings_->targets,
                             ground};
    for (std::size_t index = 0; index < carrier.sensors.size(); ++index) {
      const SensorParameters& parameters = carrier.sensors[index];
      Sensor sensor;
      sensor.vehicle = vehicle;
      sensor.index = index;
      sensor.period = parameters.period;
      sensor.latency = (parameters.latency_ns + step_ns - 1) / step_ns;
      sensor.drop = parameters.drop;
      sensor.drop_stream = streamOf(channelNames(carrier.name, parameters).back());
      sensor.model = makeSensorModel(parameters, site);
      sensors_.push_back(std::move(sensor));
    }
  }
}

SensorSuite::~SensorSuite() = default;
SensorSuite::SensorSuite(SensorSuite&&) noexcept = default;
SensorSuite& SensorSuite::operator=(SensorSuite&&) noexcept = default;

SensedInstant SensorSuite::instantOf(std::size_t vehicle, std::int64_t seed, Tick tick,
                                     const SensedBodies& bodies) const {
  const BodyState& body = bodies.states[vehicle];
  const Mobility& mobility = carriers_[vehicle].mobility;
  const Pose X_WB = poseOf(body);
  const Twist twist = bodies.rotors_B == nullptr
                          ? twistOf(body, mobility)
                          : twistOf(body, mobility, (*bodies.rotors_B)[vehicle]);
  return {seed, tick, X_WB.p_AB, orientationOf(body), X_WB.R_AB, twist, &bodies.states};
}

std::vector<SensorState> SensorSuite::start(std::int64_t seed, Tick tick,
                                            const SensedBodies& bodies) const {
  const FloatingPointEnvironment environment;
  std::vector<SensorState> states;
  states.reserve(sensors_.size());
  for (const Sensor& sensor : sensors_) {
    SensorState state;
    state.memory.resize(sensor.model->memorySize(), 0.0);
    state.pending = SampleQueue(sensor.capacity(), sensor.model->sampleSize());
    sensor.model->start(instantOf(sensor.vehicle, seed, tick, bodies), state.memory.data());
    states.push_back(std::move(state));
  }
  return states;
}

void SensorSuite::sample(std::int64_t seed, Tick tick, const SensedBodies& bodies,
                         std::vector<SensorState>& states) {
  const FloatingPointEnvironment environment;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    Sensor& sensor = sensors_[i];
    if (tick % sensor.period != 0) continue;
    SensorState& state = states[i];
    double* const values = state.pending.push(tick);
    sensor.model->measure(instantOf(sensor.vehicle, seed, tick, bodies), state.memory.data(),
                          values);
    if (sensor.isDropped(seed, tick)) state.pending.dropLast();
  }
}

void SensorSuite::deliver(Tick tick, std::vector<SensorState>& states,
                          const SampleSink& sink) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const Sensor& sensor = sensors_[i];
    SampleQueue& pending = states[i].pending;
    while (!pending.empty() && pending.tick(0) + sensor.latency <= tick) {
      if (sink) {
        sink({sensor.vehicle, sensor.index, pending.tick(0), tick, pending.values(0),
              pending.width()});
      }
      pending.pop();
    }
  }
}

void SensorSuite::relocate(std::size_t vehicle, std::int64_t seed, Tick tick,
                           const SensedBodies& bodies, std::vector<SensorState>& states) const {
  const FloatingPointEnvironment environment;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (sensors_[i].vehicle != vehicle) continue;
    sensors_[i].model->relocate(instantOf(vehicle, seed, tick, bodies), states[i].memory.data());
  }
}

Tick SensorSuite::nextDelivery(Tick tick, const std::vector<SensorState>& states) const {
  Tick next = std::numeric_limits<Tick>::max();
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const Sensor& sensor = sensors_[i];
    const SampleQueue& pending = states[i].pending;
    const Tick measured =
        pending.empty() ? (tick / sensor.period + 1) * sensor.period : pending.tick(0);
    next = std::min(next, std::max(measured + sensor.latency, tick + 1));
  }
  return next;
}

bool SensorSuite::fits(const std::vector<SensorState>& states, Tick tick) const {
  if (states.size() != sensors_.size()) return false;
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const Sensor& sensor = sensors_[i];
    const SensorState& state = states[i];
    const SampleQueue& pending = state.pending;
    if (state.memory.size() != sensor.model->memorySize() ||
        pending.capacity() != sensor.capacity() || pending.width() != sensor.model->sampleSize()) {
      return false;
    }
    Tick last = 0;
    for (std::size_t k = 0; k < pending.size(); ++k) {
      const Tick measured = pending.tick(k);
      const bool waits = measured <= tick && measured + sensor.latency > tick;
      if (measured <= last || measured % sensor.period != 0 || !waits) return false;
      last = measured;
    }
  }
  return true;
}

SensorSuite::Range SensorSuite::rangeOf(std::size_t vehicle) const {
  Range range;
  for (const Sensor& sensor : sensors_) {
    if (sensor.vehicle < vehicle) ++range.first;
    if (sensor.vehicle <= vehicle) ++range.last;
  }
  return range;
}

}  // namespace hovercraft
