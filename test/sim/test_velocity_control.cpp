#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/velocity_parameters.h"

#include "../support/files.h"
#include "../support/scenarios.h"

namespace hovercraft {
namespace {

constexpr Tick kPeriod = 10;  // steps between two commands: 100 Hz

/// A craft under its velocity controller.
class Controlled {
 public:
  explicit Controlled(const Scenario& scenario)
      : simulation_(scenario),
        p_HB_(scenario.vehicles[0].mass_properties.p_HB),
        law_(velocityParametersOf(scenario.vehicles[0]).plant,
             velocityParametersOf(scenario.vehicles[0]).gains) {}

  VelocityLaw& law() { return law_; }
  Simulation& simulation() { return simulation_; }

  PlanarVelocity velocity() const {
    const Motion motion = simulation_.motion(0);
    const Vector3 v_B = rotate(conjugate(motion.q_WB), motion.twist.v_WB);
    const double r = motion.twist.w_WB.z();
    return {v_B.x() + r * p_HB_.y(), v_B.y() - r * p_HB_.x(), r};
  }

  void advance(const PlanarVelocity& command) {
    const Thrusts f = law_.thrusts(command, velocity(), simulation_.tick() == 0 ? 0.0 : 0.01);
    simulation_.push({simulation_.tick(), 0, kAllEngines, {f[0], f[1], f[2]}});
    for (Tick i = 0; i < kPeriod; ++i) simulation_.step();
  }

