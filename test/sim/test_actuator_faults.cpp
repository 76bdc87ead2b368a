#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/snapshot.h"

#include "../support/files.h"
#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::messageOf;
using testing::parsed;
using testing::with;

constexpr std::size_t kFaultyFan = 3;
constexpr std::size_t kFaultyTail = 4;

Scenario faultyCraft() {
  return parsed(
      "step_size: 0.01\nmodel: planar\nvehicles:\n  craft:\n    mass: 2\n    inertia: {ixx: 0.5, "
      "iyy: 0.5, izz: 0.5}\n    engines:\n      left: {position: [0, 0.2, 0], direction: [1, 0, "
      "0], "
      "min_thrust: -2, max_thrust: 4}\n    actuators:\n      fan: {kind: fan, position: [-0.4, 0, "
      "0], direction: [1, 0, 0], min_thrust: -3, max_thrust: 3, time_constant: 0.2}\n      tail: "
      "{kind: rudder, position: [-0.6, 0, 0], fan: fan, disc_diameter: 0.3, area: 0.02, "
      "lift_slope: 3}\n");
}

void commandFaulty(Simulation& simulation, std::size_t id, double value) {
  Command command{simulation.tick(), 0, maskOf(id), {}};
  if (id >= kFirstActuator) command.thrusts.resize(id + 1);
  command.thrusts[id] = value;
  simulation.push(command);
}

void runFaulty(Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

double levelNow(const Simulation& simulation, std::size_t id) {
  return simulation.engineReport(0, static_cast<int>(id)).applied;
}

TEST(ActuatorFaults, AnEfficiencyIsTheShareOfTheLimitedDemandThatIsLeft) {
  Simulation simulation(faultyCraft());
  simulation.setActuator(0, 1, 0.25, false);
  simulation.setActuator(0, kFaultyFan, 0.5, false);
  commandFaulty(simulation, 1, 10.0);
  commandFaulty(simulation, kFaultyFan, 2.0);
  runFaulty(simulation, 20);
  EXPECT_EQ(levelNow(simulation, 1), 1.0);  // of 4 N, its limit
  EXPECT_NEAR(levelNow(simulation, kFaultyFan), 0.5 * 2.0 * (1.0 - std::exp(-1.0)), 1e-14);
  EXPECT_EQ(simulation.engineReport(0, kFaultyFan).efficiency, 0.5);
  EXPECT_FALSE(simulation.engineReport(0, kFaultyFan).stuck);
  EXPECT_EQ(simulation.engineReport(0, kFaultyTail).efficiency, 1.0);
  simulation.setActuator(0, 1, 0.0, false);
  runFaulty(simulation, 1);
  EXPECT_EQ(levelNow(simulation, 1), 0.0);
  simulation.setActuator(0, 1, 1.0, false);
  runFaulty(simulation, 1);
  EXPECT_EQ(levelNow(simulation, 1), 4.0);
}

TEST(ActuatorFaults, OneThatIsStuckStaysWhateverIsCommandedOrTimesOut) {
  Simulation simulation(faultyCraft());
  commandFaulty(simulation, kFaultyFan, 3.0);
  commandFaulty(simulation, kFaultyTail, 0.3);
  runFaulty(simulation, 7);
  const double fan = levelNow(simulation, kFaultyFan);
  EXPECT_GT(fan, 0.5);
  simulation.setActuator(0, kFaultyFan, 0.5, true);
  simulation.setActuator(0, kFaultyTail, 1.0, true);
  commandFaulty(simulation, kFaultyFan, -3.0);
  commandFaulty(simulation, kFaultyTail, -0.3);
  runFaulty(simulation, 100);
  EXPECT_TRUE(simulation.engineReport(0, kFaultyFan).timed_out);
  EXPECT_EQ(levelNow(simulation, kFaultyFan), fan);
  EXPECT_EQ(levelNow(simulation, kFaultyTail), 0.3);
  simulation.setActuator(0, kFaultyTail, 1.0, false);
  runFaulty(simulation, 1);
  EXPECT_EQ(levelNow(simulation, kFaultyTail), -0.3);
}

TEST(ActuatorFaults, AreInTheHashWhereTheyAreAndOnlyThere) {
  Simulation simulation(faultyCraft());
  const std::uint64_t sound = simulation.hash();
  const std::uint64_t of_craft = simulation.hash(0);
  simulation.setActuator(0, kFaultyFan, 0.5, false);
  const std::uint64_t half = simulation.hash();
  EXPECT_NE(half, sound);
  EXPECT_NE(simulation.hash(0), of_craft);
  simulation.setActuator(0, kFaultyFan, 0.5, true);
  EXPECT_NE(simulation.hash(), half);
  simulation.setActuator(0, kFaultyFan, 1.0, false);
  simulation.setActuator(0, kFaultyTail, 0.5, false);
  EXPECT_NE(simulation.hash(), half);
  simulation.setActuator(0, kFaultyTail, 1.0, false);
  EXPECT_EQ(simulation.hash(), sound);
  simulation.setActuator(0, kFaultyTail, 0.5, true);
  simulation.reset(1);
  EXPECT_EQ(simulation.hash(), sound);
}

TEST(ActuatorFaults, GoThroughASnapshotToTheLastBit) {
  Simulation whole(faultyCraft());
  EXPECT_EQ(toSnapshot(whole).find("efficiency"), std::string::npos);
  commandFaulty(whole, 1, 3.0);
  commandFaulty(whole, kFaultyFan, 3.0);
  runFaulty(whole, 5);
  whole.setActuator(0, 1, 0.3, false);
  whole.setActuator(0, kFaultyFan, 1.0, true);
  const std::string text = toSnapshot(whole);
  Simulation resumed(whole.scenario());
  resumed.restore(parseSnapshot(text, "snap.yaml", whole.scenario()));
  for (Simulation* simulation : {&whole, &resumed}) {
    commandFaulty(*simulation, 1, 2.0);
    commandFaulty(*simulation, kFaultyFan, -1.0);
    runFaulty(*simulation, 30);
  }
  EXPECT_EQ(resumed.hash(), whole.hash());
  EXPECT_EQ(levelNow(resumed, 1), 0.3 * 2.0);
  for (const char* bad : {"1.5", "-0.1", ".nan"}) {
    const std::string message = messageOf([&] {
      parseSnapshot(with(text, "efficiency: 0.3", std::string("efficiency: ") + bad), "snap.yaml",
                    whole.scenario());
    });
    EXPECT_NE(message.find("left.efficiency"), std::string::npos) << message;
  }
  const std::string message = messageOf([&] {
    parseSnapshot(with(text, "efficiency: 0.3", "efficiency: 0.4"), "snap.yaml", whole.scenario());
  });
  EXPECT_NE(message.find("hash"), std::string::npos) << message;
}

TEST(ActuatorFaults, OfNoActuatorAreOurOwnMistake) {
  Simulation simulation(faultyCraft());
  EXPECT_THROW(simulation.setActuator(0, 5, 1.0, false), std::logic_error);
  EXPECT_THROW(simulation.setActuator(1, 0, 1.0, false), std::logic_error);
  EXPECT_THROW(simulation.setActuator(0, 0, 1.5, false), std::logic_error);
  EXPECT_THROW(simulation.setActuator(0, 0, std::nan(""), false), std::logic_error);
}

}  // namespace
}  // namespace hovercraft
