#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::parsed;
using testing::validScenario;
using testing::with;

/// The shipped craft with commands that change all the time: every term of the equations acts.
void drive(Simulation& simulation, Tick ticks) {
  const Tick end = simulation.tick() + ticks;
  while (simulation.tick() < end) {
    const Tick tick = simulation.tick();
    if (tick % 50 == 0) {
      const auto phase = static_cast<double>(tick / 50 % 5);
      for (std::size_t vehicle = 0; vehicle < simulation.scenario().vehicles.size(); ++vehicle) {
        simulation.push({tick, vehicle, kAllEngines, {phase, 0.5 * phase, 1.0 - 0.2 * phase}});
      }
    }
    simulation.step();
  }
}

std::uint64_t hashAfter(const Scenario& scenario, Tick ticks) {
  Simulation simulation(scenario);
  drive(simulation, ticks);
  return simulation.hash();
}

/// `vehicles` craft like that of validScenario(), named by `names`, each with a mass of its own.
std::string fleet(const std::vector<std::string>& names) {
  const std::string& text = validScenario();
  std::string result = text.substr(0, text.find("  alpha:"));
  for (const std::string& name : names) {
    const std::string mass = "mass: " + std::to_string(3 + name.size());
    result += "  " + name + ":\n" + with(text.substr(text.find("    mass:")), "mass: 5.5", mass);
  }
  return result;
}

std::size_t indexOf(const Scenario& scenario, const std::string& name) {
  for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
    if (scenario.vehicles[i].name == name) return i;
  }
  throw std::logic_error("no vehicle " + name);
}

// ---- commands -----------------------------------------------------------------------------------

// A craft of 2 kg without drag under Euler: a command of tick 3 changes the momentum of tick 4, by
// F h = 4.5 N · 0.002 s, and nothing before.
TEST(Simulation, CommandsTakeEffectAtTheirTick) {
  Scenario scenario = parsed(validScenario());
  scenario.integrator = Integrator::kEuler;
  scenario.gravity = scenario.wind = Vector3::Zero();
  VehicleScenario& vehicle = scenario.vehicles[0];
  vehicle.drag = Drag();
  vehicle.engines[0].time_constant = 0.0;
  vehicle.initial_rpy = vehicle.initial_v_WB = vehicle.initial_w_WB = Vector3::Zero();
  Simulation simulation(scenario);
  std::vector<Tick> applied;
  RunCallbacks told;
  simulation.observe(&told);
  told.on_applied = [&](const Command& command) {
    EXPECT_EQ(command.thrusts[0], 4.5);
    applied.push_back(simulation.tick());
  };
  simulation.push({3, 0, kAllEngines, {4.5, 0.0, 0.0}});
  for (Tick tick = 0; tick <= 3; ++tick) {
    EXPECT_EQ(simulation.tick(), tick);
    EXPECT_EQ(simulation.timeNs(), tick * 2000000);
    EXPECT_EQ(simulation.motion(0).momentum_W.x(), 0.0) << "tick " << tick;
    EXPECT_EQ(simulation.engineReport(0, 0).commanded, 0.0) << "tick " << tick;
    EXPECT_TRUE(applied.empty()) << "tick " << tick;
    simulation.step();
  }
  EXPECT_EQ(applied, std::vector<Tick>{3});
  EXPECT_EQ(simulation.motion(0).momentum_W.x(), 4.5 * 0.002);
  EXPECT_EQ(simulation.state().engines[0][0].command_tick, 3);
}

TEST(Simulation, OfTwoCommandsOfOneTickTheLaterHolds) {
  Simulation simulation(parsed(validScenario()));
  simulation.push({0, 0, kAllEngines, {1.0, 1.0, 1.0}});
  simulation.push({0, 0, kAllEngines, {2.0, 0.5, 0.25}});
  simulation.step();
  EXPECT_EQ(simulation.engineReport(0, 0).commanded, 2.0);
  EXPECT_EQ(simulation.engineReport(0, 2).commanded, 0.25);
}