 private:
  Simulation simulation_;
  Vector3 p_HB_;
  VelocityLaw law_;
};

struct Step {
  double reached = 0.0;    // of the command, at the end
  double overshoot = 0.0;  // of the command
};

/// @param of the velocity: its size along the command.
template <class Of>
Step stepOf(const Scenario& scenario, const PlanarVelocity& command, double size, const Of& of) {
  Controlled craft(scenario);
  Step step;
  double last = 0.0;
  for (int n = 0; n < 2000; ++n) {  // 20 s
    craft.advance(command);
    last = of(craft.velocity()) / size;
    step.overshoot = std::max(step.overshoot, last - 1.0);
  }
  step.reached = last;
  return step;
}

const std::vector<std::string> kShipped = {"hovercraft", "mvwt"};

Scenario shippedCraft(const std::string& name) {
  return loadScenario("config/" + name + ".yaml");
}

TEST(VelocityControl, StepsOfSpeedAreReachedWithoutOvershoot) {
  for (const std::string& name : kShipped) {
    const Scenario scenario = shippedCraft(name);
    int steps = 0;
    for (const double sign : {1.0, -1.0}) {
      const double top = Controlled(scenario).law().topSpeed(sign);
      for (const double share : {0.25, 0.5, 0.75}) {
        if (top == 0.0) continue;  // no thrust astern
        ++steps;
        const double u = sign * share * top;
        const Step step =
            stepOf(scenario, {u, 0.0, 0.0}, u, [](const PlanarVelocity& v) { return v.u; });
        EXPECT_GE(step.reached, 0.95) << name << " " << u;
        EXPECT_LE(step.overshoot, 0.1) << name << " " << u;
      }
    }
    EXPECT_EQ(steps, 3) << name;  // neither has thrust astern
  }
}

TEST(VelocityControl, StepsOfYawRateAreReachedWithoutOvershoot) {
  for (const std::string& name : kShipped) {
    const Scenario scenario = shippedCraft(name);
    for (const double sign : {1.0, -1.0}) {
      const double top = Controlled(scenario).law().topYawRate(sign);
      ASSERT_GT(top, 0.5) << name;
      for (const double share : {0.25, 0.5, 0.75}) {
        const double r = sign * share * top;
        const Step step =
            stepOf(scenario, {0.0, 0.0, r}, r, [](const PlanarVelocity& v) { return v.r; });
        EXPECT_GE(step.reached, 0.95) << name << " " << r;
        EXPECT_LE(step.overshoot, 0.1) << name << " " << r;
      }
    }
  }
}

// Both fans of 4.5 N against 4.5 N s/m: 2 m/s. One alone turns it with 0.123 m 4.5 N / 0.41 N m s.
TEST(VelocityControl, KnowsWhatTheCraftReaches) {
  const Scenario scenario = shippedCraft("mvwt");
  EXPECT_NEAR(Controlled(scenario).law().topSpeed(1.0), 2.0, 1e-6);
  EXPECT_EQ(Controlled(scenario).law().topSpeed(-1.0), 0.0);
  EXPECT_NEAR(Controlled(scenario).law().topYawRate(1.0), 1.35, 1e-6);
  EXPECT_NEAR(Controlled(scenario).law().topYawRate(-1.0), 1.35, 1e-6);
  EXPECT_FALSE(Controlled(scenario).law().controlsSway());
}

TEST(VelocityControl, ACommandOutOfReachDoesNotWindUp) {
  Controlled craft(shippedCraft("mvwt"));
  for (int n = 0; n < 1000; ++n) craft.advance({50.0, 0.0, 0.0});
  EXPECT_GT(craft.velocity().u, 1.95);
  // Drag alone slows it from 2 to below 1.1 m/s in ln(2/1.05) 1.144 s = 0.74 s.
  int n = 0;
  for (; n < 200 && craft.velocity().u > 1.05; ++n) craft.advance({1.0, 0.0, 0.0});
  EXPECT_LT(n, 90);
  for (int k = 0; k < 300; ++k) {
    craft.advance({1.0, 0.0, 0.0});
    EXPECT_GT(craft.velocity().u, 0.9);
  }
}

// What the model does not know: a wind along the course. The integral makes up for it.
TEST(VelocityControl, TheIntegralHoldsAgainstAWind) {
  Scenario scenario = shippedCraft("hovercraft");
  scenario.wind = {-0.8, 0.0, 0.0};
  const Step step =
      stepOf(scenario, {1.0, 0.0, 0.0}, 1.0, [](const PlanarVelocity& v) { return v.u; });
  EXPECT_NEAR(step.reached, 1.0, 0.01);
  EXPECT_LE(step.overshoot, 0.1);
}

// Engines at both ends of each side push sideways without turning.
TEST(VelocityControl, SwayIsControlledWhereTheActuatorsCan) {
  Scenario scenario = testing::scenarioOf(testing::oneCraftYaml());
  scenario.step_ns = 1000000;
  auto& engines = scenario.vehicles[0].engines;
  engines[0] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, -5.0, 5.0, 0.05, 0};
  engines[1] = {{0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}, -5.0, 5.0, 0.05, 0};
  engines[2] = {{-0.5, 0.0, 0.0}, {0.0, 1.0, 0.0}, -5.0, 5.0, 0.05, 0};
  scenario.vehicles[0].drag.linear = {1.0, 2.0, 0.0};
  scenario.vehicles[0].drag.angular_linear = {0.0, 0.0, 0.1};
  Controlled craft(scenario);
  ASSERT_TRUE(craft.law().controlsSway());
  for (int n = 0; n < 1000; ++n) craft.advance({0.5, -0.4, 0.3});
  EXPECT_NEAR(craft.velocity().u, 0.5, 0.005);
  EXPECT_NEAR(craft.velocity().v, -0.4, 0.005);
  EXPECT_NEAR(craft.velocity().r, 0.3, 0.005);
}

TEST(VelocityControl, ShippedParametersAreThoseOfTheScenarios) {
  for (const std::string name : {"hovercraft", "mvwt", "lift_fan"}) {
    EXPECT_EQ(testing::contentOf("config/velocity_controller/" + name + ".yaml"),
              velocityYaml(velocityParametersOf(shippedCraft(name).vehicles[0]),
                           "config/" + name + ".yaml"))
        << "velocity_gains config/" << name << ".yaml makes it anew";
  }
}

TEST(VelocityControl, ParametersComeBackFromTheirText) {
  const VelocityParameters made = velocityParametersOf(shippedCraft("hovercraft").vehicles[0]);
  const std::string text = velocityYaml(made, "x");
  const VelocityParameters read = parseVelocityParameters(ConfigReader(treeOf(text, "x"), "x"));
  EXPECT_EQ(velocityYaml(read, "x"), text);
}

TEST(VelocityControl, ABadParameterIsNamed) {
  const std::string text =
      velocityYaml(velocityParametersOf(shippedCraft("mvwt").vehicles[0]), "x");
  const auto complaint = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return testing::messageOf(
        [&] { parseVelocityParameters(ConfigReader(treeOf(changed, "gains"), "gains")); });
  };
  EXPECT_EQ(complaint("mass: 5.15", "mass: 0"), "gains: mass = 0: must be greater than 0");
  EXPECT_EQ(complaint("min_thrust: 0", "min_thrust: 1"),
            "gains: actuators.rear.min_thrust = 1: must be 0 or less");
  EXPECT_EQ(complaint("response_time: [", "response_times: ["),
            "gains: response_times = [0.1, 0.1, 0.1]: unknown key; known here: mass, yaw_inertia, "
            "center_x, center_y, linear_drag, quadratic_drag, actuators, response_time, "
            "proportional, integral");
  EXPECT_EQ(complaint("mass: 5.15\n", ""), "gains: mass: the key is missing");
}

}  // namespace
}  // namespace hovercraft
