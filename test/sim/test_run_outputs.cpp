#include <memory>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/run.h"
#include "hovercraft_sim/sim/run_outputs.h"

#include "../support/scenarios.h"

namespace hovercraft {
namespace {

using testing::oneCraftYaml;
using testing::scenarioOf;

/// What one output was told, kept beyond its life.
struct Told {
  std::vector<Tick> states;
  int applied = 0;
  int closed = 0;
};

class Keeper : public RunObserver {
 public:
  explicit Keeper(Told& told) : told_(told) {}
  void state(const Simulation& simulation) override { told_.states.push_back(simulation.tick()); }
  void applied(const Command& /*command*/) override { ++told_.applied; }
  void close() override { ++told_.closed; }

 private:
  Told& told_;
};

RunPlan planOf(const RunOutputs& outputs, Tick last_tick) {
  RunPlan plan;
  plan.last_tick = last_tick;
  plan.every = outputs.every();
  return plan;
}

TEST(RunOutputs, EachIsToldStatesAtItsOwnRateAndAllElse) {
  Simulation simulation(scenarioOf(oneCraftYaml()));
  simulation.push({3, 0, kAllEngines, {1.0, 0.0, 0.0}});
  Told fast;
  Told slow;
  RunOutputs outputs;
  outputs.add(std::make_unique<Keeper>(fast), 4);
  outputs.add(std::make_unique<Keeper>(slow), 6);
  EXPECT_EQ(outputs.every(), 2);
  NoCommands commands;
  run(simulation, commands, outputs, planOf(outputs, 13));
  EXPECT_EQ(fast.states, (std::vector<Tick>{0, 4, 8, 12}));
  EXPECT_EQ(slow.states, (std::vector<Tick>{0, 6, 12}));
  for (const Told& told : {fast, slow}) {
    EXPECT_EQ(told.applied, 1);
    EXPECT_EQ(told.closed, 1);
  }
}

// As run() counts from where it begins.
TEST(RunOutputs, RatesCountFromTheFirstState) {
  Simulation simulation(scenarioOf(oneCraftYaml()));
  for (int i = 0; i < 5; ++i) simulation.step();
  Told told;
  RunOutputs outputs;
  outputs.add(std::make_unique<Keeper>(told), 3);
  NoCommands commands;
  run(simulation, commands, outputs, planOf(outputs, 12));
  EXPECT_EQ(told.states, (std::vector<Tick>{5, 8, 11}));
}

// A run may end by an error of its output; who looked on must not be told any more.
TEST(Run, TellsNobodyOnceItIsOver) {
  class Failing : public RunObserver {
   public:
    void state(const Simulation& simulation) override {
      if (simulation.tick() == 2) throw std::invalid_argument("full");
    }
    void applied(const Command& /*command*/) override { ++count; }
    int count = 0;
  };
  Simulation simulation(scenarioOf(oneCraftYaml()));
  NoCommands commands;
  RunPlan plan;
  plan.last_tick = 5;
  Failing failing;
  EXPECT_THROW(run(simulation, commands, failing, plan), std::invalid_argument);
  simulation.push({simulation.tick(), 0, kAllEngines, {1.0, 0.0, 0.0}});
  simulation.step();
  EXPECT_EQ(failing.count, 0);
}

}  // namespace
}  // namespace hovercraft
