#pragma once

#include <string>

#include <hovercraft_sim/State.h>

#include "recording.h"

namespace hovercraft_ros::testing {

/// The bits of all that a state message says about the motion: everything but header, tick, hash
/// (which is of the tick too) and the number of commands.
std::string bitsOfMotion(hovercraft_sim::State state);

/// Runs the recorded scenario with the recorded commands in the core alone, and expects every
/// recorded state and engine status of every craft to be that of its tick, bit for bit.
void expectEqualsCoreRun(const Recording& recording);

}  // namespace hovercraft_ros::testing
