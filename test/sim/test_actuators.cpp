#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/records/commands_csv.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/files.h"
#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::complaintAbout;
using testing::messageOf;
using testing::parsed;
using testing::TestFolder;
using testing::with;

constexpr const char* kPlate =
    "step_size: 0.01\nmodel: planar\nvehicles:\n  craft:\n    mass: 2\n    inertia: {ixx: 0.5, "
    "iyy: 0.5, izz: 0.5}\n";

/// Four kinds; by name: bow (fan), lift, rudder, screw.
std::string fourKinds() {
  return std::string(kPlate) +
         "    actuators:\n"
         "      bow: {kind: fan, position: [0.4, 0, 0], direction: [0, 1, 0], min_thrust: -3, "
         "max_thrust: 3, time_constant: 0.2, free_speed: 12}\n"
         "      lift: {kind: lift_fan, time_constant: 0.4}\n"
         "      rudder: {kind: rudder, position: [-0.6, 0, 0.1], fan: screw, area: 0.02, "
         "lift_slope: 3, drag_at_rest: 0.01, drag_growth: 1.4, time_constant: 0.05}\n"
         "      screw: {kind: propeller, position: [-0.5, 0, 0.1], direction: [1, 0, 0], "
         "min_speed: 0, max_speed: 120, time_constant: 0.3, diameter: 0.3, thrust_coefficients: "
         "[0.11, -0.06, -0.05], torque_coefficients: [0.006, 0.001, -0.004], rotation: left}\n";
}

constexpr std::size_t kBow = 3;
constexpr std::size_t kLift = 4;
constexpr std::size_t kRudder = 5;
constexpr std::size_t kScrew = 6;

Command commandFor(std::size_t id, double value, Tick tick = 0) {
  Command command{tick, 0, maskOf(id), {}};
  command.thrusts.resize(id + 1);
  command.thrusts[id] = value;
  return command;
}

