#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/States.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/bags/bag_writer.h"
#include "hovercraft_sim/bags/replay.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/live/live_run.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/run_events.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/files.h"
#include "../support/scenarios.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Command;
using hovercraft::Scenario;
using hovercraft::testing::messageOf;
using hovercraft::testing::scenarioOf;
using hovercraft::testing::TestFolder;
using hovercraft::testing::twoCraftYaml;
using hovercraft_sim::RunEvent;

/// A live run of two craft that is recorded as the node does: commands every 7 ticks, states every
/// 10; a wrench, a new motion, a reset and a load on the way.
class RecordedRun : public ::testing::Test {
 protected:
  void SetUp() override {
    recording_.scenario = scenario_;
    recording_.scenario_text = hovercraft::toYaml(scenario_);
    run_.simulation().observe(&told_);
    told_.on_applied = [this](const Command& command) {
      recording_.commands.push_back({now(), command});
      messages_[command.vehicle].appliedCommand(command, run_.place());
    };
    advance(45);
    hovercraft_sim::ApplyWrench::Request wrench;
    wrench.vehicle = "beta";
    wrench.frame_id = "beta/base_link";
    wrench.wrench.torque.z = 0.4;
    wrench.duration = ros::Duration(0.3);
    record(applyWrenchEvent(scenario_, wrench, TfFrames(), run_.simulation().tick()));
    advance(38);
    const std::string snapshot = hovercraft::toSnapshot(run_.simulation());
    record(resetEvent(3));
    advance(24);
    hovercraft_sim::SetState::Request motion;
    motion.vehicle = "alpha";
    motion.pose.orientation.w = 1.0;
    motion.twist.linear.y = 0.7;
    record(setStateEvent(scenario_, motion));
    advance(31);
    record(loadEvent(snapshot));
    advance(40);
  }

  RunTime now() const { return {run_.episode(), run_.simulation().tick()}; }

  void record(const RunEvent& event) { recording_.events.push_back(run_.apply(event)); }

  void advance(int ticks) {
    hovercraft::Simulation& simulation = run_.simulation();
    for (int n = 0; n < ticks; ++n) {
      const hovercraft::Tick tick = simulation.tick();
      if (tick % 7 == 0) {
        const double thrust = 0.1 * static_cast<double>(tick % 30);
        simulation.push({tick, 0, hovercraft::kAllEngines, {thrust, 0.0, 1.0}});
        simulation.push({tick, 1, 5, {1.0 - thrust, 0.0, thrust}});
      }
      simulation.step();
      if (simulation.tick() % 10 != 0) continue;
      for (std::size_t vehicle = 0; vehicle < messages_.size(); ++vehicle) {
        messages_[vehicle].fill(simulation, run_.place());
        recording_.states.push_back({now(), vehicle, messages_[vehicle].state()});
      }
    }
  }

  Scenario scenario_ = scenarioOf(twoCraftYaml());
  hovercraft::RunCallbacks told_;
  LiveRun run_{scenario_, 0};
  std::vector<VehicleMessages> messages_{{scenario_, 0}, {scenario_, 1}};
  Recording recording_;
};

TEST_F(RecordedRun, IsReplayedToTheLastBit) {
  const ReplayResult result = replay(recording_, scenario_, true);
  EXPECT_FALSE(result.difference);
  EXPECT_EQ(result.unknown_states, 0U);
  EXPECT_EQ(result.compared_states, recording_.states.size());
  EXPECT_EQ(recording_.states.back().time.episode, 2U);
}

// Whoever comes to a run that stands is given the state as it is by then.
TEST_F(RecordedRun, AStateThatCameAfterAnEventOfItsTickIsComparedAfterIt) {
  hovercraft_sim::SetState::Request motion;
  motion.vehicle = "beta";
  motion.pose.position.x = 7.0;
  motion.pose.orientation.w = 1.0;
  record(setStateEvent(scenario_, motion));
  for (std::size_t vehicle = 0; vehicle < messages_.size(); ++vehicle) {
    messages_[vehicle].fill(run_.simulation(), run_.place());
    recording_.states.push_back({now(), vehicle, messages_[vehicle].state()});
  }
  EXPECT_EQ(recording_.states.back().state.pose.position.x, 7.0);
  motion.pose.position.x = 8.0;
  record(setStateEvent(scenario_, motion));
  advance(20);
  const ReplayResult result = replay(recording_, scenario_, true);
  EXPECT_FALSE(result.difference);
  EXPECT_EQ(result.compared_states, recording_.states.size());
}

