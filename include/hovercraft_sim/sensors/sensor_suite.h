#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/sensors/sample_queue.h"
#include "hovercraft_sim/sensors/sensor_model.h"
#include "hovercraft_sim/sensors/sensor_parameters.h"

namespace hovercraft {

/// What determines the future of one sensor: its memory, and the samples that are on their way.
struct SensorState {
  std::vector<double> memory;  // of its model
  SampleQueue pending;         // measured, not yet delivered
};

/// A sample as it is delivered.
struct SensorSample {
  std::size_t vehicle = 0;         // index into the carriers
  std::size_t sensor = 0;          // index into the craft's sensors
  Tick measured = 0;               // the tick that it is of
  Tick delivered = 0;              // the tick that it comes at
  const double* values = nullptr;  // as sampleFields(); valid during the call
  std::size_t count = 0;           // how many values
};
using SampleSink = std::function<void(const SensorSample&)>;  // called for each

/// A craft and what it carries.
struct SensorCarrier {
  std::string name;                       // of the craft
  Mobility mobility;                      // of the craft
  Vector3 p_HB;                           // m, the centre of mass in H
  std::vector<SensorParameters> sensors;  // in their order
};

/// What lasers see, besides their own craft.
struct SensorSurroundings {
  std::vector<RayTarget> targets;   // bodies and obstacles
  std::optional<RayGround> ground;  // none: rays go on for ever
};

/// What sensors are read from. Made from the states alone where no craft has rotors.
struct SensedBodies {
  /// Of craft without rotors.
  SensedBodies(const BodyStates& all) : states(all) {}
  /// @param momenta as rotors_B.
  SensedBodies(const BodyStates& all, const std::vector<Vector3>& momenta)
      : states(all), rotors_B(&momenta) {}

  const BodyStates& states;                        // vehicles first
  const std::vector<Vector3>* rotors_B = nullptr;  // N m s, of the rotors of each craft, in B
};

/// All sensors of a run. A sensor of period k is read at the ticks k, 2k, ..., after the step, and
/// its sample is delivered at the first tick that is not before measurement + latency. Nothing here
/// acts on a body. States are the caller's: the suite is the same for all of them. No allocation
/// after start().
class HOVERCRAFT_PUBLIC SensorSuite {
 public:
  /// @param carriers in the order of the moving bodies. @param surroundings what lasers see.
  /// @param step_ns of the simulation.
  SensorSuite(std::vector<SensorCarrier> carriers, SensorSurroundings surroundings,
              std::int64_t step_ns);
  ~SensorSuite();
  SensorSuite(SensorSuite&&) noexcept;
  SensorSuite& operator=(SensorSuite&&) noexcept;  // moves, likewise

  /// Whether no craft carries a sensor.
  bool empty() const { return sensors_.empty(); }

  /// States at the start of a run, of all sensors of the first craft, then of the second, ...
  std::vector<SensorState> start(std::int64_t seed, Tick tick, const SensedBodies& bodies) const;

  /// Reads every sensor that is due at this tick.
  void sample(std::int64_t seed, Tick tick, const SensedBodies& bodies,
              std::vector<SensorState>& states);

  /// Hands on and forgets what is due at this tick, in the order of the states. @param sink may be
  /// empty.
  void deliver(Tick tick, std::vector<SensorState>& states, const SampleSink& sink) const;

  /// The craft was put elsewhere: that is no acceleration.
  void relocate(std::size_t vehicle, std::int64_t seed, Tick tick, const SensedBodies& bodies,
                std::vector<SensorState>& states) const;

  /// The next tick after `tick` at which a sample may be delivered.
  Tick nextDelivery(Tick tick, const std::vector<SensorState>& states) const;

  /// Whether states have the sizes and ticks of this suite's at `tick`.
  bool fits(const std::vector<SensorState>& states, Tick tick) const;

  /// The states of one craft: [first, last).
  struct Range {
    std::size_t first = 0;  // index of its first sensor
    std::size_t last = 0;   // behind its last one
  };
  /// @param vehicle index into the carriers.
  Range rangeOf(std::size_t vehicle) const;

 private:
  struct Sensor;

  SensedInstant instantOf(std::size_t vehicle, std::int64_t seed, Tick tick,
                          const SensedBodies& bodies) const;

  std::vector<SensorCarrier> carriers_;
  std::unique_ptr<SensorSurroundings> surroundings_;  // models point to it
  std::vector<Sensor> sensors_;
};

}  // namespace hovercraft
