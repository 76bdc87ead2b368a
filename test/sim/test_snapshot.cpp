#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/snapshot.h"

#include "../support/files.h"
#include "../support/scenario_text.h"
#include "../support/special_files.h"

namespace hovercraft {
namespace {

using testing::messageOf;
using testing::parsed;
using testing::validScenario;
using testing::with;

void driveRarely(Simulation& simulation, Tick ticks) {
  for (const Tick end = simulation.tick() + ticks; simulation.tick() < end; simulation.step()) {
    if (simulation.tick() % 70 != 0) continue;
    const auto phase = static_cast<double>(simulation.tick() / 70 % 4);
    simulation.push({simulation.tick(), 0, kAllEngines, {phase, 0.3 * phase, 0.7}});
  }
}

Simulation underWay(const Scenario& scenario) {
  Simulation simulation(scenario);
  driveRarely(simulation, 333);
  simulation.applyWrench(
      {0, ExternalWrench::Frame::kBody, {{0.1, 0.2, 0.3}, {0.01, 0.0, 0.02}}, 600});
  simulation.applyWrench(
      {0, ExternalWrench::Frame::kWorld, {{-0.5, 0.0, 0.0}, {0.0, 0.0, 0.03}}, 400});
  driveRarely(simulation, 17);
  return simulation;
}

std::string complaintAbout(const std::string& snapshot, const Scenario& scenario) {
  try {
    parseSnapshot(snapshot, "snap.yaml", scenario);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(Snapshot, ARunThatGoesOnFromItGivesTheBitsOfTheRunThatNeverStopped) {
  for (const char* orientation : {"orientation: matrix", "orientation: quaternion"}) {
    const Scenario scenario = parsed(with(validScenario(), "orientation: matrix", orientation));
    Simulation unbroken = underWay(scenario);
    Simulation resumed(scenario);
    resumed.restore(parseSnapshot(toSnapshot(unbroken), "snap.yaml", scenario));
    ASSERT_EQ(resumed.hash(), unbroken.hash()) << orientation;
    for (int n = 0; n < 5; ++n) {
      driveRarely(unbroken, 100);
      driveRarely(resumed, 100);
      EXPECT_EQ(resumed.hash(), unbroken.hash()) << orientation << ", tick " << unbroken.tick();
    }
  }
}

TEST(Snapshot, ComesBackFromAFile) {
  const Scenario scenario = parsed(validScenario());
  const Simulation simulation = underWay(scenario);
  const testing::TestFolder folder;
  const std::string path = folder.file("snapshot.yaml");
  saveSnapshot(simulation, path);
  EXPECT_EQ(readSnapshotText(path), toSnapshot(simulation));
}

TEST(Snapshot, AFullDiskLeavesTheOldOne) {
  const Simulation simulation = underWay(parsed(validScenario()));
  const testing::TestFolder folder;
  const std::string path = folder.write("snapshot.yaml", "old");
  {
    const testing::SmallDisk disk(100);
    EXPECT_EQ(messageOf([&] { saveSnapshot(simulation, path); }),
              path + ": cannot be written: File too large");
  }
  EXPECT_EQ(testing::contentOf(path), "old");
  EXPECT_EQ(testing::kindAt(path + ".partial"), 0U);
}

TEST(Snapshot, FilesThatCannotBeUsedAreNamed) {
  const Simulation simulation(parsed(validScenario()));
  EXPECT_THROW(saveSnapshot(simulation, "/no/such/folder/snap.yaml"), std::invalid_argument);
  EXPECT_THROW(readSnapshotText("/no/such/folder/snap.yaml"), std::invalid_argument);
}

// Commands that came while the simulation was paused: they are part of what determines the future.
TEST(Snapshot, CommandsThatWaitComeBack) {
  const Scenario scenario = parsed(validScenario());
  Simulation unbroken = underWay(scenario);
  const Tick tick = unbroken.tick();
  unbroken.push({tick, 0, kAllEngines, {3.0, 0.1, 1.0 / 3.0}});
  unbroken.push({tick, 0, maskOf(EngineId::kLeft), {0.0, 1.2, 0.0}});
  unbroken.push({tick + 7, 0, kAllEngines, {0.5, 0.5, 0.5}});
  Simulation resumed(scenario);
  resumed.restore(parseSnapshot(toSnapshot(unbroken), "snap.yaml", scenario));
  EXPECT_EQ(resumed.state().commands.waiting().size(), 3U);
  for (int n = 0; n < 20; ++n) {
    unbroken.step();
    resumed.step();
    ASSERT_EQ(resumed.hash(), unbroken.hash()) << n;
  }
}

TEST(Snapshot, ACommandThatCannotWaitIsRefused) {
  const Scenario scenario = parsed(validScenario());
  Simulation simulation = underWay(scenario);  // at tick 350
  simulation.push({350, 0, kAllEngines, {1.0, 1.0, 1.0}});
  const std::string text = toSnapshot(simulation);
  const std::string command = "tick: 350, vehicle: alpha, engines: 7, thrusts: [1, 1, 1]";
  const auto complaint = [&](const char* changed) {
    return complaintAbout(with(text, command, changed), scenario);
  };
  EXPECT_EQ(complaint("tick: 349, vehicle: alpha, engines: 7, thrusts: [1, 1, 1]"),
            "snap.yaml: commands[0].tick: must be 350 or greater, in ascending order");
  EXPECT_EQ(complaint("tick: 350, vehicle: alpha, engines: 8, thrusts: [1, 1, 1]"),
            "snap.yaml: commands[0].engines: must be 1 to 7: the sum of rear 1, left 2, right "
            "4");
  EXPECT_EQ(complaint("tick: 350, vehicle: beta, engines: 7, thrusts: [1, 1, 1]"),
            "snap.yaml: commands[0].vehicle: must be one of: alpha");
  EXPECT_EQ(complaint("tick: 350, vehicle: alpha, engines: 7, thrusts: [1, .nan, 1]"),
            "snap.yaml: commands[0].thrusts: must be finite");
}

TEST(Snapshot, AFolderIsNoFile) {
  EXPECT_EQ(messageOf([] { readSnapshotText("test/data"); }),
            "test/data: cannot be read: it is a directory, must be a regular file");
}

TEST(Snapshot, OneOfAnotherScenarioIsRefused) {
  const Scenario scenario = parsed(validScenario());
  const Scenario heavier = parsed(with(validScenario(), "mass: 5.5", "mass: 5.6"));
  EXPECT_EQ(complaintAbout(toSnapshot(underWay(scenario)), heavier),
            "snap.yaml: scenario: the snapshot belongs to another scenario");
}

// Version 0.1 wrote 17 digits: the same numbers in another text.
TEST(Snapshot, ItsScenarioMayBeWrittenOtherwise) {
  const Scenario scenario = parsed(with(validScenario(), "mass: 5.5", "mass: 0.6"));
  const std::string text = toSnapshot(underWay(scenario));
  const std::string other = with(text, "mass: 0.6\n", "mass: 0.59999999999999998\n");
  EXPECT_EQ(complaintAbout(other, scenario), "");
  EXPECT_EQ(complaintAbout(with(text, "mass: 0.6\n", "mass: 0.59999999999999987\n"), scenario),
            "snap.yaml: scenario: the snapshot belongs to another scenario");
}

TEST(Snapshot, OneThatWasChangedIsRefused) {
  const Scenario scenario = parsed(validScenario());
  const std::string changed = with(toSnapshot(underWay(scenario)), "tick: 350\n", "tick: 351\n");
  EXPECT_NE(complaintAbout(changed, scenario).find("snap.yaml: hash: must be that of the state, "),
            std::string::npos);
}

// From the colon after its first key on, up to the last line of its scenario.
TEST(Snapshot, OneThatWasCutIsSaidToBeCut) {
  const Scenario scenario = parsed(validScenario());
  const std::string text = toSnapshot(underWay(scenario));
  for (std::size_t size = 12; size < text.size() - 1; ++size) {
    const std::string complaint = complaintAbout(text.substr(0, size), scenario);
    ASSERT_NE(complaint.find(" cut"), std::string::npos) << size << ": " << complaint;
  }
}

TEST(Snapshot, WhatIsNoSnapshotIsRefused) {
  const Scenario scenario = parsed(validScenario());
  EXPECT_NE(complaintAbout("tick: [", scenario).find("snap.yaml: it is not the YAML of a snapshot"),
            std::string::npos);
  EXPECT_EQ(complaintAbout("root:x:0:0\n", scenario), "snap.yaml: it is no snapshot");
  EXPECT_NE(complaintAbout("format: 2\nphysics_version: 3\ntick: 5\n", scenario)
                .find("snap.yaml: scenario: the key is missing"),
            std::string::npos);
}

// ---- the state that snapshots hold
// -----------------------------------------------------------------

TEST(SimulationState, ResetIsAFreshStart) {
  const Scenario scenario = parsed(validScenario());
  Simulation simulation = underWay(scenario);
  simulation.push({simulation.tick() + 5, 0, kAllEngines, {1.0, 1.0, 1.0}});
  simulation.reset(scenario.seed);
  Simulation fresh(scenario);
  EXPECT_EQ(simulation.hash(), fresh.hash());
  driveRarely(simulation, 200);
  driveRarely(fresh, 200);
  EXPECT_EQ(simulation.hash(), fresh.hash());
}

// A constant force on a free body: dP = F t, and it ends at its tick. In body axes of a craft that
// does not turn, the same.
TEST(SimulationState, AWrenchActsForItsTicksOnly) {
  Scenario scenario = parsed(validScenario());
  scenario.gravity = Vector3::Zero();
  scenario.wind = Vector3::Zero();
  scenario.vehicles[0].drag = Drag();
  scenario.vehicles[0].initial_v_WB = Vector3::Zero();
  scenario.vehicles[0].initial_w_WB = Vector3::Zero();
  for (const auto frame : {ExternalWrench::Frame::kWorld, ExternalWrench::Frame::kBody}) {
    Simulation simulation(scenario);
    const Vector3 force(1.0, 2.0, -3.0);
    simulation.applyWrench({0, frame, {force, Vector3::Zero()}, 50});
    for (int n = 0; n < 80; ++n) simulation.step();
    const Motion motion = simulation.motion(0);
    const Vector3 expected = 50 * 0.002 * force;
    const Vector3 moved = frame == ExternalWrench::Frame::kWorld
                              ? motion.momentum_W
                              : rotate(conjugate(motion.q_WB), motion.momentum_W);
    EXPECT_LT(norm(moved - expected), 1e-13);
    EXPECT_TRUE(simulation.state().wrenches.empty());
  }
}

TEST(SimulationState, MotionThatIsSetIsTheMotionThatIsReported) {
  for (const char* orientation : {"orientation: matrix", "orientation: quaternion"}) {
    Simulation simulation(parsed(with(validScenario(), "orientation: matrix", orientation)));
    const Quaternion q = quaternionFromRpy({0.3, -0.2, 1.1});
    simulation.setMotion(0, {7.0, 8.0, 9.0}, q, {{1.0, 2.0, 3.0}, {-0.1, 0.2, 0.3}});
    const Motion motion = simulation.motion(0);
    EXPECT_EQ(motion.p_WB, Vector3(7.0, 8.0, 9.0));
    EXPECT_LT(angleBetween(motion.q_WB, q), 1e-15);
    EXPECT_LT(norm(motion.twist.v_WB - Vector3(1.0, 2.0, 3.0)), 1e-14);
    EXPECT_LT(norm(motion.twist.w_WB - Vector3(-0.1, 0.2, 0.3)), 1e-15);
  }
}

TEST(SimulationState, EachWrenchChangesTheHash) {
  Simulation simulation(parsed(validScenario()));
  const std::uint64_t without = simulation.hash();
  simulation.applyWrench({0, ExternalWrench::Frame::kWorld, {}, 50});
  const std::uint64_t with_one = simulation.hash();
  simulation.applyWrench({0, ExternalWrench::Frame::kBody, {}, 50});
  EXPECT_NE(with_one, without);
  EXPECT_NE(simulation.hash(), with_one);
  EXPECT_NE(simulation.hash(0), Simulation(parsed(validScenario())).hash(0));
}

}  // namespace
}  // namespace hovercraft
