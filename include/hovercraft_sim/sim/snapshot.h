#pragma once

#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft {

/// The state of a run as YAML text: the scenario, and every number of the state to the last bit, so
/// that it comes back to the last bit, and the commands that wait to take effect. A run that goes
/// on from it gives the same bits as the run that never stopped. The hash of the state is written
/// with it and checked when it is read (waiting commands are not in it).
HOVERCRAFT_PUBLIC std::string toSnapshot(const Simulation& simulation);

/// @param text from toSnapshot(). @param source its name in errors.
/// @param scenario that the snapshot must belong to.
/// @param may_be_older of a recording: a physics_version before that of the build is no error.
/// @throws std::invalid_argument naming source, key and rule, also if the snapshot belongs to
/// another scenario or its hash is not that of its numbers.
HOVERCRAFT_PUBLIC SimulationState parseSnapshot(const std::string& text, const std::string& source,
                                                const Scenario& scenario,
                                                bool may_be_older = false);

/// The same through a file; an existing one is replaced only when the new one is whole.
/// @throws std::invalid_argument if it cannot be written, or is longer than readSnapshotText()
/// takes.
HOVERCRAFT_PUBLIC void saveSnapshot(const Simulation& simulation, const std::string& path);
/// The text of a snapshot's file, for parseSnapshot(). @throws std::invalid_argument if it cannot
/// be read.
HOVERCRAFT_PUBLIC std::string readSnapshotText(const std::string& path);

}  // namespace hovercraft
