#include <limits>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/state_hash.h"

/// What a simulation does with sensors: it has them read its bodies, and hands their samples on.

namespace hovercraft {

SensedBodies Simulation::sensedBodies() {
  bool any = false;
  for (std::size_t i = 0; i < vehicleCount(); ++i) any = any || !modelOf(i).rotors.empty();
  if (!any) return {state_.bodies};
  rotors_B_.resize(vehicleCount());
  for (std::size_t i = 0; i < vehicleCount(); ++i) rotors_B_[i] = rotorsOf(i);
  return {state_.bodies, rotors_B_};
}

void Simulation::readSensors() {
  {
    const FloatingPointEnvironment environment;
    sensors_->sample(state_.seed, state_.tick, sensedBodies(), state_.sensors);
  }
  const auto tell = [this](const SensorSample& sample) {
    if (observer_ != nullptr) observer_->sample(sample);
  };
  sensors_->deliver(state_.tick, state_.sensors, tell);
}

Tick Simulation::nextSampleTick() const {
  return sensors_ ? sensors_->nextDelivery(state_.tick, state_.sensors)
                  : std::numeric_limits<Tick>::max();
}

std::uint64_t Simulation::sensorHash(std::size_t vehicle) const {
  if (!sensors_) return 0;
  const SensorSuite::Range range = sensors_->rangeOf(vehicle);
  if (range.first == range.last) return 0;
  StateHash hash;
  for (std::size_t i = range.first; i < range.last; ++i) hash.add(state_.sensors[i]);
  return hash.value();
}

std::uint64_t Simulation::sensorHash() const {
  if (!sensors_) return 0;
  StateHash hash;
  for (const SensorState& sensor : state_.sensors) hash.add(sensor);
  return hash.value();
}

}  // namespace hovercraft
