#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/batch.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/state_hash.h"

#include "../support/batch_beside.h"
#include "../support/foreign_environment.h"
#include "../support/random_craft.h"
#include "../support/same_bits.h"
#include "../support/share.h"

namespace hovercraft {
namespace {

using testing::Beside;
using testing::bitsOf;
using testing::RandomCraft;
using testing::shareOf;
using testing::withEveryKind;

std::vector<Scenario> scenariosOf(RandomCraft& craft, std::size_t count) {
  std::vector<Scenario> scenarios;
  scenarios.reserve(count);
  for (std::size_t run = 0; run < count; ++run) scenarios.push_back(craft.scenario());
  return scenarios;
}

/// Random craft whose commands come at ticks of their own; each tick is compared.
void expectSameBits(RandomCraft craft, InstructionSet set, Tick ticks) {
  constexpr std::size_t kRuns = 21;  // not a whole number of blocks
  const std::vector<Scenario> scenarios = scenariosOf(craft, kRuns);
  Beside both(scenarios, set);
  for (Tick tick = 0; tick < ticks; ++tick) {
    for (std::size_t run = 0; run < kRuns; ++run) {
      if (auto command = craft.command(tick)) both.push(run, *command);
    }
    ASSERT_EQ(both.differingAfter(1), 0U)
        << craft.name() << ", " << instructionSetName(set) << ", tick " << tick;
  }
}

std::string refusalOf(const std::vector<Scenario>& scenarios, const BatchOptions& options = {}) {
  try {
    const Batch batch(scenarios, options);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

Scenario plainScenario() {
  return RandomCraft(Integrator::kHeun, BodyModel::kPlanar, 1).scenario();
}

/// Of one change.
template <class Change>
std::string refusalAfter(Change change) {
  Scenario scenario = plainScenario();
  change(scenario);
  return refusalOf({scenario});
}

/// Of a second run that differs from the first.
template <class Change>
std::string refusalOfSecond(Change change) {
  Scenario scenario = plainScenario();
  change(scenario);
  return refusalOf({plainScenario(), scenario});
}

// ---- the bits of Simulation ---------------------------------------------------------------------

TEST(Batch, EveryRunHasTheBitsOfItsSimulationAtEveryTick) {
  withEveryKind([](Integrator integrator, BodyModel model, InstructionSet set) {
    expectSameBits(RandomCraft(integrator, model, 1), set, shareOf(600));
  });
}

TEST(Batch, FansPropellersRuddersPolarsAndRotorsHaveTheirBits) {
  withEveryKind([](Integrator integrator, BodyModel model, InstructionSet set) {
    expectSameBits(RandomCraft(integrator, model, 2).withActuators(), set, shareOf(300));
  });
}

TEST(Batch, GustsHaveTheirBits) {
  withEveryKind([](Integrator integrator, BodyModel model, InstructionSet set) {
    expectSameBits(RandomCraft(integrator, model, 3).withGusts(), set, shareOf(100));
  });
}

/// Commands of some ticks to every run of both.
void pushSome(Beside& both, RandomCraft& craft, Tick first, Tick end) {
  for (std::size_t run = 0; run < both.batch().size(); ++run) {
    for (Tick tick = first; tick < end; ++tick) {
      if (const auto command = craft.command(tick)) both.push(run, *command);
    }
  }
}

TEST(Batch, ManyTicksAtOnceAreTheSameAsOneByOne) {
  for (const bool has_gusts : {false, true}) {
    RandomCraft craft(Integrator::kHeun, BodyModel::kSpatial, 4);
    if (has_gusts) craft.withGusts();
    const std::vector<Scenario> scenarios = scenariosOf(craft, 300);
    for (const int threads : {1, 2, 5}) {
      Beside both(scenarios, availableInstructionSets().back(), threads);
      for (Tick first = 0; first < 350; first += 70) {
        pushSome(both, craft, first, first + 70);
        ASSERT_EQ(both.differingAfter(70), 0U) << threads << " threads, from tick " << first;
      }
    }
  }
}

/// Craft whose momenta and thrusts decay to nothing within a second.
std::vector<Scenario> heavilyDamped() {
  RandomCraft craft(Integrator::kHeun, BodyModel::kPlanar, 5);
  std::vector<Scenario> scenarios = scenariosOf(craft, 9);
  for (Scenario& scenario : scenarios) {
    scenario.wind = scenario.gravity = Vector3::Zero();
    VehicleScenario& vehicle = scenario.vehicles.front();
    vehicle.drag = {};
    vehicle.drag.linear = Vector3::Constant(400.0 * vehicle.mass_properties.mass);
    vehicle.drag.angular_linear = 0.01 * vehicle.drag.linear;
    for (EngineParameters& engine : vehicle.engines) {
      engine.time_constant = 0.001;
      engine.timeout_ns = 5000000;
    }
  }
  return scenarios;
}

TEST(Batch, WhatDecaysEndsAtZeroAsInASimulation) {
  const std::vector<Scenario> scenarios = heavilyDamped();
  for (const InstructionSet set : availableInstructionSets()) {
    Beside both(scenarios, set);
    for (std::size_t run = 0; run < scenarios.size(); ++run) {
      both.push(run, {0, 0, kAllEngines, Vector3(2.0, 1.0, 0.5)});
    }
    for (Tick tick = 0; tick < 1500; ++tick) ASSERT_EQ(both.differingAfter(1), 0U) << tick;
    for (std::size_t run = 0; run < scenarios.size(); ++run) {
      EXPECT_EQ(both.batch().body(run).momentum_W, Vector3(Vector3::Zero()));
      EXPECT_EQ(both.batch().actuators(run)[0].thrust, 0.0);
    }
  }
}

/// Four of twenty craft are too stiff for their steps.
std::vector<Scenario> someTooStiff(BodyModel model, bool has_gusts) {
  RandomCraft craft(Integrator::kRungeKutta4, model, 6);
  if (has_gusts) craft.withGusts();
  std::vector<Scenario> scenarios = scenariosOf(craft, 20);
  for (const std::size_t run : {1U, 2U, 9U, 19U}) {
    Drag& drag = scenarios[run].vehicles.front().drag;
    drag.linear = Vector3::Constant(2e4 * static_cast<double>(run));
    drag.quadratic = Vector3::Constant(1e3);
  }
  return scenarios;
}

/// @param ticks that are made at once.
void expectFourLost(const std::vector<Scenario>& scenarios, InstructionSet set, Tick ticks) {
  Beside both(scenarios, set);
  for (Tick tick = 0; tick < 200; tick += ticks) {
    for (std::size_t run = 0; run < scenarios.size(); ++run) {
      both.push(run, {tick + ticks / 2, 0, kAllEngines, Vector3(1.0, 0.5, 0.2)});
    }
    ASSERT_EQ(both.differingAfter(ticks), 0U) << instructionSetName(set) << ", tick " << tick;
  }
  EXPECT_EQ(both.lostCount(), 4);
  EXPECT_EQ(both.batch().tick(), 200);
  EXPECT_FALSE(both.batch().divergedAt(0).has_value());
}

TEST(Batch, ARunThatDivergesStaysAsItWasAndDisturbsNoOther) {
  for (const BodyModel model : {BodyModel::kPlanar, BodyModel::kSpatial}) {
    for (const bool has_gusts : {false, true}) {
      const std::vector<Scenario> scenarios = someTooStiff(model, has_gusts);
      for (const InstructionSet set : availableInstructionSets()) {
        for (const Tick ticks : {1, 50}) expectFourLost(scenarios, set, ticks);
      }
    }
  }
}

/// Changes a craft in the plane in one of eight ways: zeros of either sign, a number near the
/// greatest there are.
void makeExtreme(Scenario& scenario, std::size_t way, double great) {
  VehicleScenario& vehicle = scenario.vehicles.front();
  switch (way) {
    case 0:
      vehicle.drag.linear.z() = vehicle.drag.quadratic.z() = great;
      return;
    case 1:
      vehicle.drag.angular_quadratic.x() = great;
      return;
    case 2:
      vehicle.initial_v_WB = {great, -0.0, -0.0};
      return;
    case 3:
      vehicle.initial_w_WB = {-0.0, -0.0, great};
      return;
    case 4:
      vehicle.engines[0].max_thrust = great;
      return;
    case 5:
      vehicle.initial_p_WB = {-0.0, great, -0.0};
      return;
    case 6:
      vehicle.initial_rpy = vehicle.initial_w_WB = Vector3::Constant(-0.0);
      return;
    default:
      scenario.wind.z() = great;
  }
}

/// A block of eight for each way.
std::vector<Scenario> extremes() {
  RandomCraft craft(Integrator::kHeun, BodyModel::kPlanar, 8);
  std::vector<Scenario> scenarios = scenariosOf(craft, 64);
  for (std::size_t run = 0; run < scenarios.size(); ++run) {
    makeExtreme(scenarios[run], run / 8, std::pow(10.0, 40.0 * static_cast<double>(run % 8)));
  }
  return scenarios;
}

TEST(Batch, InThePlaneExtremesHaveTheirBits) {
  const std::vector<Scenario> scenarios = extremes();
  for (const InstructionSet set : availableInstructionSets()) {
    Beside both(scenarios, set);
    for (Tick tick = 0; tick < 100; ++tick) {
      for (std::size_t run = 0; tick == 0 && run < scenarios.size(); ++run) {
        both.push(run, {0, 0, kAllEngines, Vector3(1e300, 1.0, -1e300)});
      }
      ASSERT_EQ(both.differingAfter(1), 0U) << instructionSetName(set) << ", " << tick;
    }
    EXPECT_GT(both.lostCount(), 5);
  }
}

TEST(Batch, DoesNotDependOnTheFloatingPointEnvironment) {
  RandomCraft craft(Integrator::kHeun, BodyModel::kSpatial, 7);
  const std::vector<Scenario> scenarios = scenariosOf(craft.withActuators().withGusts(), 9);
  testing::expectSameBits("Batch", [&scenarios] {
    Batch batch(scenarios, {2, std::nullopt});
    for (std::size_t run = 0; run < batch.size(); ++run) {
      batch.push(run, {3, 0, kAllEngines, {1.0, -0.7, 0.3, 0.1, 0.1, 0.1, 0.2, 0.1}});
    }
    batch.run(100);
    StateHash all;
    for (std::size_t run = 0; run < batch.size(); ++run) {
      all.add(batch.hash(run));
      all.add(bitsOf(batch.motion(run)));
    }
    return all.value();
  });
}

// ---- what runs there are ------------------------------------------------------------------------

TEST(Batch, RunsOfOneScenarioAreAsMany) {
  Batch batch(plainScenario(), 3);
  batch.add(plainScenario());
  batch.run(5);
  EXPECT_EQ(batch.size(), 4U);
  EXPECT_EQ(batch.hash(3), batch.hash(0));
  EXPECT_EQ(batch.tick(), 5);
}

TEST(Batch, RefusesByNameWhatItCannotDo) {
  EXPECT_EQ(refusalAfter([](Scenario& s) { s.world = WorldScenario(); }),
            "world: a batch has craft that meet nothing: must not be");
  EXPECT_EQ(refusalAfter([](Scenario& s) { s.vehicles.push_back(s.vehicles.front()); }),
            "vehicles: a run of a batch must have one craft");
  EXPECT_EQ(refusalAfter([](Scenario& s) {
              s.model = BodyModel::kSpatial;
              s.vehicles.front().cushion = CushionParameters();
            }),
            "vehicles.craft.cushion: must have a ground in a batch of model: spatial");
  EXPECT_EQ(refusalAfter([](Scenario& s) {
              s.ground = GroundScenario{HeightMapScenario(), {}};
            }),
            "ground.height_map: a batch has planes alone: must not be");
  EXPECT_EQ(refusalAfter([](Scenario& s) { s.vehicles.front().sensors.resize(1); }),
            "vehicles.craft.sensors: a batch reads no sensors: must not be");
  EXPECT_EQ(refusalAfter([](Scenario& s) { s.orientation = OrientationKind::kMatrix; }),
            "orientation: must be quaternion in a batch");
  EXPECT_EQ(
      refusalAfter([](Scenario& s) { s.vehicles.front().drag_laws.resize(13, DragPolar()); }),
      "vehicles.craft: a batch has at most 12 laws of drag and actuators besides the engines");
  EXPECT_EQ(refusalOf({}), "a batch must have a scenario");
  EXPECT_EQ(refusalOf({plainScenario()}, {0, std::nullopt}), "threads = 0: must be 1 or greater");
}

TEST(Batch, RefusesByNameInWhatARunMustNotDiffer) {
  const std::string rule = ": must be that of the first run of the batch";
  EXPECT_EQ(refusalOfSecond([](Scenario& s) { s.step_ns = 2000000; }), "run 1: step_size" + rule);
  EXPECT_EQ(refusalOfSecond([](Scenario& s) { s.integrator = Integrator::kEuler; }),
            "run 1: integrator" + rule);
  EXPECT_EQ(refusalOfSecond([](Scenario& s) { s.model = BodyModel::kSpatial; }),
            "run 1: model" + rule);
  EXPECT_EQ(refusalOfSecond([](Scenario& s) { s.gusts = GustParameters(); }),
            "run 1: gusts" + rule);
  EXPECT_EQ(refusalOfSecond([](Scenario& s) { s.vehicles.front().actuators.resize(1); }),
            "run 1: the names of the actuators" + rule);
  EXPECT_EQ(refusalOfSecond([](Scenario& s) { s.vehicles.front().drag_laws = {DragPolar()}; }),
            "run 1: actuators and polar: their kinds and fans" + rule);
  EXPECT_EQ(refusalOfSecond([](Scenario& s) {
              s.vehicles.front().engines[1].rotor = {1e-5, 900.0, 1.0};
            }),
            "run 1: which actuators have a rotor" + rule);
  EXPECT_EQ(refusalOfSecond([](Scenario& s) { s.world = WorldScenario(); }),
            "run 1: world: a batch has craft that meet nothing: must not be");
  EXPECT_EQ(refusalOfSecond([](Scenario& s) { s.vehicles.front().name = "other"; }), "");
}

TEST(Batch, AnInstructionSetThatIsNotThereIsRefused) {
  const std::vector<InstructionSet> sets = availableInstructionSets();
  ASSERT_GE(sets.size(), 2U);
  EXPECT_EQ(sets.front(), InstructionSet::kScalar);
  for (const InstructionSet set : {InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    const bool is_there = std::find(sets.begin(), sets.end(), set) != sets.end();
    EXPECT_EQ(refusalOf({plainScenario()}, {1, set}),
              is_there ? ""
                       : std::string("instruction set ") + instructionSetName(set) +
                             ": this machine does not have it");
  }
}

}  // namespace
}  // namespace hovercraft
