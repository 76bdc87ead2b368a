#include "hovercraft_sim/lanes/instruction_set.h"

#include <stdexcept>
#include <string>

#include "hovercraft_sim/lanes/advances.h"

namespace hovercraft {
namespace {

lanes::Advance compiledFor(InstructionSet set) {
  switch (set) {
    case InstructionSet::kScalar:
      return lanes::kAdvanceScalar;
    case InstructionSet::kPairs:
      return lanes::kAdvancePairs;
    case InstructionSet::kAvx2:
      return lanes::kAdvanceAvx2;
    case InstructionSet::kAvx512:
      return lanes::kAdvanceAvx512;
  }
  return nullptr;
}

bool hasInstructions([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::kAvx2) return __builtin_cpu_supports("avx2") != 0;
  if (set == InstructionSet::kAvx512) return __builtin_cpu_supports("avx512f") != 0;
#endif
  return true;
}

}  // namespace

const char* instructionSetName(InstructionSet set) {
  switch (set) {
    case InstructionSet::kScalar:
      return "scalar";
    case InstructionSet::kPairs:
#if defined(__x86_64__)
      return "sse2";
#elif defined(__aarch64__)
      return "neon";
#else
      return "pairs";
#endif
    case InstructionSet::kAvx2:
      return "avx2";
    case InstructionSet::kAvx512:
      return "avx512";
  }
  return "";
}

std::vector<InstructionSet> availableInstructionSets() {
  std::vector<InstructionSet> sets;
  for (const InstructionSet set : {InstructionSet::kScalar, InstructionSet::kPairs,
                                   InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (compiledFor(set) != nullptr && hasInstructions(set)) sets.push_back(set);
  }
  return sets;
}

lanes::Advance lanes::advanceBy(InstructionSet set) {
  for (const InstructionSet available : availableInstructionSets()) {
    if (available == set) return compiledFor(set);
  }
  throw std::invalid_argument(std::string("instruction set ") + instructionSetName(set) +
                              ": this machine does not have it");
}

}  // namespace hovercraft