TEST_F(RecordedRun, WhatAnotherVersionKnewMoreOfACraftIsFound) {
  const auto difference_with = [this](const std::function<void(hovercraft_sim::State&)>& change) {
    Recording changed = recording_;
    change(changed.states[changed.states.size() / 2].state);
    return replay(changed, scenario_, true).difference;
  };
  EXPECT_FALSE(difference_with([](auto&) {}));
  const auto actuators = difference_with([](auto& state) { state.actuators = {1.0, 2.0}; });
  ASSERT_TRUE(actuators);
  EXPECT_EQ(actuators->field, "actuators");
  EXPECT_EQ(actuators->recorded, "2 numbers");
  EXPECT_EQ(actuators->replayed, "0 numbers");
  const auto extra = difference_with([](auto& state) { state.extra = {1.0}; });
  ASSERT_TRUE(extra);
  EXPECT_EQ(extra->field, "extra");
  const auto sensors = difference_with([](auto& state) { state.sensor_hash = 10; });
  ASSERT_TRUE(sensors);
  EXPECT_EQ(sensors->field, "sensor_hash");
  EXPECT_EQ(sensors->recorded, "000000000000000a");
}

TEST_F(RecordedRun, OneChangedBitIsFound) {
  const std::size_t place = recording_.states.size() / 2;
  double& number = recording_.states[place].state.angular_momentum.z;
  number = std::nextafter(number, 100.0);
  const ReplayResult result = replay(recording_, scenario_, true);
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(result.difference->field, "angular_momentum");
  EXPECT_EQ(result.difference->time.tick, recording_.states[place].time.tick);
  EXPECT_EQ(result.difference->time.episode, recording_.states[place].time.episode);
  EXPECT_EQ(result.compared_states, place + 1);
}

TEST_F(RecordedRun, AChangedHashIsFound) {
  recording_.states.back().state.hash ^= 1U;
  const ReplayResult result = replay(recording_, scenario_, true);
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(result.difference->field, "hash");
}

TEST_F(RecordedRun, ALostCommandAndALostEventAreDifferences) {
  Recording without_command = recording_;
  without_command.commands.erase(without_command.commands.begin() + 4);
  EXPECT_TRUE(replay(without_command, scenario_, true).difference);
  Recording without_wrench = recording_;
  without_wrench.events.erase(without_wrench.events.begin());
  EXPECT_TRUE(replay(without_wrench, scenario_, true).difference);
  Recording without_reset = recording_;
  without_reset.events.erase(without_reset.events.begin() + 1);
  EXPECT_THROW(replay(without_reset, scenario_, true), std::invalid_argument);
}

TEST_F(RecordedRun, NothingIsComparedBetweenAGapAndTheNextEpisode) {
  std::vector<std::size_t> states(3, 0);  // of each episode
  for (const auto& recorded : recording_.states) ++states[recorded.time.episode];
  recording_.commands.erase(recording_.commands.begin() + 6);
  recording_.gaps = {{recording_.states[4].time, "what was erased"}};
  const ReplayResult result = replay(recording_, scenario_, true);
  EXPECT_FALSE(result.difference);
  EXPECT_EQ(result.unknown_states, states[0] - 4);
  EXPECT_EQ(result.compared_states, 4 + states[1] + states[2]);
}

TEST_F(RecordedRun, AnotherMassParts) {
  Scenario heavier = scenario_;
  heavier.vehicles[1].mass_properties.mass = 2.5;
  const ReplayResult result = replay(recording_, heavier, true);
  ASSERT_TRUE(result.difference);
  EXPECT_EQ(result.difference->vehicle, "beta");
  EXPECT_EQ(result.difference->time.tick, 10);
}

/// What the last load of a replay made.
class ToldLoads : public RecordingObserver {
 public:
  void event(const RunEvent& event, const hovercraft::Simulation& simulation) override {
    if (event.kind != RunEvent::LOAD) return;
    velocity = simulation.motion(1).twist.v_WB;
    wind = simulation.state().wind_W;
    gusts = simulation.state().gusts.size();
  }

  hovercraft::Vector3 velocity = hovercraft::Vector3::Zero();
  hovercraft::Vector3 wind = hovercraft::Vector3::Zero();
  std::size_t gusts = 0;
};

