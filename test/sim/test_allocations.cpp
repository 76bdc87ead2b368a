#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/batch.h"
#include "hovercraft_sim/sim/command_log.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/allocation_counter.h"
#include "../support/random_craft.h"
#include "../support/scenario_text.h"
#include "../support/sensor_scenario.h"

namespace hovercraft {
namespace {

using testing::allocations;

TEST(Allocations, AreCounted) {
  const long before = allocations;
  std::vector<double> numbers(1);
  numbers.resize(numbers.capacity() + 1);
  EXPECT_EQ(allocations - before, 2);
}

/// What a step and the pushes before it take from the heap, in 1000 ticks with a command in each.
long allocationsWhileDriven(const Scenario& scenario) {
  Simulation simulation(scenario);
  std::uint64_t applied = 0;
  RunCallbacks told;
  simulation.observe(&told);
  told.on_applied = [&applied](const Command& /*command*/) { ++applied; };
  const auto advance = [&] {
    const Tick tick = simulation.tick();
    simulation.push({tick, 0, kAllEngines, {1.0, 0.5, 0.25}});
    simulation.push({tick, 0, maskOf(EngineId::kLeft), {0.0, static_cast<double>(tick % 3), 0.0}});
    simulation.step();
  };
  advance();  // the log's memory grows once
  const long before = allocations;
  for (int n = 0; n < 1000; ++n) advance();
  const long taken = allocations - before;
  EXPECT_EQ(applied, 2002U);
  return taken;
}

TEST(Allocations, NoneInAStepOnACushionOverAnyGround) {
  for (const char* name : {"rc5", "rough", "ramp", "lift_fan"}) {
    Simulation simulation(loadScenario("config/" + std::string(name) + ".yaml"));
    for (int n = 0; n < 300; ++n) simulation.step();
    const long before = allocations;
    for (int n = 0; n < 300; ++n) simulation.step();
    EXPECT_EQ(allocations - before, 0) << name;
  }
}

TEST(Allocations, NoneInAStepOfGusts) {
  EXPECT_EQ(allocationsWhileDriven(loadScenario("config/gusts.yaml")), 0);
}

TEST(Allocations, NoneInATickOfABatch) {
  for (const bool has_gusts : {false, true}) {
    testing::RandomCraft craft(Integrator::kHeun, BodyModel::kSpatial, 1);
    craft.withActuators();
    if (has_gusts) craft.withGusts();
    Batch batch(craft.scenario(), 20);
    batch.push(7, {500, 0, kAllEngines, {1.0, 0.5, 0.25, 0.0, 0.0, 0.0, 0.0, 0.0}});
    const long before = allocations;
    batch.run(1000);
    EXPECT_EQ(allocations - before, 0) << has_gusts;
  }
}

TEST(Allocations, NoneInAStepWithEverySensor) {
  Simulation simulation(testing::scenarioOf(
      testing::sensedCraftYaml(testing::allSensors() + testing::laserSensor())));
  std::uint64_t count = 0;
  RunCallbacks told;
  simulation.observe(&told);
  told.on_sample = [&count](const SensorSample& /*sample*/) { ++count; };
  simulation.step();
  const long before = allocations;
  for (int n = 0; n < 1000; ++n) simulation.step();
  EXPECT_EQ(allocations - before, 0);
  EXPECT_GT(count, 200U);
}

TEST(Allocations, NoneInAStepWhateverIntegratorOrientationAndModel) {
  Scenario scenario = testing::parsed(testing::validScenario());
  for (const auto integrator : {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                Integrator::kHeun, Integrator::kRungeKutta4, Integrator::kLie4}) {
    for (const auto orientation : {OrientationKind::kQuaternion, OrientationKind::kMatrix}) {
      for (const auto model : {BodyModel::kPlanar, BodyModel::kSpatial}) {
        scenario.integrator = integrator;
        scenario.orientation = orientation;
        scenario.model = model;
        EXPECT_EQ(allocationsWhileDriven(scenario), 0)
            << static_cast<int>(integrator) << static_cast<int>(orientation)
            << static_cast<int>(model);
      }
    }
  }
}

TEST(Allocations, NoneInAStepWithContactsOnceWarmedUp) {
  Scenario scenario = loadScenario("config/tumble.yaml");
  for (auto& obstacle : scenario.world->obstacles)
    obstacle.name += " with a name that takes memory";
  Simulation simulation(scenario);
  int contacts = 0;
  RunCallbacks told;
  simulation.observe(&told);
  told.on_contact = [&contacts](const ContactEvent& /*event*/) { ++contacts; };
  const auto fly = [&simulation] {
    for (int i = 0; i < 2500; ++i) simulation.step();
  };
  fly();
  EXPECT_FALSE(simulation.state().contacts.empty());
  simulation.reset(1);
  const long at_reset = allocations;
  simulation.step();  // the memory of contacts grows again with the new state
  fly();
  const long before = allocations;
  for (int i = 0; i < 200; ++i) simulation.step();
  EXPECT_EQ(allocations, before);
  EXPECT_LT(before - at_reset, 40);
  EXPECT_GT(contacts, 200);
}

// A log that is never empty must not grow with the length of the run: a million commands, three in
// waiting, take the memory of a handful.
TEST(Allocations, OfACommandLogDoNotGrowWithTheRun) {
  CommandLog log;
  Tick pushed = 0;
  const auto push = [&] { log.push({pushed++, 0, kAllEngines, {0.0, 0.0, 0.0}}); };
  for (int i = 0; i < 3; ++i) push();
  for (Tick tick = 0; tick < 10; ++tick) {
    push();
    log.takeDue(tick);
  }
  const long before = allocations;
  for (Tick tick = 10; tick < 1000000; ++tick) {
    push();
    log.takeDue(tick);
  }
  EXPECT_EQ(allocations, before);
}

TEST(Allocations, NoneInReportingAStep) {
  const Simulation simulation(testing::parsed(testing::validScenario()));
  const long before = allocations;
  const Motion motion = simulation.motion(0);
  const EngineReport report = simulation.engineReport(0, 0);
  const std::uint64_t hash = simulation.hash();
  EXPECT_EQ(allocations, before) << motion.energy << report.applied << hash;
}

}  // namespace
}  // namespace hovercraft
