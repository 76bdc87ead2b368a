#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

#include "hovercraft_sim/python/stepped_simulation.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/craft_pilot.h"

/// What studies (python/hovercraft_core/studies) need of the core: draws, exact functions,
/// distances, pilots.

namespace hovercraft_python {

/// Manoeuvres that a run flies, decision by decision.
class HeldPilots {
 public:
  /// @param paths files of manoeuvres. @throws std::invalid_argument as loadPilot(), and if two are
  /// for one craft.
  HeldPilots(std::shared_ptr<const hovercraft::Scenario> scenario,
             const std::vector<std::string>& paths);

  /// Ticks from one call of decide() to the next: a divisor of each pilot's period.
  hovercraft::Tick period() const { return period_; }
  /// The commands that are due at the simulation's tick.
  std::vector<hovercraft::Command> decide(SteppedSimulation& simulation);

 private:
  std::shared_ptr<const hovercraft::Scenario> scenario_;
  std::vector<hovercraft::CraftPilot> pilots_;
  hovercraft::Tick period_ = 0;
};

/// Adds the functions and HeldPilots to the module.
void bindStudies(pybind11::module_& module);

}  // namespace hovercraft_python
