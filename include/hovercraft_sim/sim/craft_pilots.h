#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/sim/craft_pilot.h"
#include "hovercraft_sim/sim/run.h"

namespace hovercraft {

/// The pilots of a run, one for each craft that has one.
class HOVERCRAFT_PUBLIC CraftPilots {
 public:
  /// @param paths files of manoeuvres. @throws std::invalid_argument as loadPilot(), and if two are
  /// for one craft.
  CraftPilots(const std::vector<std::string>& paths, const Scenario& scenario);

  /// RunPlan::steer: pushes the commands that are due at the simulation's tick, and tells the
  /// observer of manoeuvres that ended. @returns false when every pilot is over.
  bool steer(Simulation& simulation, RunObserver& observer);

  const std::vector<CraftPilot>& pilots() const { return pilots_; }
  /// An upper bound of the tick at which all are over.
  Tick lastTick() const;

 private:
  std::vector<CraftPilot> pilots_;
  std::vector<std::size_t> told_;  // manoeuvres of each that the observer knows
};

}  // namespace hovercraft
