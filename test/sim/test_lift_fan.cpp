#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/records/commands_csv.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/snapshot.h"

/// A lift fan of the actuators that feeds the cells of a cushion.

namespace hovercraft {
namespace {

constexpr std::size_t kLiftId = kFirstActuator;  // the only actuator besides the engines
constexpr double kLiftLag = 0.15;                // s, of config/lift_fan.yaml
constexpr double kWeightOfRc5 = 5.15 * 9.80665;  // N

/// rc5 over a plane with a lift fan as actuator in the place of a constant speed.
std::vector<std::string> liftFanSets(const std::string& actuator) {
  return {"vehicles.rc5.actuators={lift: {kind: lift_fan" + actuator + "}}",
          "vehicles.rc5.cushion.fans.lift={shutoff: 935.264, slope: 0, curve: 1737300, intake: [0, "
          "0, 0.05], lift_fan: lift}"};
}

Scenario overAPlane(const std::string& actuator, const std::vector<std::string>& more = {}) {
  std::vector<std::string> sets = liftFanSets(actuator);
  sets.insert(sets.end(), more.begin(), more.end());
  return loadScenario("config/rc5.yaml", {}, {"--set", sets});
}

Scenario sceneOfTheLiftFan(const std::vector<std::string>& sets = {}) {
  return loadScenario("config/lift_fan.yaml", {}, {"--set", sets});
}

/// The speed that the fan is told.
void turnAt(Simulation& simulation, double speed) {
  Command command{simulation.tick(), 0, maskOf(kLiftId), {}};
  command.thrusts.resize(kLiftId + 1);
  command.thrusts[kLiftId] = speed;
  simulation.push(command);
}

void runFor(Simulation& simulation, double seconds) {
  const std::int64_t end = simulation.timeNs() + std::llround(1e9 * seconds);
  while (simulation.timeNs() < end) simulation.step();
}

CushionReport cushionNow(const Simulation& simulation) {
  CushionReport report;
  simulation.cushionReport(0, report);
  return report;
}

double heightNow(const Simulation& simulation) {
  return simulation.motion(0).p_WB.z();
}

// A cell carries m g/4 at any speed s: p = m g/S. Its fan gives Q with p = s² a - c Q², which
// escapes by (4) through the leak A = Q/(C_d sqrt(2 p/rho)), that is by (3) A_l = A/sqrt(1 -
// (A/S)²), h = A_l/l, and by (1) g = h - d²/(4 h).
TEST(LiftFanOfACushion, PressureAndGapAreThoseOfItsSpeed) {
  for (const char* integrator : {"heun", "rk4"}) {
    Simulation simulation(overAPlane(
        ", time_constant: 0.1",
        {"vehicles.rc5.cushion.skirt.stiffness=0", "integrator=" + std::string(integrator)}));
    double last = 1.0;
    for (const double s : {1.0, 0.9, 0.8, 0.73}) {
      SCOPED_TRACE(s);
      turnAt(simulation, s);
      runFor(simulation, 8.0);
      const double p = kWeightOfRc5 / 0.108;
      const double Q = std::sqrt((s * s * 935.264 - p) / 1737300.0);
      const double A = Q / (0.6 * std::sqrt(2.0 * p / 1.225));
      const double h = A / std::sqrt(1.0 - (A / 0.027) * (A / 0.027)) / 0.33;
      const double gap = h - 1e-8 / (4.0 * h);
      const CushionReport report = cushionNow(simulation);
      EXPECT_NEAR(report.fan_speeds.at(0), s, 1e-12);
      for (const CellReport& cell : report.cells) {
        EXPECT_NEAR(cell.pressure, p, 1e-9 * p);
        EXPECT_NEAR(cell.flow, Q, 1e-9 * Q);
        EXPECT_NEAR(cell.gap, gap, 1e-9 * gap);
      }
      EXPECT_NEAR(heightNow(simulation), 0.05 + gap, 1e-11);
      EXPECT_LT(gap, last);
      last = gap;
    }
  }
}

// s' = (u - s)/tau: s = u + (s_0 - u) exp(-t/tau), as of any actuator.
TEST(LiftFanOfACushion, SpeedIsTheLevelOfTheActuatorWithItsLag) {
  Simulation simulation(sceneOfTheLiftFan());
  runFor(simulation, 0.5);
  EXPECT_EQ(cushionNow(simulation).fan_speeds.at(0), 1.0);
  turnAt(simulation, 0.2);
  for (int i = 1; i <= 400; ++i) {
    simulation.step();
    const double speed = cushionNow(simulation).fan_speeds.at(0);
    EXPECT_EQ(speed, simulation.engineReport(0, static_cast<int>(kLiftId)).applied);
    EXPECT_NEAR(speed, 0.2 + 0.8 * std::exp(-1e-3 * i / kLiftLag), 1e-12);
  }
}

TEST(LiftFanOfACushion, CraftSettlesOnItsHullWhenItIsStoppedByCommandAndLiftsOffAgain) {
  for (const char* integrator : {"heun", "rk4"}) {
    SCOPED_TRACE(integrator);
    Simulation simulation(sceneOfTheLiftFan({"integrator=" + std::string(integrator)}));
    runFor(simulation, 1.0);
    const double hovering = heightNow(simulation);
    EXPECT_NEAR(hovering, 0.053, 2e-5);
    turnAt(simulation, 0.0);
    runFor(simulation, 2.0);
    EXPECT_NEAR(heightNow(simulation), 0.042, 2e-6);  // on its hull, by contact
    // exp(-2/0.15) of the speed is left, and of the pressure its square.
    for (const CellReport& cell : cushionNow(simulation).cells) EXPECT_NEAR(cell.pressure, 0, 1e-6);
    EXPECT_NEAR(norm(simulation.motion(0).twist.v_WB), 0.0, 1e-4);
    turnAt(simulation, 1.0);
    runFor(simulation, 3.0);
    EXPECT_NEAR(heightNow(simulation), hovering, 1e-8);
  }
}

// Lift-off at s = sqrt(m g/(a S)) = 0.70711 (18). At 0.3 it carries 9 N, and the skirt 26 N: the
// hull the rest.
TEST(LiftFanOfACushion, TooSlowItDoesNotLiftTheCraftOff) {
  Simulation simulation(sceneOfTheLiftFan({"vehicles.rc5.actuators.lift.initial=0"}));
  runFor(simulation, 1.0);
  EXPECT_NEAR(heightNow(simulation), 0.042, 2e-6);
  turnAt(simulation, 0.3);
  runFor(simulation, 2.0);
  EXPECT_NEAR(heightNow(simulation), 0.042, 2e-6);
  turnAt(simulation, 0.75);
  runFor(simulation, 2.0);
  EXPECT_GT(heightNow(simulation), 0.05);
}

TEST(LiftFanOfACushion, LostCommandDoesNotDropTheCraft) {
  Simulation simulation(sceneOfTheLiftFan());
  turnAt(simulation, 0.9);
  runFor(simulation, 1.0);
  const double hovering = heightNow(simulation);
  EXPECT_GT(hovering, 0.0515);
  runFor(simulation, 20.0);
  EXPECT_NEAR(heightNow(simulation), hovering, 1e-6);
  EXPECT_FALSE(simulation.engineReport(0, static_cast<int>(kLiftId)).timed_out);
}

TEST(LiftFanOfACushion, TimeOutThatIsAskedForDropsTheCraft) {
  Simulation simulation(sceneOfTheLiftFan({"vehicles.rc5.actuators.lift.timeout=0.5"}));
  runFor(simulation, 2.0);  // no command came, so none is lost
  EXPECT_GT(heightNow(simulation), 0.052);
  turnAt(simulation, 1.0);
  runFor(simulation, 3.0);
  EXPECT_NEAR(heightNow(simulation), 0.042, 2e-6);
}

TEST(LiftFanOfACushion, CommandsOfTheEnginesLeaveItAsItIs) {
  Simulation simulation(sceneOfTheLiftFan());
  turnAt(simulation, 0.9);
  simulation.step();
  for (int i = 0; i < 2000; ++i) {
    if (i % 10 == 0) simulation.push({simulation.tick(), 0, kAllEngines, {0.0, 2.0, 2.0}});
    simulation.step();
  }
  EXPECT_NEAR(cushionNow(simulation).fan_speeds.at(0), 0.9, 1e-6);
  EXPECT_GT(simulation.motion(0).p_WB.x(), 0.5);
}

TEST(LiftFanOfACushion, SpeedThatIsCommandedIsTheSameAsOneOfTheScenario) {
  Simulation commanded(overAPlane(""));
  Simulation described(loadScenario("config/rc5.yaml", {},
                                    {"--set", {"vehicles.rc5.cushion.fans.lift.speed=0.85"}}));
  turnAt(commanded, 0.85);
  for (int i = 0; i < 1000; ++i) {
    commanded.step();
    described.step();
    ASSERT_EQ(heightNow(commanded), heightNow(described)) << i;
  }
}

TEST(LiftFanOfACushion, RunGoesOnFromASnapshotOnTheWayDownToTheLastBit) {
  for (const char* integrator : {"heun", "rk4"}) {
    SCOPED_TRACE(integrator);
    Simulation whole(sceneOfTheLiftFan({"integrator=" + std::string(integrator)}));
    runFor(whole, 1.0);
    turnAt(whole, 0.0);
    runFor(whole, 0.1);  // it is half way down, and its fan slows down
    EXPECT_GT(cushionNow(whole).fan_speeds.at(0), 0.3);
    EXPECT_LT(heightNow(whole), 0.0528);
    Simulation resumed(whole.scenario());
    resumed.restore(parseSnapshot(toSnapshot(whole), "snap.yaml", whole.scenario()));
    for (Simulation* simulation : {&whole, &resumed}) {
      runFor(*simulation, 1.0);
      turnAt(*simulation, 1.0);
      runFor(*simulation, 1.0);
    }
    EXPECT_EQ(resumed.hash(), whole.hash());
    EXPECT_GT(heightNow(whole), 0.052);
  }
}

/// Height after 0.2 s in which the fan slows down from full speed to 0.9, with steps of h.
double loweredHeight(const std::string& integrator, const std::string& h) {
  Simulation simulation(overAPlane(
      ", time_constant: 0.1",
      {"integrator=" + integrator, "step_size=" + h, "vehicles.rc5.cushion.skirt.stiffness=0"}));
  turnAt(simulation, 0.9);
  runFor(simulation, 0.2);
  return heightNow(simulation);
}

// Each stage has its own speed of the fan, by the exact lag: halving the step divides the error by
// 2^order.
TEST(LiftFanOfACushion, EachStepperKeepsItsOrderWhileTheFanSlowsDown) {
  const double exact = loweredHeight("rk4", "0.0001");
  const auto order = [&](const char* integrator, const char* h, const char* half) {
    return std::log2((loweredHeight(integrator, h) - exact) /
                     (loweredHeight(integrator, half) - exact));
  };
  EXPECT_NEAR(order("euler", "0.0005", "0.00025"), 1.0, 0.1);
  EXPECT_NEAR(order("semi_implicit_euler", "0.0005", "0.00025"), 1.0, 0.1);
  EXPECT_NEAR(order("heun", "0.002", "0.001"), 2.0, 0.1);
  EXPECT_NEAR(order("rk4", "0.004", "0.002"), 4.0, 0.2);
}

TEST(LiftFanOfACushion, PlanarCraftGrindsWhenItIsStopped) {
  const auto coasted = [](double speed) {
    Simulation simulation(overAPlane("", {"model=planar", "vehicles.rc5.drag.linear=[0, 0, 0]",
                                          "vehicles.rc5.initial.velocity=[1, 0, 0]"}));
    turnAt(simulation, speed);
    runFor(simulation, 1.0);
    return simulation.motion(0).twist.v_WB.x();
  };
  EXPECT_NEAR(coasted(0.0), 0.0, 1e-3);
  EXPECT_GT(coasted(1.0), 0.98);
}

TEST(LiftFanOfACushion, SceneFliesItsCommands) {
  Simulation simulation(sceneOfTheLiftFan());
  CsvCommandSource commands("config/lift_fan.csv", simulation.scenario());
  while (const auto command = commands.next()) simulation.push(*command);
  runFor(simulation, 1.4);
  EXPECT_GT(simulation.motion(0).twist.v_WB.x(), 0.5);
  runFor(simulation, 2.0);
  const double stood = simulation.motion(0).p_WB.x();
  EXPECT_NEAR(heightNow(simulation), 0.042, 2e-6);
  runFor(simulation, 0.5);
  EXPECT_NEAR(simulation.motion(0).p_WB.x(), stood, 1e-4);
  runFor(simulation, 2.1);
  EXPECT_NEAR(heightNow(simulation), 0.053, 2e-4);
  EXPECT_GT(simulation.motion(0).p_WB.x(), stood + 0.2);
}

}  // namespace
}  // namespace hovercraft
