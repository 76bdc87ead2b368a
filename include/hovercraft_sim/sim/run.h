#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/pilot/pilot.h"
#include "hovercraft_sim/sim/command_source.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft {

/// Where the states of a run go.
class StateSink {
 public:
  StateSink() = default;
  StateSink(const StateSink&) = delete;
  StateSink& operator=(const StateSink&) = delete;
  virtual ~StateSink() = default;

  /// The simulation at a tick of output, before the commands of that tick.
  virtual void state(const Simulation& simulation) = 0;
  /// A command that takes effect at its tick.
  virtual void applied(const Command& /*command*/) {}
  /// A contact, when the step in which it happened is done, before the state after it.
  virtual void contact(const ContactEvent& /*event*/) {}
  /// A sample of a sensor, at the tick of its delivery, before the state of that tick.
  virtual void sample(const SensorSample& /*sample*/) {}
  /// A manoeuvre that was flown with a craft and ended at a tick, before the step from it.
  virtual void flown(const FlownManoeuvre& /*manoeuvre*/, std::size_t /*vehicle*/, Tick /*tick*/) {}
  /// The run is over and was whole. @throws std::invalid_argument if it could not all be written.
  virtual void close() = 0;
};

struct RunPlan {
  Tick last_tick = 0;  // where the run ends
  Tick every = 1;      // ticks from one output to the next, > 0; tick 0 is the first
  /// Called before each step, after the output of its tick; may push commands for it. The run ends
  /// there where it returns false. May be empty.
  std::function<bool(Simulation&)> steer;
  std::function<void(Tick)> on_progress;  // called every kProgressInterval ticks; may be empty
};
constexpr Tick kProgressInterval = 4096;

/// An engine that stopped because no command came in time.
struct EngineTimeout {
  std::size_t vehicle = 0;
  int engine = 0;
  std::int64_t count = 0;  // how many times
  Tick first_tick = 0;     // of the first time: the step that begins here was the first without
  double first_commanded = 0.0;  // N, the command that was cut off then
};

struct RunSummary {
  std::vector<EngineTimeout> timeouts;  // in the order of vehicles and engines
  std::uint64_t hash = 0;               // Simulation::hash() at the end
};

/// Steps a simulation to the plan's last tick as fast as it goes: commands from the source, states
/// to the sink, which is closed at the end.
/// @param simulation at the beginning of the run; its on_applied, on_contact and on_sample are
/// taken over.
HOVERCRAFT_PUBLIC RunSummary run(Simulation& simulation, CommandSource& commands, StateSink& sink,
                                 const RunPlan& plan);

}  // namespace hovercraft
