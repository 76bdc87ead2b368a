#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <set>
#include <string>
#include <yaml-cpp/yaml.h>

#include <gtest/gtest.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/StateFormat1.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "hovercraft_sim/bags/commands_bag.h"
#include "hovercraft_sim/bags/recording_reader.h"
#include "hovercraft_sim/bags/replay.h"
#include "hovercraft_sim/bags/trajectory_file.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/files.h"
#include "../support/scenarios.h"

/// What earlier versions recorded still reads, and is flown again to the last bit
/// (test/data/recordings/README.md).

namespace hovercraft_ros {
namespace {

const std::string kFolder = "test/data/recordings/";

const std::string kOlder = "recorded by physics version 1, replayed by 3: ";

// Physics versions 2 and 3 are others of contact alone.
TEST(OlderRecordings, WithoutContactReplayIdentically) {
  std::string verdict;
  EXPECT_EQ(replayBag({kFolder + "format_1_matrix.bag", "", {}}, verdict), 0) << verdict;
  EXPECT_EQ(verdict.rfind(kOlder + "identical: ", 0), 0U) << verdict;
}

// Two craft of this one meet floor and wall; they stay where they were to a few micrometres until
// their first impacts, and a part of the tolerance tells where a bounce goes.
TEST(OlderRecordings, WithContactSayWhereTheyDifferAndByHowMuch) {
  std::string verdict;
  EXPECT_EQ(replayBag({kFolder + "format_1_contact.bag", "", {}}, verdict), 2) << verdict;
  EXPECT_EQ(verdict.rfind(kOlder + "the first difference is at episode ", 0), 0U) << verdict;
  const Recording recording = readRecording(kFolder + "format_1_contact.bag");
  EXPECT_EQ(recording.physics_version, 1);
  const ReplayResult result = replay(recording, recording.scenario, true);
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(result.compared_states, recording.states.size());
  EXPECT_GT(result.largest_error, 0.0);
  EXPECT_FALSE(result.largest_error_time < result.difference->time);
  EXPECT_NE(verdict.find(fmt::format("is {:.3g} m at episode ", result.largest_error)),
            std::string::npos)
      << verdict;
}

// The commands of an older bag drive a run, and its states are a trajectory.
TEST(OlderRecordings, GiveCommandsWhereNothingElseChangedTheRunAndTrajectories) {
  for (const char* name : {"format_1_contact", "format_1_matrix"}) {
    const std::string bag = kFolder + name + ".bag";
    const Recording recording = readRecording(bag);
    ASSERT_FALSE(recording.commands.empty());
    ASSERT_FALSE(recording.events.empty());
    const std::string refusal =
        hovercraft::testing::messageOf([&] { BagCommandSource(bag, recording.scenario); });
    EXPECT_NE(refusal.find("is for the tool replay"), std::string::npos) << refusal;
  }
  // A trajectory has no reset: of a flight that has none.
  const std::string flight = "examples/flight_test/reference.bag";
  {
    const rosbag::Bag bag(flight);
    rosbag::View states(bag, rosbag::TypeQuery("hovercraft_sim/State"));
    EXPECT_EQ(states.getConnections().front()->md5sum,
              ros::message_traits::MD5Sum<hovercraft_sim::StateFormat1>::value());
  }
  EXPECT_EQ(readTrajectories(flight).size(), 1U);
  const Recording recording = readRecording(flight);
  BagCommandSource source(flight, recording.scenario);
  const auto first = source.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->tick, recording.commands.front().command.tick);
}

// The rules that the package exports: for programs that know the definitions of today only.
TEST(OlderRecordings, RosbagFixMakesThemRecordingsOfToday) {
  const hovercraft::testing::TestFolder folder;
  const auto devel = std::filesystem::read_symlink("/proc/self/exe").parent_path() / "../..";
  for (const char* name : {"format_1_contact", "format_1_matrix"}) {
    const std::string fixed = folder.file(std::string(name) + ".bag");
    const std::string command = fmt::format(
        "bash -c '. {}/setup.bash && rosbag fix {}{}.bag {} migration/format_1.bmr > /dev/null'",
        devel.string(), kFolder, name, fixed);
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    std::set<std::string> sums;
    {
      const rosbag::Bag bag(fixed);
      for (const rosbag::ConnectionInfo* connection : rosbag::View(bag).getConnections()) {
        sums.insert(connection->md5sum);
      }
    }
    EXPECT_EQ(sums.count(ros::message_traits::MD5Sum<hovercraft_sim::AppliedCommand>::value()), 1U);
    EXPECT_EQ(sums.count(ros::message_traits::MD5Sum<hovercraft_sim::RunEvent>::value()), 1U);
    EXPECT_EQ(sums.count(ros::message_traits::MD5Sum<hovercraft_sim::State>::value()), 1U);
    std::string verdict;
    EXPECT_LE(replayBag({fixed, "", {}}, verdict) % 2, 0) << name << ": " << verdict;
    EXPECT_EQ(verdict.rfind(kOlder, 0), 0U) << verdict;
  }
}

// The state itself is held by the hash in the snapshot, which is checked when it is read.
TEST(OlderRecordings, SnapshotsOfEachFormatCanBeReadInAReplay) {
  for (const char* name : {"format_1_contact", "format_1_matrix"}) {
    const std::string text =
        hovercraft::readSnapshotText(kFolder + name + std::string(".snapshot.yaml"));
    const auto scenario =
        hovercraft::testing::scenarioOf(YAML::Load(text)["scenario"].as<std::string>());
    hovercraft::Simulation simulation(scenario);
    simulation.restore(hovercraft::parseSnapshot(text, name, scenario, true));
    EXPECT_GT(simulation.tick(), 1000);
    simulation.step();
  }
}

}  // namespace
}  // namespace hovercraft_ros
