#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "hovercraft_sim/python/call_lock.h"
#include "hovercraft_sim/python/command_list.h"
#include "hovercraft_sim/python/recorder.h"
#include "hovercraft_sim/python/stepped_simulation.h"
#include "hovercraft_sim/sim/batch.h"

namespace hovercraft_python {

/// How the steps of a batch are made.
struct BatchWay {
  int threads = 1;
  std::string instruction_set;  // empty: the widest
};

/// What was put out of one run.
struct BatchRecording {
  std::vector<StateRow> states;
  std::vector<ActuatorRow> actuators;  // all of a row, then the next
};

/// A Batch for callers of several threads and of any arguments, as SteppedSimulation is of a
/// Simulation. The first scenario is that of the names.
class SteppedBatch {
 public:
  /// @param seeds none, or as many as scenarios.
  /// @throws std::invalid_argument as Batch, and for an instruction set that there is not.
  SteppedBatch(const std::vector<ScenarioPointer>& scenarios,
               const std::optional<std::vector<std::int64_t>>& seeds, const BatchWay& way);

  /// @throws std::invalid_argument for a count below 0 or beyond the longest time. A run that
  /// diverges is none.
  void step(std::int64_t count, const SteppedSimulation::Interrupt& interrupt);

  /// From the current tick on, to these actuators of every run. @param ids of actuators.
  /// @param values one for each of them, run by run.
  void command(const std::vector<std::size_t>& ids, const std::vector<double>& values);
  /// Queues the same commands for some runs. @param commands in the order of their ticks.
  /// @throws std::invalid_argument if one lies before the present tick or before what is queued.
  void schedule(const std::vector<hovercraft::Command>& commands,
                const std::vector<std::size_t>& runs);

  /// Flies commands of each run from now on, and puts out the first state and every n-th after it;
  /// those of a run that diverged are not all there.
  /// @param count ticks. @throws std::invalid_argument as schedule() and step().
  std::vector<BatchRecording> fly(const std::vector<std::vector<hovercraft::Command>>& commands,
                                  std::int64_t count, std::int64_t every,
                                  const SteppedSimulation::Interrupt& interrupt);

  std::size_t size() const { return batch_.size(); }
  const char* instructionSet() const { return instructionSetName(batch_.instructionSet()); }
  std::int64_t tick();
  std::int64_t timeNs();
  /// A row of each run, at its tick.
  std::vector<StateRow> states();
  /// Likewise of each actuator: all of a run, then the next.
  std::vector<ActuatorRow> actuators();
  /// The tick at which a run diverged; -1: it goes on.
  std::vector<std::int64_t> diverged();
  std::vector<std::uint64_t> hashes();
  /// What Simulation says of a run that diverged; empty: it goes on.
  std::vector<std::string> divergences();

  const ScenarioPointer& scenario() const { return scenario_; }

 private:
  class Lock;

  void push(std::size_t run, const hovercraft::Command& command);
  void requireTime(std::int64_t count) const;
  void makeSteps(std::int64_t count, const SteppedSimulation::Interrupt& interrupt);
  void record(std::vector<BatchRecording>& recordings) const;

  ScenarioPointer scenario_;
  std::size_t actuator_count_;
  hovercraft::Batch batch_;
  std::vector<std::string> names_;        // of each run: its craft
  std::vector<std::int64_t> last_ticks_;  // of each run: of the last command that was queued
  CallMutex mutex_;
};

/// Adds Batch to the module.
void bindBatch(pybind11::module_& module, const SteppedSimulation::Interrupt& interrupt);

}  // namespace hovercraft_python
