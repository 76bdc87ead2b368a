#include <cmath>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/sim/simulation.h"

#include "../support/scenario_text.h"

namespace hovercraft {
namespace {

using testing::kMassByNumbers;
using testing::parsed;
using testing::scenarioOfParts;
using testing::validScenario;
using testing::with;

void expectSameVehicle(const VehicleScenario& a, const VehicleScenario& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.mass_properties.mass, b.mass_properties.mass);
  EXPECT_EQ(a.mass_properties.p_HB, b.mass_properties.p_HB);
  EXPECT_EQ(a.mass_properties.I_BBo_B, b.mass_properties.I_BBo_B);
  for (std::size_t i = 0; i < a.engines.size(); ++i) {
    EXPECT_EQ(a.engines[i].p_HE, b.engines[i].p_HE);
    EXPECT_EQ(a.engines[i].direction, b.engines[i].direction);
    EXPECT_EQ(a.engines[i].min_thrust, b.engines[i].min_thrust);
    EXPECT_EQ(a.engines[i].max_thrust, b.engines[i].max_thrust);
    EXPECT_EQ(a.engines[i].time_constant, b.engines[i].time_constant);
    EXPECT_EQ(a.engines[i].timeout_ns, b.engines[i].timeout_ns);
  }
  EXPECT_EQ(a.drag.linear, b.drag.linear);
  EXPECT_EQ(a.drag.quadratic, b.drag.quadratic);
  EXPECT_EQ(a.drag.angular_linear, b.drag.angular_linear);
  EXPECT_EQ(a.drag.angular_quadratic, b.drag.angular_quadratic);
  EXPECT_EQ(a.initial_p_WB, b.initial_p_WB);
  EXPECT_EQ(a.initial_rpy, b.initial_rpy);
  EXPECT_EQ(a.initial_v_WB, b.initial_v_WB);
  EXPECT_EQ(a.initial_w_WB, b.initial_w_WB);
}

std::uint64_t hashAfterDrivenSteps(const Scenario& scenario) {
  Simulation simulation(scenario);
  for (Tick tick = 0; tick < 100; ++tick) {
    if (tick % 30 == 0) simulation.push({tick, 0, kAllEngines, {3.3, 0.7, 0.1}});
    simulation.step();
  }
  return simulation.hash();
}

void expectRoundTrip(const Scenario& scenario) {
  const Scenario back = parsed(toYaml(scenario));
  EXPECT_EQ(back.step_ns, scenario.step_ns);
  EXPECT_EQ(back.integrator, scenario.integrator);
  EXPECT_EQ(back.orientation, scenario.orientation);
  EXPECT_EQ(back.model, scenario.model);
  EXPECT_EQ(back.gravity, scenario.gravity);
  EXPECT_EQ(back.wind, scenario.wind);
  EXPECT_EQ(back.seed, scenario.seed);
  ASSERT_EQ(back.vehicles.size(), scenario.vehicles.size());
  for (std::size_t i = 0; i < back.vehicles.size(); ++i) {
    expectSameVehicle(back.vehicles[i], scenario.vehicles[i]);
  }
  EXPECT_EQ(hashAfterDrivenSteps(back), hashAfterDrivenSteps(scenario));
  EXPECT_EQ(toYaml(back), toYaml(scenario));
}

using Shape = decltype(PartScenario::shape);

bool haveSameShape(const Shape& a, const Shape& b) {
  if (a.index() != b.index()) return false;
  if (const auto* box = std::get_if<BoxShape>(&a)) return box->size == std::get<BoxShape>(b).size;
  if (const auto* sphere = std::get_if<SphereShape>(&a)) {
    return sphere->radius == std::get<SphereShape>(b).radius;
  }
  if (const auto* rod = std::get_if<CylinderShape>(&a)) {
    const auto& other = std::get<CylinderShape>(b);
    return rod->radius == other.radius && rod->length == other.length;
  }
  const auto& cone = std::get<ConeShape>(a);
  const auto& other = std::get<ConeShape>(b);
  return cone.radius == other.radius && cone.length == other.length;
}

// Mass, centre and tensor would make the same run, but a craft that is drawn and stood on needs its
// solids.
TEST(ScenarioWriter, ACraftOfSolidsStaysACraftOfSolids) {
  const Scenario scenario = parsed(scenarioOfParts());
  const std::string text = toYaml(scenario);
  EXPECT_EQ(text.find("inertia"), std::string::npos);
  EXPECT_EQ(text.find("center_of_mass"), std::string::npos);
  const std::vector<PartScenario> parts = scenario.vehicles[0].parts;
  const std::vector<PartScenario> back = parsed(text).vehicles[0].parts;
  ASSERT_EQ(back.size(), 4U);
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_TRUE(haveSameShape(back[i].shape, parts[i].shape)) << i;
    EXPECT_EQ(back[i].mass, parts[i].mass) << i;
    EXPECT_EQ(back[i].p_HP, parts[i].p_HP) << i;
    EXPECT_EQ(back[i].rpy, parts[i].rpy) << i;
  }
}

