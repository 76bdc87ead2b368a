#include <string>
#include <yaml-cpp/yaml.h>

#include <gtest/gtest.h>

#include "hovercraft_sim/ros/replay.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/scenarios.h"

/// What earlier versions recorded still reads, and is flown again to the last bit
/// (test/data/recordings/README.md).

namespace hovercraft_ros {
namespace {

const std::string kFolder = "test/data/recordings/";

TEST(OlderRecordings, OfEachFormatReplayIdentically) {
  for (const char* name : {"format_1_contact", "format_1_matrix"}) {
    std::string verdict;
    EXPECT_EQ(replayBag({kFolder + name + ".bag", "", {}}, verdict), 0) << name << ": " << verdict;
    EXPECT_NE(verdict.find("identical: "), std::string::npos) << verdict;
  }
}

// The state itself is held by the hash in the snapshot, which is checked when it is read.
TEST(OlderRecordings, SnapshotsOfEachFormatCanBeGoneOnFrom) {
  for (const char* name : {"format_1_contact", "format_1_matrix"}) {
    const std::string text =
        hovercraft::readSnapshotText(kFolder + name + std::string(".snapshot.yaml"));
    const auto scenario =
        hovercraft::testing::scenarioOf(YAML::Load(text)["scenario"].as<std::string>());
    hovercraft::Simulation simulation(scenario);
    simulation.restore(hovercraft::parseSnapshot(text, name, scenario));
    EXPECT_GT(simulation.tick(), 1000);
    simulation.step();
  }
}

}  // namespace
}  // namespace hovercraft_ros
