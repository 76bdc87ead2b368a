#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/craft_pilots.h"
#include "hovercraft_sim/sim/run.h"

#include "../support/files.h"

namespace hovercraft {
namespace {

/// What a run told.
class ToldManoeuvres : public RunObserver {
 public:
  void applied(const Command& command) override { commands.push_back(command); }
  void flown(const FlownManoeuvre& manoeuvre, std::size_t vehicle, Tick tick) override {
    manoeuvres.push_back(manoeuvre);
    vehicles.push_back(vehicle);
    ticks.push_back(tick);
  }

  std::vector<Command> commands;
  std::vector<FlownManoeuvre> manoeuvres;
  std::vector<std::size_t> vehicles;
  std::vector<Tick> ticks;
};

class PilotedRuns : public ::testing::Test {
 protected:
  /// Flies a plan with a scenario of config/.
  void fly(const std::string& name, const std::string& plan) {
    const Scenario scenario = loadScenario("config/" + name);
    CraftPilots pilots({folder_.write("plan.yaml", plan)}, scenario);
    Simulation simulation(scenario);
    RunPlan run_plan;
    run_plan.last_tick = pilots.lastTick();
    run_plan.steer = [&](Simulation& now) { return pilots.steer(now, told_); };
    NoCommands none;
    run(simulation, none, told_, run_plan);
    last_tick_ = simulation.tick();
  }
  double measure(const std::string& name) const {
    for (const Measure& measure : told_.manoeuvres.at(0).measures) {
      if (measure.name == name) return measure.value;
    }
    ADD_FAILURE() << "no measure " << name;
    return 0.0;
  }

