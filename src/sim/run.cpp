#include "hovercraft_sim/sim/run.h"

#include <optional>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft {
namespace {

/// Watches for engines whose last command is older than their time-out.
class TimeoutWatch {
 public:
  explicit TimeoutWatch(const Simulation& simulation) : simulation_(simulation) {
    const Scenario& scenario = simulation.scenario();
    for (std::size_t vehicle = 0; vehicle < scenario.vehicles.size(); ++vehicle) {
      const auto parameters = parametersOf(scenario.vehicles[vehicle]);
      for (std::size_t id = 0; id < parameters.size(); ++id) {
        if (parameters[id].timeout_ns == 0) continue;
        const Tick ticks = firstTickAt(parameters[id].timeout_ns, scenario.step_ns);
        engines_.push_back({{vehicle, static_cast<int>(id), 0, 0, 0.0}, ticks, false});
      }
    }
  }

  /// Called after the step that began at `tick`, with the engines as they were in it.
  void look(Tick tick) {
    for (Watched& watched : engines_) {
      EngineTimeout& timeout = watched.timeout;
      const EngineState& state =
          simulation_.state().engines[timeout.vehicle][static_cast<std::size_t>(timeout.engine)];
      const bool is_late = state.command_tick != EngineState::kNever &&
                           tick - state.command_tick >= watched.timeout_ticks;
      if (is_late && !watched.was_late && timeout.count++ == 0) {
        timeout.first_tick = tick;
        timeout.first_commanded = state.commanded;
      }
      watched.was_late = is_late;
    }
  }

  std::vector<EngineTimeout> found() const {
    std::vector<EngineTimeout> timeouts;
    for (const Watched& watched : engines_) {
      if (watched.timeout.count > 0) timeouts.push_back(watched.timeout);
    }
    return timeouts;
  }

 private:
  struct Watched {
    EngineTimeout timeout;
    Tick timeout_ticks;
    bool was_late;
  };

  const Simulation& simulation_;
  std::vector<Watched> engines_;
};

/// Of a simulation by an observer, while this lives.
class Observation {
 public:
  Observation(Simulation& simulation, RunObserver& observer) : simulation_(simulation) {
    simulation_.observe(&observer);
  }
  Observation(const Observation&) = delete;
  Observation& operator=(const Observation&) = delete;
  ~Observation() { simulation_.observe(nullptr); }

 private:
  Simulation& simulation_;
};

}  // namespace

RunSummary run(Simulation& simulation, CommandSource& commands, RunObserver& observer,
               const RunPlan& plan) {
  demand(plan.every > 0, "a run puts out every n-th tick, n > 0");
  TimeoutWatch watch(simulation);
  const Observation observation(simulation, observer);
  std::optional<Command> waiting = commands.next();
  Tick next_output = simulation.tick();
  while (true) {
    const Tick tick = simulation.tick();
    if (tick == next_output) {
      observer.state(simulation);
      next_output += plan.every;
    }
    if (tick >= plan.last_tick || (plan.steer && !plan.steer(simulation))) break;
    for (; waiting && waiting->tick <= tick; waiting = commands.next()) simulation.push(*waiting);
    simulation.step();
    watch.look(tick);
    if (plan.on_progress && tick % kProgressInterval == 0) plan.on_progress(tick);
  }
  observer.close();
  return {watch.found(), simulation.hash()};
}

}  // namespace hovercraft
