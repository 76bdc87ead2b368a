#include <algorithm>
#include <deque>
#include <type_traits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/run.h"

#include "../support/scenarios.h"

namespace hovercraft {
namespace {

using testing::oneCraftYaml;
using testing::scenarioOf;
using testing::twoCraftYaml;

constexpr double kRunRounding = 1e-12;

Command commandAt(Tick tick, double rear, std::size_t vehicle = 0) {
  return {tick, vehicle, maskOf(EngineId::kRear), Vector3(rear, 0.0, 0.0)};
}

class ListedCommands : public CommandSource {
 public:
  explicit ListedCommands(std::deque<Command> commands) : commands_(std::move(commands)) {}

  std::optional<Command> next() override {
    if (commands_.empty()) return std::nullopt;
    Command command = commands_.front();
    commands_.pop_front();
    ++taken_;
    return command;
  }
  std::size_t taken() const { return taken_; }

 private:
  std::deque<Command> commands_;
  std::size_t taken_ = 0;
};

/// Keeps what it is given; looks at how far ahead the source was read.
class KeptStates : public RunObserver {
 public:
  void state(const Simulation& simulation) override {
    EXPECT_FALSE(is_closed);
    ticks.push_back(simulation.tick());
    motions.push_back(simulation.motion(0));
  }
  void applied(const Command& command) override { commands.push_back(command); }
  void close() override { is_closed = true; }