TEST_F(RecordedRun, ALoadGivesAChangedScenarioTheMotionOfTheSnapshot) {
  Scenario heavier = scenario_;
  heavier.vehicles[1].mass_properties.mass *= 2.0;
  heavier.orientation = hovercraft::OrientationKind::kMatrix;
  ToldLoads told;
  replay(recording_, heavier, false, &told);
  hovercraft::Simulation expected(scenario_);
  applyEvent(recording_.events.back(), expected);
  EXPECT_LT(hovercraft::norm(told.velocity - expected.motion(1).twist.v_WB), 1e-15);
  EXPECT_GT(hovercraft::norm(told.velocity), 0.1);
}

TEST_F(RecordedRun, ALoadGivesAChangedScenarioItsOwnAir) {
  Scenario windy = scenario_;
  windy.wind = {2.0, 0.0, 0.0};
  const hovercraft::GustAxis level = {0.2, 20.0};
  windy.gusts = hovercraft::GustParameters{hovercraft::GustModel::kFirstOrder, level, level, {}};
  ToldLoads told;
  replay(recording_, windy, false, &told);
  EXPECT_EQ(told.wind, windy.wind);
  EXPECT_EQ(told.gusts, scenario_.vehicles.size());
}

/// Which messages get lost on the way into a bag.
struct Lost {
  std::set<std::size_t> commands;  // indices
  std::set<std::size_t> events;    // indices
  std::set<std::size_t> states{};  // indices
};

/// Writes the recording into a bag.
void writeBag(const Recording& recording, const std::vector<std::string>& names,
              const std::string& path, const Lost& lost = {}) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  const ros::Time time(1, 0);
  std_msgs::String scenario;
  scenario.data = recording.scenario_text;
  bag.write("/hovercraft_sim/scenario", time, scenario);
  std::map<std::pair<std::uint32_t, std::size_t>, std::uint64_t> number;  // by episode and vehicle
  for (std::size_t i = 0; i < recording.commands.size(); ++i) {
    const auto& recorded = recording.commands[i];
    hovercraft_sim::AppliedCommand message = toMessage(recorded.command);
    message.episode = recorded.time.episode;
    message.number = ++number[{message.episode, recorded.command.vehicle}];
    if (lost.commands.count(i) > 0) continue;
    bag.write("/" + names[recorded.command.vehicle] + "/commands", time, message);
  }
  for (std::size_t i = 0; i < recording.states.size(); ++i) {
    if (lost.states.count(i) > 0) continue;
    const auto& recorded = recording.states[i];
    hovercraft_sim::State message = recorded.state;
    message.header.seq = static_cast<std::uint32_t>(i / names.size());
    bag.write("/" + names[recorded.vehicle] + "/state", time, message);
  }
  for (std::size_t i = 0; i < recording.events.size(); ++i) {
    if (lost.events.count(i) > 0) continue;
    bag.write("/hovercraft_sim/events", time, recording.events[i]);
  }
}

/// Gathers the states of one tick of a bag into one message of all craft, as the node's ~states.
/// @param kept craft whose own topic stays as well.
void gatherStates(const std::string& from, const std::string& to, const std::string& kept) {
  rosbag::Bag bag(from, rosbag::bagmode::Read);
  rosbag::Bag result(to, rosbag::bagmode::Write);
  std::map<RunTime, hovercraft_sim::States> ticks;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag)) {
    const auto state = instance.instantiate<hovercraft_sim::State>();
    if (!state) {
      result.write(instance.getTopic(), instance.getTime(), instance);
      continue;
    }
    const std::string name = instance.getTopic().substr(1, instance.getTopic().rfind('/') - 1);
    if (name == kept) result.write(instance.getTopic(), instance.getTime(), *state);
    auto& all = ticks[{state->episode, static_cast<hovercraft::Tick>(state->tick)}];
    all.header = state->header;
    all.names.push_back(name);
    all.states.push_back(*state);
  }
  for (const auto& [time, all] : ticks) {
    result.write("/hovercraft_sim/states", ros::Time(1, 0), all);
  }
}

TEST_F(RecordedRun, IsReplayedFromTheStatesOfAllCraftInOneTopic) {
  const TestFolder folder;
  writeBag(recording_, {"alpha", "beta"}, folder.file("each.bag"));
  std::string of_each;
  ASSERT_EQ(replayBag({folder.file("each.bag"), "", {}}, of_each), 0) << of_each;
  for (const char* kept : {"none", "beta"}) {  // where a bag has both, no state counts twice
    gatherStates(folder.file("each.bag"), folder.file("all.bag"), kept);
    std::string verdict;
    EXPECT_EQ(replayBag({folder.file("all.bag"), "", {}}, verdict), 0) << verdict;
    EXPECT_EQ(verdict, of_each);
  }
}

