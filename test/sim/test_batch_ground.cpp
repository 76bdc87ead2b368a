#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/batch.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/batch_beside.h"
#include "../support/random_craft.h"
#include "../support/random_cushion.h"
#include "../support/share.h"

/// Batches of craft on cushions and pads over a plane.

namespace hovercraft {
namespace {

using testing::Beside;
using testing::CushionKind;
using testing::RandomCraft;
using testing::RandomCushion;
using testing::shareOf;
using testing::withEveryKind;

constexpr std::size_t kRuns = 21;  // not a whole number of blocks

std::vector<Scenario> scenariosOf(RandomCraft& random, const CushionKind& kind,
                                  std::size_t count = kRuns) {
  std::vector<Scenario> scenarios;
  for (std::size_t run = 0; run < count; ++run) {
    scenarios.push_back(random.scenario());
    RandomCushion(random, kind).putUnder(scenarios.back());
  }
  return scenarios;
}

void pushSome(Beside& both, RandomCraft& random, const CushionKind& kind, Tick tick) {
  for (std::size_t run = 0; run < kRuns; ++run) {
    if (const auto command = random.command(tick)) both.push(run, *command);
    if (!kind.is_turned || !random.chance(0.03)) continue;
    Command command{tick, 0, maskOf(kFirstActuator), {}};
    command.thrusts.resize(kFirstActuator + 1);
    command.thrusts[kFirstActuator] = random.uniform(-0.3, 1.5);
    both.push(run, command);
  }
}

/// @returns how many craft were lost.
std::ptrdiff_t expectSameBits(RandomCraft random, const CushionKind& kind, InstructionSet set,
                              Tick ticks) {
  Beside both(scenariosOf(random, kind), set);
  for (Tick tick = 0; tick < ticks; ++tick) {
    pushSome(both, random, kind, tick);
    EXPECT_EQ(both.differingAfter(1), 0U) << random.name() << ", " << kind.name() << ", "
                                          << instructionSetName(set) << ", tick " << tick;
    if (::testing::Test::HasFailure()) break;
  }
  return both.lostCount();
}

void expectSameBitsOf(const CushionKind& kind, std::uint32_t seed, Tick ticks) {
  withEveryKind([&](Integrator integrator, BodyModel model, InstructionSet set) {
    if (::testing::Test::HasFailure()) return;
    const auto lost = expectSameBits(RandomCraft(integrator, model, seed), kind, set, ticks);
    EXPECT_LT(lost, static_cast<std::ptrdiff_t>(kRuns / 2));  // most of them do fly
  });
}

TEST(BatchOverGround, FourCellsHaveTheBitsOfTheirSimulationsAtEveryTick) {
  expectSameBitsOf({4}, 11, shareOf(200));
}

TEST(BatchOverGround, OneCellHasTheBitsOfItsSimulation) {
  expectSameBitsOf({1}, 12, shareOf(200));
}

TEST(BatchOverGround, SymmetricCraftAreSummedInMirroredPairs) {
  expectSameBitsOf({4, true, true}, 13, shareOf(100));
  expectSameBitsOf({1, true}, 14, shareOf(100));
}

TEST(BatchOverGround, FansThatActuatorsTurnAndThatFollowTimeHaveTheirBits) {
  CushionKind kind;
  kind.is_turned = true;
  expectSameBitsOf(kind, 15, shareOf(150));
  kind.follows_time = true;
  expectSameBitsOf(kind, 16, shareOf(150));
}

TEST(BatchOverGround, HullsOnTheirPadsHaveTheirBits) {
  CushionKind kind;
  kind.has_hull = true;
  expectSameBitsOf(kind, 17, shareOf(150));
  kind.has_cushion = false;
  expectSameBitsOf(kind, 18, shareOf(150));
}

TEST(BatchOverGround, CushionsInGustsHaveTheirBits) {
  for (const InstructionSet set : availableInstructionSets()) {
    for (const BodyModel model : {BodyModel::kPlanar, BodyModel::kSpatial}) {
      RandomCraft random(Integrator::kHeun, model, 19);
      expectSameBits(random.withGusts(), {4, false, false, true, true}, set, shareOf(100));
    }
  }
}

TEST(BatchOverGround, ManyTicksAtOnceAreTheSameAsOneByOne) {
  const CushionKind kind = {4, false, true, true, true};
  for (const InstructionSet set : availableInstructionSets()) {
    RandomCraft random(Integrator::kHeun, BodyModel::kSpatial, 20);
    Beside both(scenariosOf(random, kind), set, 2);
    for (Tick first = 0; first < 350; first += 70) {
      for (Tick tick = first; tick < first + 70; ++tick) pushSome(both, random, kind, tick);
      ASSERT_EQ(both.differingAfter(70), 0U) << instructionSetName(set) << ", from tick " << first;
    }
  }
}

TEST(BatchOverGround, ShippedCraftOnCushionsFlyInABatch) {
  for (const char* file : {"rc5", "ubc_plenum", "epfl", "lift_fan"}) {
    Scenario scenario = loadScenario(std::string("config/") + file + ".yaml");
    if (scenario.world) {  // a floor, which a batch has as a plane
      scenario.world.reset();
      scenario.ground.emplace().surface = PlaneScenario{0.0, Vector3::UnitZ()};
    }
    Beside both({scenario, scenario}, availableInstructionSets().back());
    Command command = {10, 0, kAllEngines, Vector3(0.0, 1.0, 0.7)};
    for (const ActuatorScenario& actuator : scenario.vehicles[0].actuators) {
      command.engines |= maskOf(command.thrusts.size());
      command.thrusts.append(0.5 * actuator.motion.max_thrust);
    }
    both.push(1, command);
    for (Tick tick = 0; tick < 500; tick += 50) ASSERT_EQ(both.differingAfter(50), 0U) << file;
    EXPECT_EQ(both.lostCount(), 0);
  }
}

/// Of a second run that differs from the first.
template <class Change>
std::string refusalOfSecond(Change change) {
  RandomCraft random(Integrator::kHeun, BodyModel::kSpatial, 21);
  const std::vector<Scenario> first = scenariosOf(random, {4, true, true, true}, 1);
  Scenario second = first.front();
  change(second, second.vehicles.front());
  try {
    const Batch batch({first.front(), second});
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(BatchOverGround, RefusesByNameInWhatARunMustNotDiffer) {
  const std::string rule = ": must be that of the first run of the batch";
  const std::string cells = "run 1: the cells of the cushion: their hems and fans" + rule;
  EXPECT_EQ(refusalOfSecond([](Scenario&, VehicleScenario& v) { v.cushion.reset(); }), cells);
  EXPECT_EQ(refusalOfSecond([](Scenario&, VehicleScenario& v) { v.cushion->cells.pop_back(); }),
            cells);
  EXPECT_EQ(refusalOfSecond([](Scenario&, VehicleScenario& v) { v.cushion->cells[1].fan = 1; }),
            cells);
  EXPECT_EQ(
      refusalOfSecond([](Scenario&, VehicleScenario& v) { v.cushion->fans[0].lift_fan = ""; }),
      "run 1: which actuators turn fans of the cushion" + rule);
  EXPECT_EQ(
      refusalOfSecond([](Scenario&, VehicleScenario& v) { v.mass_properties.p_HB.y() = 0.01; }),
      "run 1: what of the cushion is symmetric about the centre of mass" + rule);
  EXPECT_EQ(refusalOfSecond([](Scenario&, VehicleScenario& v) { v.hull.reset(); }),
            "run 1: the vertices of the hull on the ground: their number, and how many are "
            "symmetric" +
                rule);
  EXPECT_EQ(refusalOfSecond([](Scenario& s, VehicleScenario& v) {
              s.ground->surface = PlaneScenario{1.0, Vector3::UnitZ()};
              v.cushion->skirt.stiffness = 0.0;
              v.cushion->fans[1].speeds = {{0.0, 1.0}, {1.0, 0.5}};
            }),
            "");
}

}  // namespace
}  // namespace hovercraft
