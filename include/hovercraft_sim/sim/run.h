#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/sim/command_source.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft {

struct RunPlan {
  Tick last_tick = 0;  // where the run ends
  Tick every = 1;      // ticks from one output to the next, > 0; tick 0 is the first
  /// Called before each step, after the output of its tick; may push commands for it. The run ends
  /// there where it returns false. May be empty.
  std::function<bool(Simulation&)> steer;
  std::function<void(Tick)> on_progress;  // called every kProgressInterval ticks; may be empty
};
constexpr Tick kProgressInterval = 4096;  // ticks

/// An engine that stopped because no command came in time.
struct EngineTimeout {
  std::size_t vehicle = 0;  // index into Scenario::vehicles
  int engine = 0;           // its id
  std::int64_t count = 0;   // how many times
  Tick first_tick = 0;      // of the first time: the step that begins here was the first without
  double first_commanded = 0.0;  // N, the command that was cut off then
};

struct RunSummary {
  std::vector<EngineTimeout> timeouts;  // in the order of vehicles and engines
  std::uint64_t hash = 0;               // Simulation::hash() at the end
};

/// Steps a simulation to the plan's last tick as fast as it goes: commands from the source, what
/// happens to the observer, which is closed at the end.
/// @param simulation at the beginning of the run; it tells nobody when the run is over, however it
/// ends.
HOVERCRAFT_PUBLIC RunSummary run(Simulation& simulation, CommandSource& commands,
                                 RunObserver& observer, const RunPlan& plan);

}  // namespace hovercraft
