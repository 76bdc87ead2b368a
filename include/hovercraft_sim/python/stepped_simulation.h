#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/python/call_lock.h"
#include "hovercraft_sim/python/recorder.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_python {

using ScenarioPointer = std::shared_ptr<const hovercraft::Scenario>;

/// The state of a simulation, and the scenario that it belongs to.
struct SavedState {
  ScenarioPointer scenario;
  hovercraft::SimulationState state;
};

/// A position or a velocity, an orientation as x, y, z, w.
using Triple = std::array<double, 3>;
using Quadruple = std::array<double, 4>;

/// What may be set of the motion of a craft: of B in W.
struct SetMotion {
  Triple position;
  Quadruple orientation;
  Triple velocity;
  Triple angular_velocity;
};

struct PushedWrench {
  Triple force;
  Triple torque;
  double duration = 0.0;  // s
  std::string frame;      // world or body
};

/// A simulation for callers of several threads and of any arguments: each call waits for the one
/// before, and says what is wrong with its arguments. It knows no Python.
class SteppedSimulation {
 public:
  /// How a long call is interrupted: called now and then with the simulation locked. What it throws
  /// ends the call.
  using Interrupt = std::function<void()>;

  SteppedSimulation(ScenarioPointer scenario, std::optional<std::int64_t> seed);

  /// @throws std::invalid_argument for a count below 0 or beyond the longest time, and if the
  /// motion diverges.
  void step(std::int64_t count, const Interrupt& interrupt);
  /// @param commands in the order of ticks, none before the current one.
  Recording run(std::vector<hovercraft::Command> commands, double duration, std::int64_t every,
                const Interrupt& interrupt);
  /// A command from the current tick on; its own tick does not matter.
  void command(hovercraft::Command command);
  void applyWrench(const std::string& vehicle, const PushedWrench& wrench);
  void setMotion(const std::string& vehicle, const SetMotion& motion);
  void setWind(const Triple& wind);
  void reset(std::int64_t seed);

  SavedState save();
  /// @throws std::invalid_argument for the state of another scenario.
  void restore(const SavedState& saved);
  std::string snapshot();
  void restoreSnapshot(const std::string& text);

  std::uint64_t hash();
  std::uint64_t sensorHash();
  std::int64_t tick();
  std::int64_t timeNs();
  std::int64_t seed();
  /// Of each craft, then of each loose body.
  std::vector<StateRow> states();
  std::vector<ActuatorRow> actuators(std::size_t vehicle);

  const ScenarioPointer& scenario() const { return scenario_; }

 private:
  class Lock;

  void requireTime(std::int64_t count) const;

  ScenarioPointer scenario_;
  hovercraft::Simulation simulation_;
  CallMutex mutex_;
};

}  // namespace hovercraft_python