TEST_F(RecordedRun, StatesOfAllCraftThatWereLostAreCounted) {
  const TestFolder folder;
  writeBag(recording_, {"alpha", "beta"}, folder.file("each.bag"), {{}, {}, {4, 5, 10, 11}});
  gatherStates(folder.file("each.bag"), folder.file("all.bag"), "none");
  std::string verdict;
  EXPECT_EQ(replayBag({folder.file("all.bag"), "", {}}, verdict), 0);
  EXPECT_NE(verdict.find("4 states were not recorded"), std::string::npos) << verdict;
}

TEST_F(RecordedRun, StatesWithoutANameEachAreRefused) {
  const TestFolder folder;
  writeBag(recording_, {"alpha", "beta"}, folder.file("run.bag"));
  {
    rosbag::Bag bag(folder.file("run.bag"), rosbag::bagmode::Append);
    hovercraft_sim::States states;
    states.names = {"alpha", "beta"};
    states.states.resize(1);
    bag.write("/hovercraft_sim/states", ros::Time(2, 0), states);
  }
  const auto replay = [&] {
    std::string verdict;
    replayBag({folder.file("run.bag"), "", {}}, verdict);
  };
  EXPECT_NE(messageOf(replay).find("names and states: must be as many (2 and 1 are there)"),
            std::string::npos)
      << messageOf(replay);
}

TEST_F(RecordedRun, GoesThroughABagAndThroughItsOutput) {
  const TestFolder folder;
  writeBag(recording_, {"alpha", "beta"}, folder.file("run.bag"));
  std::string verdict;
  EXPECT_EQ(replayBag({folder.file("run.bag"), folder.file("again.bag"), {}}, verdict), 0)
      << verdict;
  EXPECT_EQ(verdict.rfind("identical: ", 0), 0U) << verdict;
  std::string verdict_of_output;
  EXPECT_EQ(replayBag({folder.file("again.bag"), "", {}}, verdict_of_output), 0)
      << verdict_of_output;
  EXPECT_EQ(verdict_of_output, verdict);
}

TEST_F(RecordedRun, ALostMessageIsNamedAndGivesNoFalseVerdict) {
  const TestFolder folder;
  const std::size_t last = recording_.commands.size() - 1;
  const struct {
    Lost lost;
    std::string text;
  } cases[] = {
      {{{8}, {}}, "command 5 of alpha in episode 0 (from tick 30 on)"},
      {{{3, 5, 7}, {}}, "commands 2 to 4 of beta in episode 0 (from tick 10 on)"},
      {{{0, 1, 2, 3}, {}}, "commands 1 to 2 of alpha in episode 0 (from tick 10 on)"},  // came late
      {{{last}, {}}, "command 6 of beta in episode 2 (from tick 120 on)"},
      {{{}, {0}}, "event 1 in episode 0 (from tick 50 on)"},
      {{{}, {1}}, "event 1 in episode 1 (from tick 10 on)"},
      {{{}, {2}}, "event 2 in episode 1 (from tick 30 on)"},
      {{{}, {3}}, "event 1 in episode 2 (from tick 90 on)"},
      {{{8}, {2}},
       "command 5 of alpha in episode 0 (from tick 30 on), event 2 in episode 1 (from tick 30 on)"},
  };
  for (const auto& [lost, text] : cases) {
    writeBag(recording_, {"alpha", "beta"}, folder.file("gap.bag"), lost);
    std::string verdict;
    EXPECT_EQ(replayBag({folder.file("gap.bag"), "", {}}, verdict), 2) << text << ": " << verdict;
    EXPECT_EQ(verdict.rfind("identical where it can be checked: ", 0), 0U) << verdict;
    const std::string end = "states cannot: the bag lacks " + text;
    ASSERT_GE(verdict.size(), end.size());
    EXPECT_EQ(verdict.substr(verdict.size() - end.size()), end);
  }
}

