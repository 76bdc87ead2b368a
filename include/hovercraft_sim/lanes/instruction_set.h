#pragma once

#include <vector>

#include "hovercraft_sim/lanes/lane_block.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// The instructions by which the steps of many craft are made; each gives the same bits.
enum class InstructionSet {
  kScalar,  // one craft at a time
  kPairs,   // two: SSE2, or NEON
  kAvx2,    // four
  kAvx512,  // eight
};

/// "scalar", "sse2" or "neon" (what the library was built for), "avx2", "avx512".
HOVERCRAFT_PUBLIC const char* instructionSetName(InstructionSet set);

/// Those that this machine has, narrow ones first.
HOVERCRAFT_PUBLIC std::vector<InstructionSet> availableInstructionSets();

namespace lanes {

/// The steps by one of them. @throws std::invalid_argument if this machine has none of it.
Advance advanceBy(InstructionSet set);

}  // namespace lanes
}  // namespace hovercraft