TEST(Simulation, ACommandForOneEngineLeavesTheOthersAlone) {
  Simulation simulation(parsed(validScenario()));
  simulation.push({0, 0, kAllEngines, {1.0, 1.1, 1.2}});
  simulation.push({1, 0, maskOf(EngineId::kLeft), {9.0, 0.5, 9.0}});
  simulation.step();
  simulation.step();
  EXPECT_EQ(simulation.engineReport(0, 0).commanded, 1.0);
  EXPECT_EQ(simulation.engineReport(0, 1).commanded, 0.5);
  EXPECT_EQ(simulation.engineReport(0, 2).commanded, 1.2);
  EXPECT_EQ(simulation.state().engines[0][0].command_tick, 0);
  EXPECT_EQ(simulation.state().engines[0][1].command_tick, 1);
}

TEST(Simulation, BadCommandsAreOurOwnMistake) {
  Simulation simulation(parsed(validScenario()));
  simulation.step();
  simulation.step();
  const Vector3 none = Vector3::Zero();
  EXPECT_THROW(simulation.push({1, 0, kAllEngines, none}), std::logic_error);
  EXPECT_THROW(simulation.push({2, 1, kAllEngines, none}), std::logic_error);
  EXPECT_THROW(simulation.push({2, 0, kAllEngines, {0.0, std::nan(""), 0.0}}), std::logic_error);
  EXPECT_NO_THROW(simulation.push({2, 0, kAllEngines, none}));
}

// Rear: 9 N are asked of at most 4.5; lag 0.1 s, so 4.5 (1 - e^(-t/0.1)) after t = 2 ms; time-out
// 0.75 s = 375 ticks of 2 ms.
TEST(Simulation, ReportsItsEngines) {
  Simulation simulation(parsed(validScenario()));
  EXPECT_EQ(simulation.engineReport(0, 0).command_age, -1.0);
  simulation.push({0, 0, kAllEngines, {9.0, 1.0, 1.0}});
  simulation.step();
  const EngineReport first = simulation.engineReport(0, 0);
  EXPECT_EQ(first.commanded, 9.0);
  EXPECT_NEAR(first.applied, 4.5 * (1.0 - std::exp(-0.02)), 1e-15);
  EXPECT_TRUE(first.saturated);
  EXPECT_FALSE(first.timed_out);
  EXPECT_EQ(first.command_age, 0.002);
  EXPECT_FALSE(simulation.engineReport(0, 1).saturated);
  while (simulation.tick() < 374) simulation.step();
  EXPECT_FALSE(simulation.engineReport(0, 0).timed_out);
  simulation.step();
  const EngineReport last = simulation.engineReport(0, 0);
  EXPECT_TRUE(last.timed_out);
  EXPECT_EQ(last.command_age, 0.75);
  const double full = last.applied;
  simulation.step();
  EXPECT_LT(simulation.engineReport(0, 0).applied, full);
}

// ---- the same bits ------------------------------------------------------------------------------

TEST(Simulation, SameScenarioAndCommandsGiveTheSameBits) {
  const Scenario scenario = parsed(validScenario());
  Simulation first(scenario);
  Simulation second(scenario);
  for (int n = 0; n < 500; ++n) {
    drive(first, 1);
    drive(second, 1);
    ASSERT_EQ(first.hash(), second.hash()) << "tick " << n;
  }
}

TEST(Simulation, ACraftFliesAloneAsInCompany) {
  const Scenario company = parsed(fleet({"b", "aa", "ccc"}));
  for (const std::string name : {"b", "aa", "ccc"}) {
    Simulation together(company);
    Simulation alone(parsed(fleet({name})));
    drive(together, 500);
    drive(alone, 500);
    EXPECT_EQ(alone.hash(0), together.hash(indexOf(company, name))) << name;
  }
}

TEST(Simulation, TheOrderOfVehiclesInTheFileDoesNotMatter) {
  EXPECT_EQ(hashAfter(parsed(fleet({"b", "aa", "ccc"})), 300),
            hashAfter(parsed(fleet({"ccc", "b", "aa"})), 300));
}

TEST(Simulation, ACommandReachesItsVehicleOnly) {
  const Scenario scenario = parsed(fleet({"aa", "b"}));
  Simulation commanded(scenario);
  Simulation still(scenario);
  commanded.push({0, 1, kAllEngines, {3.0, 0.0, 0.0}});
  commanded.step();
  still.step();
  EXPECT_EQ(commanded.hash(0), still.hash(0));
  EXPECT_NE(commanded.hash(1), still.hash(1));
}