/// The two may have met in the meantime: what beta did then cannot be checked either.
TEST_F(RecordedRun, ACommandLostWithTheStateAfterItLeavesTheOtherCraftUnknownToo) {
  const TestFolder folder;
  ASSERT_EQ(recording_.states[4].vehicle, 0U);
  ASSERT_EQ(recording_.states[4].time.tick, 30);
  writeBag(recording_, {"alpha", "beta"}, folder.file("gap.bag"), {{8}, {}, {4}});
  const Recording recording = readRecording(folder.file("gap.bag"));
  ASSERT_EQ(recording.gaps.size(), 1U);
  EXPECT_EQ(recording.gaps[0].missing, "command 5 of alpha in episode 0");
  EXPECT_EQ(recording.gaps[0].begin.episode, 0U);
  EXPECT_EQ(recording.gaps[0].begin.tick, 30);
}

TEST_F(RecordedRun, WhatIsLostAfterTheLastStateDoesNotMatter) {
  const TestFolder folder;
  auto later = recording_.commands.back();
  later.time.tick = later.command.tick = recording_.states.back().time.tick + 1;
  recording_.commands.insert(recording_.commands.end(), 2, later);
  writeBag(recording_, {"alpha", "beta"}, folder.file("run.bag"),
           {{recording_.commands.size() - 2}, {}});
  std::string verdict;
  EXPECT_EQ(replayBag({folder.file("run.bag"), "", {}}, verdict), 0) << verdict;
}

TEST_F(RecordedRun, ADifferenceIsToldWithItsPlaceAndBothValues) {
  const TestFolder folder;
  auto& changed = recording_.states[recording_.states.size() - 2];
  const double replayed = changed.state.velocity.x;
  const double recorded = std::nextafter(replayed, 100.0);
  changed.state.velocity.x = recorded;
  ASSERT_EQ(changed.time.episode, 2U);
  writeBag(recording_, {"alpha", "beta"}, folder.file("run.bag"));
  std::string verdict;
  EXPECT_EQ(replayBag({folder.file("run.bag"), "", {}}, verdict), 1);
  EXPECT_EQ(verdict, fmt::format("different: episode 2, tick {}, alpha: velocity = {} recorded, "
                                 "{} replayed",
                                 changed.time.tick, hovercraft::numberText(recorded),
                                 hovercraft::numberText(replayed)));
  changed.state.velocity.x = replayed;
  changed.state.hash ^= 0xfU;
  writeBag(recording_, {"alpha", "beta"}, folder.file("run.bag"));
  EXPECT_EQ(replayBag({folder.file("run.bag"), "", {}}, verdict), 1);
  EXPECT_EQ(verdict, fmt::format("different: episode 2, tick {}, alpha: hash = {:016x} recorded, "
                                 "{:016x} replayed",
                                 changed.time.tick, changed.state.hash, changed.state.hash ^ 0xfU));
}

TEST_F(RecordedRun, TwoRunsInABagAreAnError) {
  const TestFolder folder;
  recording_.states.push_back(recording_.states[2]);
  writeBag(recording_, {"alpha", "beta"}, folder.file("twice.bag"));
  EXPECT_NE(messageOf([&] { readRecording(folder.file("twice.bag")); }).find("more than one run"),
            std::string::npos);
}

TEST_F(RecordedRun, ChangesOfTheScenarioAreChecked) {
  const TestFolder folder;
  const std::string bag = folder.file("run.bag");
  writeBag(recording_, {"alpha", "beta"}, bag);
  std::string verdict;
  EXPECT_EQ(replayBag({bag, "", {"vehicles.beta.mass=3"}}, verdict), 0);
  EXPECT_EQ(verdict.rfind("replayed with changes: ", 0), 0U) << verdict;
  for (const char* bad : {"vehicles.beta.weight=3", "mass", "vehicles.gamma.mass=3", "=3"}) {
    EXPECT_NE(messageOf([&] {
                replayBag({bag, "", {bad}}, verdict);
              }).find("--set "),
              std::string::npos)
        << bad;
  }
  EXPECT_NE(messageOf([&] {
              replayBag({bag, "", {"vehicles.beta.mass=-3"}}, verdict);
            }).find("must be greater than 0"),
            std::string::npos);
}

TEST(Recording, WhatIsMissingIsNamed) {
  const TestFolder folder;
  EXPECT_NE(messageOf([&] { readRecording(folder.file("none.bag")); }).find("none.bag"),
            std::string::npos);
  { const rosbag::Bag empty(folder.file("empty.bag"), rosbag::bagmode::Write); }
  EXPECT_NE(
      messageOf([&] { readRecording(folder.file("empty.bag")); }).find("there is no scenario"),
      std::string::npos);
}

}  // namespace
}  // namespace hovercraft_ros
