#include <fmt/format.h>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/bags/simulate.h"

#include "../support/allocation_counter.h"
#include "../support/files.h"
#include "../support/scenarios.h"

namespace hovercraft_ros {
namespace {

using hovercraft::testing::live_bytes;
using hovercraft::testing::peak_bytes;

TEST(SimulateMemory, TakenAndGivenBackIsCounted) {
  const long before = live_bytes;
  {
    const std::vector<char> bytes(100000);
    peak_bytes = 0;
    EXPECT_GE(live_bytes - before, 100000);
    const std::vector<char> more(50000);
    EXPECT_GE(peak_bytes - before, 150000);
  }
  EXPECT_LT(live_bytes - before, 100);
}

/// What a run with a command at every tick takes from the heap at most, in bytes.
long peakOf(const hovercraft::testing::TestFolder& folder, int ticks) {
  SimulateRequest request;
  request.scenario = folder.write("s.yaml", hovercraft::testing::oneCraftYaml());
  {
    std::string commands = "time,rear,left,right\n";
    for (int tick = 0; tick < ticks; ++tick) {
      commands += fmt::format("{:.2f},{},,0.5\n", 0.01 * tick, tick % 3);
    }
    request.commands = folder.write("c.csv", commands);
  }
  request.duration = fmt::format("{:.2f}", 0.01 * ticks);
  request.output = folder.file("out.csv");
  request.contacts = folder.file("contacts.csv");
  const long before = live_bytes;
  peak_bytes = before;
  std::ostringstream messages;
  simulate(request, messages);
  return peak_bytes - before;
}

// Commands are read one by one, states are written as they come.
TEST(SimulateMemory, DoesNotGrowWithTheLengthOfTheRun) {
  const hovercraft::testing::TestFolder folder;
  peakOf(folder, 20000);  // what is made once
  const long once = peakOf(folder, 20000);
  const long four_times = peakOf(folder, 80000);
  EXPECT_GT(once, 1000);
  // A number kept of each tick would be 480000 more. The peak, when the buffer of the CSV grows for
  // the last time, hides a tenth of that. Texts of the longer duration take a few bytes.
  EXPECT_LT(four_times - once, 1000) << once << " bytes, then " << four_times;
}

}  // namespace
}  // namespace hovercraft_ros
