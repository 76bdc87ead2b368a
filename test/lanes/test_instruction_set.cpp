#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/lanes/advances.h"
#include "hovercraft_sim/lanes/instruction_set.h"

namespace hovercraft {
namespace {

TEST(InstructionSet, ScalarAndPairsAreEverywhere) {
  const std::vector<InstructionSet> sets = availableInstructionSets();
  ASSERT_GE(sets.size(), 2U);
  EXPECT_EQ(sets[0], InstructionSet::kScalar);
  EXPECT_EQ(sets[1], InstructionSet::kPairs);
  EXPECT_EQ(lanes::advanceBy(sets[0]), lanes::kAdvanceScalar);
  EXPECT_EQ(lanes::advanceBy(sets[1]), lanes::kAdvancePairs);
}

#if defined(__x86_64__)
TEST(InstructionSet, TheLibraryHasAllOfX86AndTheProcessorDecides) {
  EXPECT_NE(lanes::kAdvanceAvx2, nullptr);
  EXPECT_NE(lanes::kAdvanceAvx512, nullptr);
  const std::vector<InstructionSet> sets = availableInstructionSets();
  const std::size_t count = 2U + (__builtin_cpu_supports("avx2") != 0 ? 1U : 0U) +
                            (__builtin_cpu_supports("avx512f") != 0 ? 1U : 0U);
  EXPECT_EQ(sets.size(), count);
  EXPECT_STREQ(instructionSetName(InstructionSet::kPairs), "sse2");
}
#endif

}  // namespace
}  // namespace hovercraft