TEST(Simulation, HashOfARestingCraftChangesWithTheTick) {
  Scenario scenario = parsed(validScenario());
  scenario.gravity = scenario.wind = Vector3::Zero();
  scenario.vehicles[0].initial_v_WB = scenario.vehicles[0].initial_w_WB = Vector3::Zero();
  Simulation simulation(scenario);
  const std::uint64_t of_craft = simulation.hash(0);
  const std::uint64_t of_all = simulation.hash();
  simulation.step();
  EXPECT_NE(simulation.hash(0), of_craft);
  EXPECT_NE(simulation.hash(), of_all);
}

// ---- models -------------------------------------------------------------------------------------

/// A craft whose engines, drag and motion stay in the plane, with principal axes along those of B.
Scenario flatCraft() {
  Scenario scenario = parsed(validScenario());
  scenario.gravity = Vector3::Zero();
  scenario.wind.z() = 0.0;
  VehicleScenario& vehicle = scenario.vehicles[0];
  const Matrix3 inertia = Vector3(0.1, 0.2, 0.25).asDiagonal();
  vehicle.mass_properties.I_BBo_B = inertia;
  vehicle.mass_properties.p_HB = {0.01, 0.02, 0.05};
  for (EngineParameters& engine : vehicle.engines) engine.p_HE.z() = 0.05;
  vehicle.engines[2].direction = {0.0, 1.0, 0.0};
  vehicle.initial_rpy = {0.0, 0.0, 0.3};
  vehicle.initial_v_WB.z() = 0.0;
  vehicle.initial_w_WB = {0.0, 0.0, 0.6};
  return scenario;
}

// In the plane both models are the same equations; they differ by the rounding of 1/I_zz against
// the inverse of the whole tensor, in 2000 steps below 1e-12 of what the state holds.
TEST(Simulation, PlanarAndSpatialModelAgreeOnMotionInThePlane) {
  for (const auto orientation : {OrientationKind::kQuaternion, OrientationKind::kMatrix}) {
    Scenario scenario = flatCraft();
    scenario.orientation = orientation;
    scenario.model = BodyModel::kSpatial;
    Simulation spatial(scenario);
    scenario.model = BodyModel::kPlanar;
    Simulation planar(scenario);
    drive(spatial, 2000);
    drive(planar, 2000);
    const Motion a = spatial.motion(0);
    const Motion b = planar.motion(0);
    EXPECT_GT(norm(a.p_WB - scenario.vehicles[0].initial_p_WB), 1.0);
    EXPECT_LT(norm(a.p_WB - b.p_WB), 1e-12);
    EXPECT_LT(angleBetween(a.q_WB, b.q_WB), 1e-12);
    EXPECT_LT(norm(a.twist.v_WB - b.twist.v_WB), 1e-12);
    EXPECT_LT(norm(a.twist.w_WB - b.twist.w_WB), 1e-12);
  }
}

// The planar craft of validScenario() has products of inertia, engines off the plane and gravity:
// none of them takes it out of the plane, to the last bit.
TEST(Simulation, PlanarCraftStaysInItsPlane) {
  Scenario scenario = flatCraft();
  const VehicleScenario tilted = parsed(validScenario()).vehicles[0];
  scenario.vehicles[0].mass_properties = tilted.mass_properties;
  scenario.vehicles[0].engines = tilted.engines;
  scenario.gravity = {0.0, 0.0, -9.81};
  scenario.wind = {1.0, -2.0, 3.0};
  scenario.model = BodyModel::kPlanar;
  Simulation simulation(scenario);
  drive(simulation, 1000);
  const Motion motion = simulation.motion(0);
  EXPECT_EQ(motion.p_WB.z(), 3.0);
  EXPECT_EQ(motion.q_WB.v.x(), 0.0);
  EXPECT_EQ(motion.q_WB.v.y(), 0.0);
  EXPECT_EQ(motion.twist.v_WB.z(), 0.0);
  EXPECT_EQ(motion.twist.w_WB.x(), 0.0);
  EXPECT_EQ(motion.twist.w_WB.y(), 0.0);
}