  std::vector<Tick> ticks;
  std::vector<Motion> motions;
  std::vector<Command> commands;
  bool is_closed = false;
};

RunPlan planOf(Tick last_tick, Tick every = 1) {
  RunPlan plan;
  plan.last_tick = last_tick;
  plan.every = every;
  return plan;
}

TEST(Run, APlanThatIsNotFilledInEndsAtTheStart) {
  Simulation simulation(scenarioOf(oneCraftYaml()));
  NoCommands commands;
  KeptStates states;
  run(simulation, commands, states, RunPlan());
  EXPECT_EQ(states.ticks, std::vector<Tick>{0});
  EXPECT_EQ(simulation.tick(), 0);
}

// What was taken from it is gone: a copy would give it again.
TEST(Run, ASourceOfCommandsIsNotCopied) {
  EXPECT_FALSE(std::is_copy_constructible_v<ListedCommands>);
  EXPECT_FALSE(std::is_copy_assignable_v<ListedCommands>);
}

TEST(Run, PutsOutEveryNthTickFromZero) {
  Simulation simulation(scenarioOf(oneCraftYaml()));
  NoCommands commands;
  KeptStates states;
  run(simulation, commands, states, planOf(20, 7));
  EXPECT_EQ(states.ticks, (std::vector<Tick>{0, 7, 14}));
  EXPECT_EQ(simulation.tick(), 20);
  EXPECT_TRUE(states.is_closed);
}

TEST(Run, PutsOutTheLastTickIfItIsItsTurn) {
  Simulation simulation(scenarioOf(oneCraftYaml()));
  NoCommands commands;
  KeptStates states;
  run(simulation, commands, states, planOf(4, 2));
  EXPECT_EQ(states.ticks, (std::vector<Tick>{0, 2, 4}));
}

TEST(Run, ACommandActsFromItsTickUntilTheNextOne) {
  // 4 N on 2 kg from 0.1 s to 0.3 s: v = 2 (t - 0.1), then 0.4 m/s; x = 1 (0.2)² + 0.4 (t - 0.3).
  Simulation simulation(scenarioOf(oneCraftYaml()));
  ListedCommands commands({commandAt(10, 4.0), commandAt(30, 0.0)});
  KeptStates states;
  run(simulation, commands, states, planOf(60));
  EXPECT_EQ(states.motions[10].twist.v_WB.x(), 0.0);
  EXPECT_NEAR(states.motions[11].twist.v_WB.x(), 0.02, kRunRounding);
  EXPECT_NEAR(states.motions[30].twist.v_WB.x(), 0.4, kRunRounding);
  EXPECT_NEAR(states.motions[60].twist.v_WB.x(), 0.4, kRunRounding);
  EXPECT_NEAR(states.motions[60].p_WB.x(), 0.04 + 0.4 * 0.3, kRunRounding);
  ASSERT_EQ(states.commands.size(), 2U);
  EXPECT_EQ(states.commands[1].tick, 30);
}

TEST(Run, ReadsTheSourceOneCommandAhead) {
  std::deque<Command> many;
  for (Tick tick = 0; tick < 100; ++tick) many.push_back(commandAt(tick, 1.0));
  ListedCommands commands(many);
  Simulation simulation(scenarioOf(oneCraftYaml()));
  KeptStates states;
  run(simulation, commands, states, planOf(10));
  EXPECT_EQ(states.commands.size(), 10U);  // of the ticks 0 to 9
  EXPECT_EQ(commands.taken(), 11U);
}

TEST(Run, ReportsEachEngineThatTimedOutOnceWithItsFirstTimeAndCount) {
  // Time-out 0.5 s = 50 ticks: 100 to 150 and 210 to 260, of which the run sees both begin.
  Simulation simulation(scenarioOf(oneCraftYaml()));
  ListedCommands commands({commandAt(60, 2.0), commandAt(100, 3.0), commandAt(210, 4.0)});
  KeptStates states;
  const RunSummary summary = run(simulation, commands, states, planOf(300));
  ASSERT_EQ(summary.timeouts.size(), 1U);
  EXPECT_EQ(summary.timeouts[0].vehicle, 0U);
  EXPECT_EQ(summary.timeouts[0].engine, 0);
  EXPECT_EQ(summary.timeouts[0].count, 2);
  EXPECT_EQ(summary.timeouts[0].first_tick, 150);
  EXPECT_EQ(summary.timeouts[0].first_commanded, 3.0);
  // The craft says the same: thrust from 100 to 150 adds 3/2 · 0.5, and then nothing to 210.
  const double before = states.motions[100].twist.v_WB.x();
  EXPECT_NEAR(states.motions[150].twist.v_WB.x(), before + 0.75, kRunRounding);
  EXPECT_EQ(states.motions[210].twist.v_WB.x(), states.motions[150].twist.v_WB.x());
}

TEST(Run, ACommandAtTheVeryTickOfTheTimeOutComesInTime) {
  Simulation simulation(scenarioOf(oneCraftYaml()));
  ListedCommands commands({commandAt(0, 2.0), commandAt(50, 2.0), commandAt(100, 2.0)});
  KeptStates states;
  EXPECT_TRUE(run(simulation, commands, states, planOf(150)).timeouts.empty());
  EXPECT_NEAR(states.motions[150].twist.v_WB.x(), 1.5, kRunRounding);
}

TEST(Run, TellsTheVehiclesApart) {
  Simulation simulation(scenarioOf(twoCraftYaml()));
  ListedCommands commands({commandAt(0, 2.0, 1)});
  KeptStates states;
  const RunSummary summary = run(simulation, commands, states, planOf(100));
  ASSERT_EQ(summary.timeouts.size(), 1U);
  EXPECT_EQ(summary.timeouts[0].vehicle, 1U);
  EXPECT_EQ(states.motions.back().p_WB.x(), 0.0);
  EXPECT_GT(simulation.motion(1).p_WB.x(), 0.0);
}

TEST(Run, TheSameRunGivesTheSameHash) {
  std::vector<std::uint64_t> hashes;
  for (const double thrust : {2.0, 2.0, 2.0000000000000004}) {
    Simulation simulation(scenarioOf(oneCraftYaml()));
    ListedCommands commands({commandAt(0, thrust)});
    KeptStates states;
    hashes.push_back(run(simulation, commands, states, planOf(100)).hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_NE(hashes[0], hashes[2]);
}

TEST(Run, CallsForProgress) {
  Simulation simulation(scenarioOf(oneCraftYaml()));
  NoCommands commands;
  KeptStates states;
  std::vector<Tick> shown;
  RunPlan plan = planOf(2 * kProgressInterval + 1, kProgressInterval);
  plan.on_progress = [&](Tick tick) { shown.push_back(tick); };
  run(simulation, commands, states, plan);
  EXPECT_EQ(shown, (std::vector<Tick>{0, kProgressInterval, 2 * kProgressInterval}));
}

}  // namespace
}  // namespace hovercraft
