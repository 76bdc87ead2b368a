#include <set>
#include <string>

#include <gtest/gtest.h>

#include "recorded_runs.h"

namespace hovercraft::testing {
namespace {

constexpr const char* kFolder = "test/determinism";

// scripts/determinism does the same with other compilers, levels, libraries and processors.
TEST(Determinism, EveryBuildGivesTheRecordedBits) {
  for (const RecordedRun& run : readRecordedRuns(kFolder)) {
    EXPECT_EQ(firstDifference(run, fly(kFolder, run, kLastTick)), "");
  }
}

// A hash that two runs share would mean that what tells them apart does not reach it.
TEST(Determinism, NoTwoRunsEndAlike) {
  std::set<std::uint64_t> ends;
  const auto runs = readRecordedRuns(kFolder);
  for (const RecordedRun& run : runs) ends.insert(run.hashes.back());
  EXPECT_EQ(ends.size(), runs.size());
}

}  // namespace
}  // namespace hovercraft::testing