// On a slope of angle a, with the plane of motion along it, gravity is (g sin a, 0, -g cos a): the
// first part drives the craft, the second is the cushion's. Heun is exact for a parabola.
TEST(Simulation, HorizontalGravityActsOnAPlanarCraftAsASlope) {
  Scenario scenario = flatCraft();
  scenario.vehicles[0].drag = Drag();
  scenario.model = BodyModel::kPlanar;
  scenario.integrator = Integrator::kHeun;
  const double slope = 0.1;  // rad
  scenario.gravity = {9.81 * std::sin(slope), -0.3, -9.81 * std::cos(slope)};
  Simulation simulation(scenario);
  const Motion start = simulation.motion(0);
  while (simulation.timeNs() < kNanosecondsPerSecond) simulation.step();
  const Motion end = simulation.motion(0);
  const Vector3 along(9.81 * std::sin(slope), -0.3, 0.0);
  EXPECT_LT(norm(end.twist.v_WB - (start.twist.v_WB + along)), 1e-12);
  EXPECT_LT(norm(end.p_WB - (start.p_WB + start.twist.v_WB + 0.5 * along)), 1e-12);
  EXPECT_LT(norm(end.twist.w_WB - start.twist.w_WB), 1e-14);  // it acts at the centre of mass
}

// Free fall: kinetic and potential energy, ½ m v² + m g z, and RK4 is exact for a parabola.
TEST(Simulation, EnergyOfAFreeFallIsConstant) {
  Scenario scenario = parsed(validScenario());
  scenario.vehicles[0].drag = Drag();
  scenario.vehicles[0].initial_w_WB = Vector3::Zero();
  Simulation simulation(scenario);
  // ½ 5.5 kg (16 + 25 + 36) m²/s² + 5.5 kg · 9.81 m/s² · 3 m
  const double energy = 0.5 * 5.5 * 77.0 + 5.5 * 9.81 * 3.0;
  EXPECT_NEAR(simulation.motion(0).energy, energy, 1e-12);
  while (simulation.tick() < 500) simulation.step();
  EXPECT_NEAR(simulation.motion(0).energy, energy, 1e-10);
  // z = 3 + 6 t - ½ g t², t = 1 s
  EXPECT_NEAR(simulation.motion(0).p_WB.z(), 3.0 + 6.0 - 0.5 * 9.81, 1e-12);
}

TEST(Simulation, MotionAtTickZeroIsTheScenarios) {
  for (const char* orientation : {"orientation: matrix", "orientation: quaternion"}) {
    const Simulation simulation(parsed(with(validScenario(), "orientation: matrix", orientation)));
    const Motion motion = simulation.motion(0);
    EXPECT_EQ(motion.p_WB, Vector3(1.0, 2.0, 3.0));
    EXPECT_LT(norm(rpyFromQuaternion(motion.q_WB) - Vector3(0.1, 0.2, 0.3)), 1e-15);
    EXPECT_LT(norm(motion.twist.v_WB - Vector3(4.0, 5.0, 6.0)), 1e-14);
    EXPECT_LT(norm(motion.twist.w_WB - Vector3(0.4, 0.5, 0.6)), 1e-14);
  }
}

// ---- a step that is too long --------------------------------------------------------------------

// drag · h / m = 50000 N s/m · 0.002 s / 5.5 kg = 18: explicit Euler multiplies the velocity by
// 1 - 18 in each step, the others by more.
TEST(Simulation, AStepTooLongForTheForcesThrows) {
  for (const auto orientation : {OrientationKind::kQuaternion, OrientationKind::kMatrix}) {
    for (const auto integrator : {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                  Integrator::kHeun, Integrator::kRungeKutta4, Integrator::kLie4}) {
      Scenario scenario = parsed(validScenario());
      scenario.integrator = integrator;
      scenario.orientation = orientation;
      scenario.vehicles[0].drag.linear = Vector3::Constant(50000.0);
      Simulation simulation(scenario);
      EXPECT_THROW(
          {
            for (int n = 0; n < 10000; ++n) simulation.step();
          },
          std::runtime_error);
    }
  }
}

