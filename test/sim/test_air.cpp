#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/snapshot.h"

#include "../support/files.h"
#include "../support/scenario_text.h"
#include "../support/scenarios.h"

namespace hovercraft {
namespace {

using testing::messageOf;
using testing::scenarioOf;
using testing::with;

const std::string kGusts =
    "wind: [3, 1, 0]\n"
    "gusts: {model: dryden, along: {sigma: 1, length: 20}, across: {sigma: 0.8, length: 21}, "
    "vertical: {sigma: 0.4, length: 3}}\n";

std::string draggedCraft(const std::string& integrator = "heun") {
  return "step_size: 0.01\nintegrator: " + integrator + "\nmodel: planar\nvehicles:\n" +
         testing::craftYaml("craft") + "    drag: {linear: [1, 2, 0], quadratic: [0.5, 0.5, 0]}\n";
}
Scenario gustyScenario() {
  return scenarioOf(kGusts + draggedCraft());
}
std::string airComplaint(const std::string& yaml) {
  return messageOf([&] { scenarioOf(yaml); });
}
const std::string kNoComplaint = "nothing was thrown";
void flyOn(Simulation& simulation, Tick ticks) {
  for (Tick i = 0; i < ticks; ++i) simulation.step();
}

TEST(Air, GustsBlowAboutTheMeanWind) {
  Simulation simulation(gustyScenario());
  Vector3 sum = Vector3::Zero();
  constexpr int kTicks = 40000;
  for (int i = 0; i < kTicks; ++i) {
    sum += simulation.windAt(0);
    simulation.step();
  }
  // τ = 20/√10 = 6.3 s in 400 s: the mean of the gusts has an error of σ √(2 τ/T) = 0.18 m/s.
  EXPECT_LT(norm(sum / kTicks - Vector3(3.0, 1.0, 0.0)), 3.0 * 0.18 * std::sqrt(1.64));
  EXPECT_GT(norm(simulation.windAt(0) - Vector3(3.0, 1.0, 0.0)), 0.0);
}

// A craft that drag alone moves follows a steady wind: m dv/dt = k (w - v).
TEST(Air, TheMeanWindMayChangeWhileItRuns) {
  Simulation simulation(scenarioOf(with(draggedCraft("rk4"), ", quadratic: [0.5, 0.5, 0]", "")));
  flyOn(simulation, 100);
  EXPECT_EQ(simulation.motion(0).twist.v_WB, Vector3(0.0, 0.0, 0.0));
  simulation.setWind({2.0, 0.0, 0.0});
  flyOn(simulation, 200);  // 2 s; 2 kg / 1 N s/m = 2 s
  EXPECT_NEAR(simulation.motion(0).twist.v_WB.x(), 2.0 * (1.0 - std::exp(-1.0)), 1e-9);
}

TEST(Air, IsInTheHashWhereItIsNotWhatTheScenarioSaysForEver) {
  const Scenario still = scenarioOf(draggedCraft());
  Simulation a(still);
  Simulation b(still);
  b.setWind({1.0, 0.0, 0.0});
  EXPECT_NE(a.hash(), b.hash());
  EXPECT_NE(a.hash(0), b.hash(0));
  b.setWind({0.0, 0.0, 0.0});
  EXPECT_EQ(a.hash(), b.hash());

  const Scenario gusts = gustyScenario();
  Simulation first(gusts);
  Simulation other(gusts);
  other.reset(2);  // the craft is where it was; its gusts are others
  EXPECT_NE(first.hash(), other.hash());
  EXPECT_NE(first.hash(0), other.hash(0));
  other.reset(gusts.seed);
  EXPECT_EQ(first.hash(), other.hash());
}

TEST(Air, ARunGoesOnFromASnapshotBitForBit) {
  const Scenario scenario = gustyScenario();
  Simulation unbroken(scenario);
  flyOn(unbroken, 137);
  unbroken.setWind({-1.0, 2.5, 0.1});
  flyOn(unbroken, 51);
  Simulation resumed(scenario);
  resumed.restore(parseSnapshot(toSnapshot(unbroken), "snap", scenario));
  EXPECT_EQ(resumed.windAt(0), unbroken.windAt(0));
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(resumed.hash(), unbroken.hash());
    flyOn(resumed, 100);
    flyOn(unbroken, 100);
  }
}

TEST(Air, ASnapshotWhoseAirWasChangedIsRefused) {
  const Scenario scenario = gustyScenario();
  Simulation simulation(scenario);
  flyOn(simulation, 10);
  simulation.setWind({1.5, 0.0, 0.0});
  const std::string text = toSnapshot(simulation);
  const auto refusal = [&](const std::string& from, const std::string& to) {
    return messageOf([&] { parseSnapshot(with(text, from, to), "snap", scenario); });
  };
  EXPECT_NE(refusal("wind: [1.5,", "wind: [1.25,").find("hash"), std::string::npos);
  EXPECT_NE(refusal("along: [", "along: [1, ").find("gusts.craft.along"), std::string::npos);
  EXPECT_NE(refusal("\n  craft: {along", "\n  kraft: {along").find("gusts.craft"),
            std::string::npos);
  const Scenario still = scenarioOf(draggedCraft());
  const std::string of_still = toSnapshot(Simulation(still));
  EXPECT_NE(messageOf([&] {
              parseSnapshot(with(of_still, "scenario:", "gusts: {}\nscenario:"), "snap", still);
            }).find("gusts: there are none in the scenario"),
            std::string::npos);
}

// A zero of either sign is a wind of its own to the hash.
TEST(Air, ASnapshotKeepsTheSignOfAZero) {
  for (const Scenario& scenario : {gustyScenario(), scenarioOf(draggedCraft())}) {
    Simulation simulation(scenario);
    simulation.setWind({-0.0, 0.0, -0.0});
    Simulation loaded(scenario);
    loaded.restore(parseSnapshot(toSnapshot(simulation), "snap", scenario));
    EXPECT_EQ(loaded.hash(), simulation.hash());
    EXPECT_TRUE(std::signbit(loaded.state().wind_W.z()));
  }
}

TEST(Air, ASnapshotOfAnAirThatCannotBeIsRefused) {
  const Scenario scenario = gustyScenario();
  Simulation simulation(scenario);
  flyOn(simulation, 10);
  SimulationState state = simulation.state();
  state.wind_W = {2e6, 0.0, 0.0};
  const auto refusal = [&] {
    Simulation changed(scenario);
    changed.restore(state);
    return messageOf([&] { parseSnapshot(toSnapshot(changed), "snap", scenario); });
  };
  EXPECT_NE(refusal().find("wind: its speed must be at most 1e6 m/s"), std::string::npos)
      << refusal();
  state = simulation.state();
  state.gusts[0][1] = 1e-3;  // the second number of a law of first order is 0
  EXPECT_NE(refusal().find("within 100 standard deviations"), std::string::npos) << refusal();
  state = simulation.state();
  state.gusts[0][0] = -101.0;
  EXPECT_NE(refusal().find("within 100 standard deviations"), std::string::npos) << refusal();
  state.gusts[0][0] = -99.0;
  EXPECT_EQ(refusal(), kNoComplaint);
}

TEST(Air, AScenarioComesBackFromItsText) {
  const Scenario scenario = scenarioOf(
      kGusts +
      with(draggedCraft(), "quadratic: [0.5, 0.5, 0]",
           "polar: {air_density: 1.2, area_x: 1, area_y: 2, length: 0.5, surge: [0, 0.5, 0, 0.1], "
           "sway: [0.6], yaw: [0, 0.1]}"));
  const std::string text = toYaml(scenario);
  EXPECT_EQ(toYaml(scenarioOf(text)), text);
  EXPECT_EQ(std::get<DragPolar>(scenarioOf(text).vehicles[0].drag_laws.at(0)).yaw[1], 0.1);
  Simulation a(scenario);
  Simulation b(scenarioOf(text));
  flyOn(a, 50);
  flyOn(b, 50);
  EXPECT_EQ(a.hash(), b.hash());
}

// The gust of a tick is held during its step: a smooth problem between two ticks. h^p to h^p/2^p.
TEST(Air, EachStepperKeepsItsOrderInGusts) {
  const auto error_of = [](const std::string& integrator, double step, double reference_step) {
    const auto end_of = [&](double h, const std::string& kind) {
      // One step of 0.1 s in the wind of tick 0, cut into pieces of h.
      Scenario scenario = scenarioOf(kGusts + draggedCraft(kind));
      const Vector3 wind = Simulation(scenario).windAt(0);
      scenario.gusts.reset();
      scenario.wind = wind;
      scenario.step_ns = static_cast<std::int64_t>(std::llround(h * 1e9));
      Simulation simulation(scenario);
      flyOn(simulation, static_cast<Tick>(std::llround(0.4 / h)));
      return simulation.motion(0).p_WB;
    };
    return norm(end_of(step, integrator) - end_of(reference_step, "rk4"));
  };
  const auto order_of = [&](const std::string& integrator) {
    return std::log2(error_of(integrator, 0.04, 0.001) / error_of(integrator, 0.02, 0.001));
  };
  EXPECT_NEAR(order_of("euler"), 1.0, 0.1);
  EXPECT_NEAR(order_of("semi_implicit_euler"), 1.0, 0.1);
  EXPECT_NEAR(order_of("heun"), 2.0, 0.1);
  EXPECT_NEAR(order_of("rk4"), 4.0, 0.2);
}

TEST(Air, APolarDrivesTheCraftToTheWind) {
  Simulation simulation(scenarioOf(
      "wind: [2, 0, 0]\n" + with(draggedCraft(), "linear: [1, 2, 0], quadratic: [0.5, 0.5, 0]",
                                 "polar: {area_x: 4, area_y: 4, surge: [0, 1], sway: [1]}")));
  flyOn(simulation, 2000);
  // dv/dt = -k/m (v - w)², k = 4.9/2: w - v = w/(1 + k w t/m) = 2/(1 + 2.45 2 20/2) = 0.04.
  EXPECT_NEAR(2.0 - simulation.motion(0).twist.v_WB.x(), 0.04, 2e-4);
}

TEST(Air, ABadKeyIsNamed) {
  EXPECT_EQ(airComplaint(with(kGusts, "dryden", "karman") + draggedCraft()),
            "test: gusts.model = karman: must be one of: first_order, dryden");
  EXPECT_EQ(airComplaint(with(kGusts, "sigma: 1,", "sigma: -1,") + draggedCraft()),
            "test: gusts.along.sigma = -1: must be 0 to 1e6");
  EXPECT_EQ(airComplaint(with(kGusts, "sigma: 1,", "sigma: 1e308,") + draggedCraft()),
            "test: gusts.along.sigma = 1e308: must be 0 to 1e6");
  EXPECT_EQ(airComplaint(with(kGusts, "length: 20", "length: 0") + draggedCraft()),
            "test: gusts.along.length = 0: must be greater than 0");
  EXPECT_EQ(airComplaint(with(kGusts, "length: 3", "length: 0.01") + draggedCraft()),
            "test: gusts.vertical.length = 0.01: must be at least the way of the wind in a step, "
            "0.0316227766016838 m");
  EXPECT_EQ(
      airComplaint(with(kGusts, "vertical", "upward") + draggedCraft()).find("test: gusts.upward"),
      0U);
  EXPECT_EQ(airComplaint("gusts: {}\n" + draggedCraft()),
            "test: gusts = {}: must have one of along, across, vertical");
  EXPECT_EQ(airComplaint("gusts: 3\n" + draggedCraft()).find("test: gusts = 3"), 0U);
  EXPECT_EQ(airComplaint(with(kGusts, ", length: 20}", "}") + draggedCraft()),
            "test: gusts.along.length: the key is missing");
  EXPECT_EQ(airComplaint(with(kGusts, "length: 3", "length: .nan") + draggedCraft())
                .find("test: gusts.vertical.length"),
            0U);
}

TEST(Air, ABadPolarIsNamed) {
  const auto polar = [](const std::string& text) {
    return airComplaint(with(draggedCraft(), "quadratic: [0.5, 0.5, 0]", "polar: {" + text + "}"));
  };
  const std::string path = "test: vehicles.craft.drag.polar";
  EXPECT_EQ(polar("area_x: 1, area_y: 1, surge: [0, 1], sway: [1]"), kNoComplaint);
  EXPECT_EQ(polar("area_x: 1"), path + ".area_y: the key is missing");
  EXPECT_EQ(polar("area_x: 1, area_y: 1, surge: [1, 2, 3, 4, 5, 6, 7]"),
            path + ".surge = [1, 2, 3, 4, 5, 6, 7]: must be a list of at most 6 numbers");
  EXPECT_EQ(polar("area_x: 1, area_y: 1, yaw: [1]"), path + ".length: the key is missing");
  EXPECT_EQ(polar("area_x: 1, area_y: 1, length: 1"), path + ".length = 1: needs yaw");
  EXPECT_EQ(polar("area_x: -1, area_y: 1").find(path + ".area_x = -1: must be 0 or greater"), 0U);
  // a_0 pushes a craft on that moves astern: first beyond 90 deg.
  EXPECT_NE(polar("area_x: 1, area_y: 1, surge: [1]")
                .find("drives the craft on where it moves through the air at 90.5 deg"),
            std::string::npos);
  EXPECT_NE(polar("area_x: 1, area_y: 1, sway: [-0.1], surge: [0, 1]").find("drives the craft on"),
            std::string::npos);
}

}  // namespace
}  // namespace hovercraft
