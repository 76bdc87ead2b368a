#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/pilot/manoeuvre.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// A file of manoeuvres (doc/manoeuvres.md), as it fits a scenario.
struct PilotFile {
  std::size_t vehicle = 0;                    // index into Scenario::vehicles
  Tick period_ticks = 1;                      // from one decision to the next
  std::vector<std::size_t> channels;          // ids of actuators, ascending, one for each of Levels
  Levels idle;                                // levels before the first command
  ActuatorArray<EngineParameters> actuators;  // of the craft, by id
  PilotPlan plan;
};

/// Decisions of one manoeuvre at most: each is kept until it ends, in 64 bytes.
constexpr double kMostDecisions = 1e6;
constexpr double kLongestManoeuvre = 3600.0;  // s

/// @param text YAML. @param source what it is: begins every error.
/// @throws std::invalid_argument with source, key path, value and rule: also where a level lies
/// beyond the limits of its actuator, so that it would not be flown as it is written.
HOVERCRAFT_PUBLIC PilotFile parsePilot(const std::string& text, const std::string& source,
                                       const Scenario& scenario);

/// Reads a regular file. @throws as parsePilot().
HOVERCRAFT_PUBLIC PilotFile loadPilot(const std::string& path, const Scenario& scenario);

}  // namespace hovercraft