TEST(ScenarioWriter, WhatItWritesIsTheSameScenario) {
  expectRoundTrip(parsed(validScenario()));
  expectRoundTrip(parsed(scenarioOfParts()));
  expectRoundTrip(loadScenario("config/hovercraft.yaml"));
  expectRoundTrip(loadScenario("config/mvwt.yaml"));
}

// A mesh is written as its mass, centre and tensor: the text needs no other file.
TEST(ScenarioWriter, MeshesBecomeNumbersToTheLastBit) {
  const Scenario scenario = parsed(with(
      validScenario(), kMassByNumbers,
      "    parts: [{mesh: {file: l_shape.obj}, mass: 2, rpy: [0.3, 0.2, 0.1]}, {sphere: {radius: "
      "0.07}, mass: 0.3, position: [0.1, 0.7, -0.3]}]\n"));
  EXPECT_EQ(toYaml(scenario).find("l_shape"), std::string::npos);
  expectRoundTrip(scenario);
}

double anyNumber(std::mt19937& engine) {
  std::uniform_real_distribution<double> mantissa(-2.0, 2.0);
  std::uniform_int_distribution<int> exponent(-3, 3);
  return std::ldexp(mantissa(engine), exponent(engine));
}
Vector3 anyVector(std::mt19937& engine) {
  return {anyNumber(engine), anyNumber(engine), anyNumber(engine)};
}

// Numbers with all 53 bits, and those at the edges of what a double holds.
TEST(ScenarioWriter, EveryBitOfANumberSurvives) {
  std::mt19937 engine(20261122);
  for (int sample = 0; sample < 50; ++sample) {
    Scenario scenario = parsed(validScenario());
    scenario.step_ns = std::uniform_int_distribution<std::int64_t>(1, 1000000)(engine);
    scenario.gravity = anyVector(engine);
    scenario.wind = anyVector(engine);
    scenario.seed = std::uniform_int_distribution<std::int64_t>()(engine);
    VehicleScenario& vehicle = scenario.vehicles[0];
    vehicle.mass_properties.mass = 20.0 + anyNumber(engine);
    vehicle.mass_properties.p_HB = anyVector(engine);
    for (EngineParameters& thruster : vehicle.engines) {
      thruster.p_HE = anyVector(engine);
      thruster.max_thrust = std::abs(anyNumber(engine));
      thruster.min_thrust = -std::abs(anyNumber(engine));
      thruster.time_constant = std::abs(anyNumber(engine));
      thruster.timeout_ns =
          std::uniform_int_distribution<std::int64_t>(0, 1000000000000000)(engine);
    }
    vehicle.initial_p_WB = {-0.0, 5e-324, 9.9999999999999988e29};
    vehicle.initial_rpy = anyVector(engine);
    vehicle.initial_v_WB = anyVector(engine);
    expectRoundTrip(scenario);
    if (HasFailure()) FAIL() << "sample " << sample << "\n" << toYaml(scenario);
  }
}

TEST(ScenarioWriter, EveryChoiceHasItsWord) {
  Scenario scenario = parsed(with(validScenario(), "rpy: [0.1, 0.2, 0.3]", "rpy: [0, 0, 0.3]"));
  scenario.vehicles[0].initial_v_WB.z() = 0.0;
  scenario.vehicles[0].initial_w_WB = {0.0, 0.0, 0.6};
  for (const auto integrator : {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                Integrator::kHeun, Integrator::kRungeKutta4, Integrator::kLie4}) {
    for (const auto orientation : {OrientationKind::kQuaternion, OrientationKind::kMatrix}) {
      for (const auto model : {BodyModel::kPlanar, BodyModel::kSpatial}) {
        scenario.integrator = integrator;
        scenario.orientation = orientation;
        scenario.model = model;
        expectRoundTrip(scenario);
      }
    }
  }
}

}  // namespace
}  // namespace hovercraft
