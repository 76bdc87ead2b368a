#pragma once

#include <cstddef>
#include <functional>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/pilot/pilot.h"
#include "hovercraft_sim/sensors/sensor_suite.h"
#include "hovercraft_sim/sim/command_log.h"
#include "hovercraft_sim/sim/simulation_state.h"

namespace hovercraft {

class Simulation;

/// Who is told what happens in a run: writers of CSV files and bags, the node, a replay. Commands,
/// contacts and samples come from Simulation::step(), once it is told whom to tell
/// (Simulation::observe()); states, manoeuvres and the end from whoever makes the run. What an
/// observer does not care about is passed over.
class HOVERCRAFT_PUBLIC RunObserver {
 public:
  RunObserver() = default;
  RunObserver(const RunObserver&) = delete;
  RunObserver& operator=(const RunObserver&) = delete;
  virtual ~RunObserver() = default;

  /// A command that takes effect at its tick, in the step that begins there.
  virtual void applied(const Command& /*command*/) {}
  /// A contact of the step that is done, in the order of time.
  virtual void contact(const ContactEvent& /*event*/) {}
  /// A sample of a sensor, at the tick of its delivery, after the contacts of the step to it.
  virtual void sample(const SensorSample& /*sample*/) {}
  /// The simulation at a tick of output, before the commands of that tick.
  virtual void state(const Simulation& /*simulation*/) {}
  /// A manoeuvre that was flown with a craft and ended at a tick, before the step from it.
  virtual void flown(const FlownManoeuvre& /*manoeuvre*/, std::size_t /*vehicle*/, Tick /*tick*/) {}
  /// The run is over and was whole. @throws std::invalid_argument if it could not all be written.
  virtual void close() {}
};

/// An observer of functions, for one or two of them; one that is not set is not called.
class HOVERCRAFT_PUBLIC RunCallbacks : public RunObserver {
 public:
  std::function<void(const Command&)> on_applied;       // RunObserver::applied()
  std::function<void(const ContactEvent&)> on_contact;  // RunObserver::contact()
  std::function<void(const SensorSample&)> on_sample;   // RunObserver::sample()

  void applied(const Command& command) override {
    if (on_applied) on_applied(command);
  }
  void contact(const ContactEvent& event) override {
    if (on_contact) on_contact(event);
  }
  void sample(const SensorSample& sample) override {
    if (on_sample) on_sample(sample);
  }
};

}  // namespace hovercraft
