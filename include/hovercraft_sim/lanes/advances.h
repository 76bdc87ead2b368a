#pragma once

#include "hovercraft_sim/lanes/lane_block.h"

/// One source file for each instruction set, which is compiled for it; null where the compiler was
/// not told to. They are numbers, not functions: a processor without the instructions may read
/// them.

namespace hovercraft::lanes {

extern const Advance kAdvanceScalar;
extern const Advance kAdvancePairs;
extern const Advance kAdvanceAvx2;
extern const Advance kAdvanceAvx512;

}  // namespace hovercraft::lanes