  testing::TestFolder folder_;
  ToldManoeuvres told_;
  Tick last_tick_ = 0;
};

TEST_F(PilotedRuns, AStopOfTheMvwtHasItsClosedForm) {
  // Linear drag 4.5 N s/m on 5.15 kg: from 2 m/s (both fans full) it goes m/k (v0 - v1) in
  // m/k ln(v0/v1) once its fans, which have no lag, are off.
  fly("mvwt.yaml",
      "manoeuvres: [{kind: stop, throttle: {left: 4.5, right: 4.5}, approach: 15, levels: {left: "
      "0, "
      "right: 0}, end_speed: 0.1}]");
  ASSERT_EQ(told_.manoeuvres.size(), 1U);
  EXPECT_TRUE(told_.manoeuvres[0].is_complete);
  const double lag = 5.15 / 4.5;
  EXPECT_NEAR(measure("approach speed"), 2.0, 1e-4);
  EXPECT_NEAR(measure("head reach"), lag * 1.9, 0.01);
  EXPECT_NEAR(measure("time to stop"), lag * std::log(20.0), 0.01);
}

TEST_F(PilotedRuns, AStepOfTheMvwtRisesByItsTimeConstant) {
  fly("mvwt.yaml",
      "manoeuvres: [{kind: steps, levels: [{left: 2, right: 2}], hold: 12, response: surge}]");
  EXPECT_NEAR(measure("step 1: settles at"), 4.0 / 4.5, 1e-3);
  EXPECT_NEAR(measure("step 1: rise time"), 5.15 / 4.5 * std::log(9.0), 0.005);
  EXPECT_NEAR(measure("step 1: overshoot"), 0.0, 0.01);
}

TEST_F(PilotedRuns, TheSteadyTurnOfTheMvwtHasItsClosedForm) {
  // One fan of 4.5 N at 0.123 m against 0.41 N m s: 1.35 rad/s.
  fly("mvwt.yaml",
      "helm: {port: {left: -2.25, right: 2.25}, starboard: {left: 2.25, right: -2.25}}\n"
      "manoeuvres: [{kind: turning_circle, throttle: {left: 2.25, right: 2.25}, approach: 5, "
      "turn_deg: 1440}]");
  EXPECT_NEAR(measure("steady yaw rate"), 1.35 * 180.0 / kPi, 0.05);
  EXPECT_NEAR(measure("steady turning radius"), measure("steady speed") / 1.35, 1e-4);
}

TEST_F(PilotedRuns, CommandsComeAtEachPeriodFromTheFirstOneOn) {
  fly("hovercraft.yaml", "period: 0.02\nmanoeuvres: [{kind: ramp, to: {rear: 4}, duration: 1}]");
  ASSERT_FALSE(told_.commands.empty());
  for (std::size_t i = 0; i < told_.commands.size(); ++i) {
    EXPECT_EQ(told_.commands[i].tick, static_cast<Tick>(20 * (i + 1)));
    EXPECT_EQ(told_.commands[i].engines, kAllEngines);
  }
  EXPECT_DOUBLE_EQ(told_.commands[25].thrusts[0], 2.0);
  EXPECT_EQ(told_.ticks, std::vector<Tick>{1020});
  // Nothing is commanded any more for a second, then it is over.
  EXPECT_EQ(told_.commands.back().thrusts[0], 0.0);
  EXPECT_EQ(last_tick_, 2020);
}

TEST(CraftPilot, DecidesAtTheFirstMotionAtOrAfterEachOfItsTicks) {
  const Scenario scenario = loadScenario("config/hovercraft.yaml");
  const CraftPilot pilot(
      parsePilot("manoeuvres: [{kind: ramp, to: {rear: 4}, duration: 1}]", "plan", scenario),
      scenario.step_ns);
  ASSERT_EQ(pilot.periodTicks(), 10);
  // At 125 Hz: all but each fifth motion is the first one after such a tick.
  int decisions = 0;
  for (Tick tick = 8; tick <= 1000; tick += 8)
    decisions += pilot.isDueSince(tick - 8, tick) ? 1 : 0;
  EXPECT_EQ(decisions, 100);
  // Where motions are seen at its own ticks, as in `simulate`, at those alone.
  for (Tick tick = 1; tick <= 100; ++tick) {
    EXPECT_EQ(pilot.isDueSince(tick - 1, tick), pilot.isDue(tick)) << tick;
    EXPECT_FALSE(pilot.hasMissed(tick - 1, tick)) << tick;
  }
  EXPECT_FALSE(pilot.isDueSince(20, 20));
  EXPECT_FALSE(pilot.hasMissed(20, 20));
  EXPECT_FALSE(pilot.hasMissed(20, 30));
  EXPECT_TRUE(pilot.hasMissed(24, 32));  // it decides at 32, not at 30
  EXPECT_TRUE(pilot.hasMissed(20, 40));
  EXPECT_FALSE(pilot.hasMissed(8, 10));
}

TEST(CraftPilot, HasTheLevelsOfTheStartUntilItDecides) {
  Scenario scenario = loadScenario("test/rostest/pilot_rudder.yaml");
  scenario.vehicles[0].actuators.back().initial = 0.25;
  const CraftPilot pilot(
      parsePilot("manoeuvres: [{kind: ramp, to: {rudder: 0.5}, duration: 1}]", "plan", scenario),
      scenario.step_ns);
  EXPECT_EQ(pilot.command().tick, 0);
  EXPECT_EQ(pilot.command().engines, maskOf(kFirstActuator));
  EXPECT_EQ(pilot.command().thrusts, (ActuatorArray<double>{0.0, 0.0, 0.0, 0.25}));
}

TEST(CraftPilots, TwoForOneCraftAreRefused) {
  const testing::TestFolder folder;
  const Scenario scenario = loadScenario("config/hovercraft.yaml");
  const std::string path =
      folder.write("p.yaml", "manoeuvres: [{kind: ramp, to: {rear: 4}, duration: 1}]");
  EXPECT_NE(testing::messageOf([&] {
              CraftPilots({path, path}, scenario);
            }).find("vehicle: hovercraft must have one pilot at most"),
            std::string::npos);
}

}  // namespace
}  // namespace hovercraft