void advance(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

// ---- scenario -----------------------------------------------------------------------------------

TEST(Actuators, WhatIsWrittenIsTheSameScenario) {
  const Scenario scenario = parsed(fourKinds());
  ASSERT_EQ(scenario.vehicles[0].actuators.size(), 4U);
  const std::string text = toYaml(scenario);
  EXPECT_EQ(toYaml(parsed(text)), text);
  EXPECT_EQ(text.find("engines:"), std::string::npos);
  const ActuatorScenario& rudder = scenario.vehicles[0].actuators[2];
  EXPECT_EQ(rudder.diameter, 0.3);  // of its propeller
  EXPECT_EQ(rudder.motion.max_thrust, 0.5);
  EXPECT_EQ(rudder.motion.timeout_ns, 0);
  EXPECT_EQ(scenario.vehicles[0].actuators[0].motion.timeout_ns, 500000000);
  EXPECT_EQ(scenario.vehicles[0].actuators[1].motion.timeout_ns, 0);
}

std::string complaintWith(const std::string& old_part, const std::string& new_part) {
  return complaintAbout(with(fourKinds(), old_part, new_part));
}

TEST(Actuators, AreRefusedByKeyAndRule) {
  const std::string place = "test.yaml: vehicles.craft.actuators.";
  EXPECT_EQ(complaintWith("kind: lift_fan, ", ""), place + "lift.kind: the key is missing");
  EXPECT_EQ(complaintWith("kind: lift_fan", "kind: wing"),
            place + "lift.kind = wing: must be one of: fan, propeller, lift_fan, rudder");
  EXPECT_EQ(complaintWith("kind: lift_fan", "kind: lift_fan, initial: 1.5"),
            place + "lift.initial = 1.5: must be within the limits of the actuator");
  EXPECT_EQ(complaintWith("fan: screw", "fan: lift"),
            place + "rudder.fan = lift: must name a fan or a propeller of the actuators");
  EXPECT_EQ(complaintWith("fan: screw", "fan: bow"),
            place + "rudder.disc_diameter: the key is missing: that of the fan");
  EXPECT_EQ(complaintWith("fan: screw", "disc_diameter: 1"),
            place + "rudder.disc_diameter = 1: needs a fan");
  EXPECT_EQ(complaintWith("area: 0.02", "area: 0.02, max_angle: 0.6"),
            place + "rudder.max_angle = 0.6: must be at most 0.5 rad");
  EXPECT_EQ(complaintWith("area: 0.02", "area: 0.02, hinge: [1, 0, 0]"),
            place + "rudder.hinge = [1, 0, 0]: must be perpendicular to direction");
  const std::string as_engine = complaintWith("      bow:", "      rear:");
  EXPECT_EQ(as_engine.rfind(place + "rear = ", 0), 0U) << as_engine;
  EXPECT_NE(as_engine.find(": must not be called as an engine"), std::string::npos) << as_engine;
  EXPECT_EQ(complaintWith("direction: [0, 1, 0]", "direction: [0, 2, 0]"),
            place + "bow.direction = [0, 2, 0]: must have length 1 (it has 2)");
  EXPECT_EQ(complaintWith("free_speed: 12", "free_speed: -1"),
            place + "bow.free_speed = -1: must be 0 or greater");
  EXPECT_NE(complaintWith("max_speed: 120", "max_thrust: 120").find("unknown key"),
            std::string::npos);
}

TEST(Actuators, AreAtMostEight) {
  std::string text = std::string(kPlate) + "    actuators:\n";
  for (int i = 0; i < 8; ++i) text += "      a" + std::to_string(i) + ": {kind: lift_fan}\n";
  EXPECT_EQ(complaintAbout(text), "nothing was thrown");
  const std::string nine = complaintAbout(text + "      a8: {kind: lift_fan}\n");
  EXPECT_EQ(nine.rfind("test.yaml: vehicles.craft.actuators = ", 0), 0U) << nine;
  EXPECT_NE(nine.find(": must be at most 8"), std::string::npos) << nine;
}

// ---- engines that are left out ------------------------------------------------------------------

std::uint64_t hashOfRun(const std::string& text) {
  Simulation simulation(parsed(text));
  simulation.push({0, 0, kAllEngines, {2.0, 1.0, -1.0}});
  advance(simulation, 200);
  return simulation.hash();
}

TEST(Engines, OneThatIsLeftOutIsAsOneWithoutThrust) {
  const std::string rear =
      "      rear: {position: [-1, 0.1, 0], direction: [1, 0, 0], min_thrust: -10, max_thrust: "
      "10}\n";
  const std::string left =
      "      left: {position: [1, 0, 0], direction: [0, -1, 0], min_thrust: 0, max_thrust: 0}\n";
  const std::string right =
      "      right: {position: [1, 0, 0], direction: [0, 1, 0], min_thrust: 0, max_thrust: 0}\n";
  const std::string engines = std::string(kPlate) + "    engines:\n" + rear;
  EXPECT_EQ(hashOfRun(engines), hashOfRun(engines + left + right));
  const Scenario scenario = parsed(engines);
  EXPECT_EQ(toYaml(scenario).find("left:"), std::string::npos);
  EXPECT_EQ(toYaml(parsed(toYaml(scenario))), toYaml(scenario));
}

TEST(Engines, ThatAreNoneAreWrittenAsSuch) {
  for (const char* none : {"    engines: {}\n", "    actuators: {}\n"}) {
    const std::string text = toYaml(parsed(std::string(kPlate) + none));
    EXPECT_EQ(toYaml(parsed(text)), text);
  }
}

TEST(Engines, NoneAtAllNeedsOtherActuators) {
  EXPECT_EQ(complaintAbout(kPlate), "test.yaml: vehicles.craft.engines: the key is missing");
}

// ---- levels -------------------------------------------------------------------------------------

// s' = (u - s)/tau from 1: s = u + (1 - u) exp(-t/tau); tau = 0.4 s, 100 steps of 10 ms.
TEST(LiftFan, RunsFromTheStartAndFollowsWithTheExactLagOfSpeed) {
  Simulation simulation(parsed(fourKinds()));
  EXPECT_EQ(simulation.engineReport(0, kLift).applied, 1.0);
  advance(simulation, 100);
  EXPECT_EQ(simulation.engineReport(0, kLift).applied, 1.0);
  simulation.push(commandFor(kLift, 0.3, simulation.tick()));
  advance(simulation, 100);
  EXPECT_NEAR(simulation.engineReport(0, kLift).applied, 0.3 + 0.7 * std::exp(-1.0 / 0.4), 1e-13);
}

TEST(LiftFan, ALostCommandDoesNotStopIt) {
  Simulation simulation(parsed(fourKinds()));
  simulation.push(commandFor(kLift, 0.8));
  simulation.push(commandFor(kBow, 1.0));
  advance(simulation, 1000);
  EXPECT_NEAR(simulation.engineReport(0, kLift).applied, 0.8, 1e-10);
  EXPECT_FALSE(simulation.engineReport(0, kLift).timed_out);
  EXPECT_TRUE(simulation.engineReport(0, kBow).timed_out);
  EXPECT_NEAR(simulation.engineReport(0, kLift).command_age, 10.0, 1e-12);
}

TEST(LiftFan, IsHeldBetweenStandstillAndItsNominalSpeed) {
  Simulation simulation(parsed(fourKinds()));
  simulation.push(commandFor(kLift, 1.7));
  advance(simulation, 1);
  EXPECT_TRUE(simulation.engineReport(0, kLift).saturated);
  EXPECT_EQ(simulation.engineReport(0, kLift).commanded, 1.7);
  EXPECT_EQ(simulation.engineReport(0, kLift).applied, 1.0);
}

// On the spot after many lags: 2 kg under rho n^2 D^4 k0 on its way through a first short step.
TEST(Propeller, DrivesTheCraftByItsStaticThrust) {
  const std::string text = with(fourKinds(), "time_constant: 0.3, ", "");
  Simulation simulation(parsed(text));
  simulation.push(commandFor(kScrew, 100.0));
  simulation.step();
  const double thrust = 1.225 * 1e4 * std::pow(0.3, 4) * 0.11;
  const double stream = std::sqrt(thrust / (1.225 * std::acos(-1.0) * 0.0225));
  const double drag = 0.5 * 1.225 * stream * stream * 0.02 * 0.01;  // of the rudder amidships
  EXPECT_NEAR(simulation.motion(0).momentum_W.x(), 0.01 * (thrust - drag), 2e-4);
}

TEST(Rudder, TurnsTheCraftOnlyInTheStreamOfItsPropeller) {
  Simulation simulation(parsed(fourKinds()));
  simulation.push(commandFor(kRudder, 0.3));
  advance(simulation, 50);
  EXPECT_EQ(simulation.motion(0).twist.w_WB.z(), 0.0);
  simulation.push(commandFor(kScrew, 100.0, simulation.tick()));
  simulation.push(commandFor(kRudder, 0.3, simulation.tick()));
  advance(simulation, 40);
  EXPECT_LT(simulation.motion(0).twist.w_WB.z(), -0.01);  // a positive angle: to the right
}

// ---- state --------------------------------------------------------------------------------------

Simulation underWay() {
  Simulation simulation(parsed(fourKinds()));
  simulation.push(commandFor(kScrew, 80.0));
  simulation.push(commandFor(kBow, -1.0));
  simulation.push(commandFor(kRudder, 0.2));
  simulation.push(commandFor(kLift, 0.6));
  advance(simulation, 37);
  return simulation;
}

TEST(Actuators, GoThroughASnapshotToTheLastBit) {
  Simulation whole = underWay();
  whole.push(commandFor(kBow, 2.5, 37));
  const std::string text = toSnapshot(whole);
  Simulation resumed(whole.scenario());
  resumed.restore(parseSnapshot(text, "snap.yaml", whole.scenario()));
  EXPECT_EQ(resumed.hash(), whole.hash());
  advance(whole, 100);
  advance(resumed, 100);
  EXPECT_EQ(resumed.hash(), whole.hash());
  EXPECT_EQ(resumed.engineReport(0, kBow).commanded, 2.5);
}

TEST(Actuators, EachOfTheirFieldsIsInTheHash) {
  const Simulation simulation = underWay();
  for (std::size_t id = kBow; id <= kScrew; ++id) {
    const auto hash_with = [&](auto change) {
      SimulationState state = simulation.state();
      change(state.engines[0][id]);
      Simulation changed(simulation.scenario());
      changed.restore(state);
      return changed.hash();
    };
    EXPECT_NE(hash_with([](EngineState& s) { s.thrust = std::nextafter(s.thrust, 1e9); }),
              simulation.hash());
    EXPECT_NE(hash_with([](EngineState& s) { s.commanded = std::nextafter(s.commanded, 1e9); }),
              simulation.hash());
    EXPECT_NE(hash_with([](EngineState& s) { ++s.command_tick; }), simulation.hash());
  }
}

TEST(Actuators, AResetBringsTheirStartBack) {
  Simulation simulation = underWay();
  const std::uint64_t fresh = Simulation(simulation.scenario()).hash();
  simulation.reset(1);
  EXPECT_EQ(simulation.hash(), fresh);
  EXPECT_EQ(simulation.engineReport(0, kLift).applied, 1.0);
}

TEST(Actuators, ACommandBeyondThoseOfTheCraftIsOurOwnMistake) {
  Simulation simulation(parsed(fourKinds()));
  EXPECT_THROW(simulation.push(commandFor(7, 1.0)), std::logic_error);
}

// ---- commands CSV -------------------------------------------------------------------------------

TEST(ActuatorColumns, AreThoseOfTheActuatorsNames) {
  const TestFolder folder;
  folder.write("c.csv", "time,screw,rudder,rear\n0,50,,\n0.02,,0.1,0\n");
  CsvCommandSource source(folder.file("c.csv"), parsed(fourKinds()));
  const auto first = source.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->engines, maskOf(kScrew));
  EXPECT_EQ(first->thrusts[kScrew], 50.0);
  const auto second = source.next();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->tick, 2);
  EXPECT_EQ(second->engines, maskOf(kRudder) | maskOf(ActuatorId::kRear));
  EXPECT_EQ(second->thrusts[kRudder], 0.1);
  EXPECT_FALSE(source.next());
}

TEST(ActuatorColumns, ThatNoCraftHasAreRefused) {
  const TestFolder folder;
  const auto complaint = [&folder](const std::string& text) {
    folder.write("c.csv", text);
    return messageOf([&folder] {
      CsvCommandSource source(folder.file("c.csv"), parsed(fourKinds()));
      while (source.next()) continue;
    });
  };
  EXPECT_EQ(complaint("time,screw\n0,1\n"), "nothing was thrown");
  EXPECT_EQ(complaint("time,sail\n0,1\n"),
            folder.file("c.csv") +
                ":1: the header: sail must be an engine or an actuator, and stand once");
  EXPECT_NE(complaint("time,screw,screw\n0,1,1\n").find("stand once"), std::string::npos);
  EXPECT_NE(complaint("screw,time\n0,1\n").find("the header must be"), std::string::npos);
}

}  // namespace
}  // namespace hovercraft
