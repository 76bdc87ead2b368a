#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_python {

/// A row of the array of states: B (centre of mass) in W, as Motion.
struct StateRow {
  std::int64_t tick;
  double time;                             // s
  std::array<double, 3> position;          // m
  std::array<double, 4> orientation;       // x, y, z, w: B -> W
  std::array<double, 3> velocity;          // m/s, in W
  std::array<double, 3> angular_velocity;  // rad/s, in W
  std::array<double, 3> momentum;          // kg m/s, in W
  std::array<double, 3> angular_momentum;  // kg m²/s, in W
  double energy;                           // J
};

/// One engine, or another actuator, in a row of the array of actuators.
struct ActuatorRow {
  double commanded;  // N, or its level
  double applied;
  double age;  // s since the last command; -1 before the first
  bool saturated;
  bool timed_out;
};

/// A row of the array of contacts; names by their index in Recording::names.
struct ContactRow {
  std::int64_t tick;
  double time;  // s
  std::int32_t kind;
  std::int32_t a;
  std::int32_t b;
  std::array<double, 3> point;    // m, in W
  std::array<double, 3> normal;   // unit, from a to b, in W
  std::array<double, 3> impulse;  // N s, on b, in W
};

/// The samples of one sensor, one behind the other.
struct SampleColumns {
  std::vector<std::int64_t> measured;   // ticks
  std::vector<std::int64_t> delivered;  // ticks
  std::vector<double> values;           // as sampleFields(); of a laser as REP 117 tells ranges
};

struct Recording {
  std::vector<std::vector<StateRow>> states;        // of each craft, then of each loose body
  std::vector<std::vector<ActuatorRow>> actuators;  // of each craft: all of a row, then the next
  std::vector<ContactRow> contacts;
  std::vector<std::string> names;                   // of those in contact
  std::vector<std::vector<SampleColumns>> samples;  // of each craft and sensor
};

StateRow stateRow(const hovercraft::Simulation& simulation, std::size_t body);
/// The same of a motion. @param step_ns ns.
StateRow stateRow(hovercraft::Tick tick, std::int64_t step_ns, const hovercraft::Motion& motion);
ActuatorRow actuatorRow(const hovercraft::EngineReport& report);
/// Of all actuators of a craft, by id.
std::vector<ActuatorRow> actuatorRows(const hovercraft::Simulation& simulation,
                                      std::size_t vehicle);

/// Keeps a run in memory.
class Recorder : public hovercraft::RunObserver {
 public:
  /// More than this is refused: it is rather a mistake than a run.
  static constexpr std::size_t kMostBytes = std::size_t{4} << 30U;

  /// @throws std::invalid_argument if states and actuators of that many rows would take more than
  /// kMostBytes.
  Recorder(const hovercraft::Scenario& scenario, std::uint64_t rows);

  /// @throws std::invalid_argument beyond kMostBytes.
  void state(const hovercraft::Simulation& simulation) override;
  void contact(const hovercraft::ContactEvent& event) override;
  void sample(const hovercraft::SensorSample& sample) override;

  Recording recording;

 private:
  void grow(std::size_t bytes);
  std::int32_t indexOf(std::string_view name);

  const hovercraft::Scenario& scenario_;
  std::size_t row_bytes_ = 0;
  std::size_t bytes_ = 0;
};

}  // namespace hovercraft_python
