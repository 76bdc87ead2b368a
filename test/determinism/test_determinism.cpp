#include <set>
#include <string>

#include <gtest/gtest.h>

#include "../support/share.h"
#include "recorded_runs.h"

namespace hovercraft::testing {
namespace {

constexpr const char* kFolder = "test/determinism";
constexpr Tick kShortTick = kCheckpoints[2];

// scripts/determinism does the same with other compilers, levels, libraries and processors, and
// flies the runs with contact to their end too, which takes minutes without optimisation. Under
// the sanitizers none is flown to its end.
TEST(Determinism, EveryBuildGivesTheRecordedBits) {
  for (const RecordedRun& run : readRecordedRuns(kFolder)) {
    const bool is_short = kShare > 1 || hasContact(kFolder, run);
    const Tick last = is_short ? kShortTick : kLastTick;
    EXPECT_EQ(firstDifference(run, fly(kFolder, run, last)), "");
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