/// What a run says that cannot go on for 1000 steps.
std::string endOf(const Scenario& scenario) {
  Simulation simulation(scenario);
  try {
    for (int n = 0; n < 1000; ++n) simulation.step();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "it goes on";
}

TEST(Simulation, WhatDivergesIsNamed) {
  Scenario scenario = parsed(validScenario());
  scenario.integrator = Integrator::kEuler;
  scenario.vehicles[0].drag = Drag();
  scenario.vehicles[0].initial_v_WB = Vector3::Constant(1e308);
  const std::string what = endOf(scenario);
  EXPECT_EQ(what.rfind("vehicles.alpha: the motion diverges", 0), 0U) << what;
}

// Contact asked for the closest features of what no longer had a place: an error of the program.
TEST(Simulation, WhatDivergesWhileBodiesMeetIsNamedToo) {
  Scenario scenario = loadScenario("config/crates.yaml");
  scenario.vehicles[0].initial_v_WB = Vector3(1e6, 0.0, 0.0);
  const std::string what = endOf(scenario);
  EXPECT_NE(what.find(": the motion diverges"), std::string::npos) << what;
}

/// Steps, which must fail, and says whether the state is that before.
bool keepsItsStateInAStepThatDiverges(Simulation& simulation) {
  const std::uint64_t before = simulation.hash();
  EXPECT_THROW(simulation.step(), std::runtime_error);
  return simulation.hash() == before;
}

// Two forces whose sum is beyond a double.
void pushBeyondAllBounds(Simulation& simulation, std::size_t vehicle) {
  const Wrench wrench = {Vector3::Constant(1.5e308), Vector3::Zero()};
  for (int i = 0; i < 2; ++i) {
    simulation.applyWrench({vehicle, ExternalWrench::Frame::kWorld, wrench, 1000});
  }
}

TEST(Simulation, AStepThatDivergesLeavesTheStateBeforeIt) {
  Scenario scenario = parsed(validScenario());
  scenario.vehicles.push_back(scenario.vehicles[0]);
  scenario.vehicles[1].name = "beta";
  for (const std::size_t vehicle : {0U, 1U}) {
    Simulation simulation(scenario);
    for (int n = 0; n < 10; ++n) simulation.step();
    pushBeyondAllBounds(simulation, vehicle);
    EXPECT_TRUE(keepsItsStateInAStepThatDiverges(simulation)) << vehicle;
  }
}

// The world has moved what touches by then, and the contacts with it.
TEST(Simulation, AStepOfAWorldThatDivergesLeavesTheStateBeforeIt) {
  Simulation simulation(loadScenario("config/tumble.yaml"));
  while (simulation.state().contacts.empty()) simulation.step();
  pushBeyondAllBounds(simulation, simulation.scenario().vehicles.size() - 1);
  EXPECT_TRUE(keepsItsStateInAStepThatDiverges(simulation));
}

// exp(-d t / m): linear drag alone would bring a momentum to the denormal numbers after 745 times
// m / d, and keep it there.
TEST(Simulation, WhatDragLeavesOfAMomentumEndsAsZero) {
  Scenario scenario = parsed(validScenario());
  scenario.gravity = scenario.wind = Vector3::Zero();
  scenario.vehicles[0].drag.linear = Vector3::Constant(1000.0);
  scenario.vehicles[0].drag.angular_linear = Vector3::Constant(20.0);
  Simulation simulation(scenario);
  for (int n = 0; n < 2000; ++n) simulation.step();
  EXPECT_EQ(simulation.motion(0).momentum_W, Vector3::Zero());
  EXPECT_EQ(simulation.motion(0).angular_momentum_W, Vector3::Zero());
}

// A turn by 1e157 in one step: the square of the quaternion is beyond a double, divided by its norm
// it would be 0, whose matrix is that of no rotation at all.
TEST(Simulation, AnOrientationThatOverflowedThrows) {
  for (const auto orientation : {OrientationKind::kQuaternion, OrientationKind::kMatrix}) {
    Scenario scenario = parsed(validScenario());
    scenario.integrator = Integrator::kEuler;
    scenario.orientation = orientation;
    scenario.vehicles[0].drag = Drag();
    scenario.vehicles[0].initial_w_WB = Vector3::Constant(1e160);
    Simulation simulation(scenario);
    EXPECT_ANY_THROW(simulation.step());
  }
}

}  // namespace
}  // namespace hovercraft
