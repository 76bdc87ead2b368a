#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

/// Craft on cushions as scenarios fly them.

namespace hovercraft {
namespace {

/// A shipped scenario with changes.
Simulation flightOf(const std::string& name, const std::vector<std::string>& sets = {}) {
  return Simulation(loadScenario("config/" + name + ".yaml", {}, {"--set", sets}));
}

void fly(Simulation& simulation, double seconds) {
  const auto ticks = static_cast<Tick>(std::llround(seconds / simulation.scenario().stepSize()));
  for (Tick i = 0; i < ticks; ++i) simulation.step();
}

double totalForce(const Simulation& simulation) {
  CushionReport report;
  simulation.cushionReport(0, report);
  double force = 0.0;
  for (const CellReport& cell : report.cells) force += cell.force;
  return force;
}

/// rc5 over a floor of the world instead of a plane.
const std::vector<std::string> kOverAFloor = {
    "world={obstacles: {floor: {box: {size: [20, 20, 1]}, position: [0, 0, -0.5]}}}"};

TEST(CushionSimulation, CraftHoversOverAPlaneWithItsWeightOnTheCushion) {
  Simulation simulation = flightOf("rc5");
  fly(simulation, 5.0);
  const double weight = 5.15 * 9.80665;
  // The skirt carries what its smooth compression leaves it: l k_s d²/(4 g), 2.8 mN.
  EXPECT_NEAR(totalForce(simulation), weight, 1e-3 * weight);
  EXPECT_NEAR(simulation.motion(0).p_WB.z(), 0.053, 2e-5);
  EXPECT_NEAR(norm(simulation.motion(0).twist.v_WB), 0.0, 1e-9);
}

TEST(CushionSimulation, PlaneThatIsLeftOnTheWayUpIsNotMetByContact) {
  // ground: plane and a world beside it are two things: the plane is no obstacle.
  Simulation plane = flightOf("rc5");
  Simulation beside = flightOf("rc5", {"world={}"});
  fly(plane, 1.0);
  fly(beside, 1.0);
  EXPECT_EQ(plane.motion(0).p_WB.z(), beside.motion(0).p_WB.z());
}

TEST(CushionSimulation, FloorOfTheWorldIsTheSameGroundAsAPlane) {
  Simulation plane = flightOf("rc5");
  Scenario scenario = loadScenario("config/rc5.yaml", {}, {"--set", kOverAFloor});
  scenario.ground.reset();
  Simulation floor(scenario);
  fly(plane, 2.0);
  fly(floor, 2.0);
  EXPECT_NEAR(plane.motion(0).p_WB.z(), floor.motion(0).p_WB.z(), 1e-12);
  EXPECT_GT(plane.motion(0).p_WB.z(), 0.05);
}

TEST(CushionSimulation, CraftSlidesDownASlopeByTheSineOfItsAngle) {
  // No drag but that of momentum: m v' = m g sin(a) - m_dot v, with m_dot of the steady flow.
  const double a = 0.1;
  Scenario scenario = loadScenario("config/rc5.yaml");
  const Matrix3 slope = rotationFromRpy({0.0, a, 0.0});
  std::get<PlaneScenario>(scenario.ground->surface).normal = slope.col(2);
  VehicleScenario& craft = scenario.vehicles[0];
  craft.drag = Drag();
  craft.initial_rpy = Vector3(0.0, a, 0.0);
  craft.initial_p_WB = 0.053 * slope.col(2);
  craft.cushion->skirt.stiffness = 0.0;
  craft.cushion->fans[0].p_HI = Vector3::Zero();  // else its drag pitches the craft
  Simulation simulation(scenario);
  fly(simulation, 3.0);
  CushionReport report;
  simulation.cushionReport(0, report);
  double flow = 0.0;
  for (const CellReport& cell : report.cells) flow += cell.flow;
  const double mass_flow = 1.225 * flow;
  const double terminal = 5.15 * 9.80665 * std::sin(a) / mass_flow;
  const double expected = terminal * (1.0 - std::exp(-mass_flow / 5.15 * 3.0));
  EXPECT_NEAR(dot(simulation.motion(0).twist.v_WB, slope.col(0)), expected, 1e-4 * expected);
}

TEST(CushionSimulation, WithoutItsFansTheCraftStandsOnThePadsOfItsHull) {
  Simulation simulation = flightOf("rc5", {"vehicles.rc5.cushion.fans.lift.speed=0"});
  fly(simulation, 5.0);
  // Four vertices carry what the skirt does not, and sink by less than 1 mm.
  const double z = simulation.motion(0).p_WB.z();
  EXPECT_LT(z, 0.042);
  EXPECT_GT(z, 0.041);
  EXPECT_NEAR(norm(simulation.motion(0).twist.v_WB), 0.0, 1e-6);
}

TEST(CushionSimulation, WithoutItsFansTheCraftStandsOnItsHullByContact) {
  Scenario scenario = loadScenario("config/ramp.yaml");
  scenario.vehicles[0].cushion->fans[0].speeds = {{0.0, 0.0}};
  Simulation simulation(scenario);
  fly(simulation, 3.0);
  EXPECT_NEAR(simulation.motion(0).p_WB.z(), 0.042, 2e-6);
  ASSERT_NE(simulation.world(), nullptr);
  EXPECT_LT(simulation.world()->leastGap(simulation.state().bodies), 1e-6);
  EXPECT_GT(simulation.world()->leastGap(simulation.state().bodies), 0.0);
}

TEST(CushionSimulation, CraftSettlesWhenItsFanStopsAndLiftsOffAgain) {
  Scenario scenario = loadScenario("config/ramp.yaml");
  scenario.vehicles[0].cushion->fans[0].speeds = {{1.0, 1.0}, {1.5, 0.0}, {3.0, 0.0}, {3.5, 1.0}};
  Simulation simulation(scenario);
  fly(simulation, 1.0);
  const double hovering = simulation.motion(0).p_WB.z();
  EXPECT_NEAR(hovering, 0.053, 1e-4);
  fly(simulation, 1.9);
  EXPECT_NEAR(simulation.motion(0).p_WB.z(), 0.042, 2e-6);
  fly(simulation, 2.1);
  EXPECT_NEAR(simulation.motion(0).p_WB.z(), hovering, 1e-4);
}

TEST(CushionSimulation, CraftHoldsOnASlopeByTheFrictionOfItsHull) {
  // On the ramp of the scene, 0.05 rad, with its fans at rest.
  Scenario scenario = loadScenario("config/ramp.yaml");
  VehicleScenario& craft = scenario.vehicles[0];
  craft.cushion->fans[0].speeds = {{0.0, 0.0}};
  craft.initial_rpy = Vector3(0.0, -0.05, 0.0);
  craft.initial_p_WB = Vector3(2.0, 0.0, 0.13);
  Simulation simulation(scenario);
  fly(simulation, 2.0);
  const Vector3 settled = simulation.motion(0).p_WB;
  fly(simulation, 2.0);
  // What speed it has when it comes to rest stays: 24 µm/s (doc/craft.md). Without friction
  // it would be 1 m further.
  EXPECT_LT(norm(simulation.motion(0).p_WB - settled), 1e-4);
}

TEST(CushionSimulation, SceneOfTheRampGoesOverTheBumpAndUp) {
  Scenario scenario = loadScenario("config/ramp.yaml");
  scenario.vehicles[0].cushion->fans[0].speeds.clear();
  Simulation simulation(scenario);
  simulation.push({0, 0, kAllEngines, Vector3(0.0, 4.5, 4.5)});
  double highest_before = 0.0;
  while (simulation.motion(0).p_WB.x() < 0.3 && simulation.tick() < 5000) {
    simulation.step();
    highest_before = std::max(highest_before, simulation.motion(0).p_WB.z());
  }
  EXPECT_GT(highest_before, 0.0535);  // the bump lifts it
  while (simulation.motion(0).p_WB.x() < 2.0 && simulation.tick() < 10000) simulation.step();
  ASSERT_LT(simulation.tick(), 10000);
  // On the ramp its surface is (x - 0.5) tan(0.05) high, and the craft lies parallel to it.
  const Motion motion = simulation.motion(0);
  const double above = (motion.p_WB.x() - 0.5) * std::tan(0.05);
  EXPECT_NEAR(motion.p_WB.z() - above, 0.053, 0.006);
  EXPECT_NEAR(2.0 * motion.q_WB.v.y(), -0.05, 0.02);
}

TEST(CushionSimulation, SceneOfRoughGroundIsFollowed) {
  Simulation simulation = flightOf("rough");
  simulation.push({0, 0, kAllEngines, Vector3(0.0, 3.0, 3.0)});
  double lowest = 1.0;
  double highest = 0.0;
  for (int i = 0; i < 5000; ++i) {
    simulation.step();
    if (i < 500) continue;
    lowest = std::min(lowest, simulation.motion(0).p_WB.z());
    highest = std::max(highest, simulation.motion(0).p_WB.z());
  }
  EXPECT_GT(simulation.motion(0).p_WB.x(), 3.0);
  EXPECT_GT(highest - lowest, 0.004);
  EXPECT_LT(highest, 0.053 + 0.024 + 0.01);
}

TEST(CushionSimulation, PlanarCraftGrindsUntilItsFansCarryIt) {
  // Lift-off at s = sqrt(m g/(a S)) = 0.7071.
  const auto coasted = [](const std::string& speed) {
    Simulation simulation = flightOf(
        "rc5", {"model=planar", "vehicles.rc5.cushion.fans.lift.speed=" + speed,
                "vehicles.rc5.drag.linear=[0, 0, 0]", "vehicles.rc5.initial.velocity=[1, 0, 0]"});
    fly(simulation, 1.0);
    return simulation.motion(0).twist.v_WB.x();
  };
  EXPECT_NEAR(coasted("0"), 0.0, 1e-3);
  // N = m g - s² a S; v = 1 - mu N/m t, but for the momentum drag of no flow.
  const double load = 5.15 * 9.80665 - 0.66 * 0.66 * 935.264 * 0.108;
  EXPECT_NEAR(coasted("0.66"), 1.0 - 0.3 * load / 5.15, 2e-3);
  const double lifted = coasted("1");
  EXPECT_LT(lifted, 1.0);
  EXPECT_NEAR(lifted, std::exp(-1.225 * 0.0656 / 5.15), 1e-4);
}

TEST(CushionSimulation, RunGoesOnFromASnapshotToTheLastBit) {
  Simulation simulation = flightOf("rough");
  fly(simulation, 0.5);
  Simulation again(simulation.scenario());
  again.restore(simulation.state());
  fly(simulation, 0.5);
  fly(again, 0.5);
  EXPECT_EQ(simulation.hash(), again.hash());
}

TEST(CushionSimulation, LooseBodyStandsOnAGround) {
  Simulation simulation = flightOf(
      "rc5", {"world={bodies: {crate: {parts: [{box: {size: [0.2, 0.2, 0.2]}, mass: 1}], initial: "
              "{position: [2, 0, 0.3]}}}}"});
  fly(simulation, 3.0);
  EXPECT_NEAR(simulation.bodyMotion(0).p_WB.z(), 0.1 - 0.001, 1e-5);
}

}  // namespace
}  // namespace hovercraft
