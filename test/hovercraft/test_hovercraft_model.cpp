#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/hovercraft/step_inputs.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

#include "../support/numbers.h"
#include "../support/skew_engines.h"

namespace hovercraft {
namespace {

constexpr double kMass = 2.0;  // kg

using testing::Engines;
using testing::kRounding;
using testing::skewEngines;

Mobility generalMobility() {
  Matrix3 inertia;
  inertia << 0.05, 0.004, -0.006,  //
      0.004, 0.08, 0.003,          //
      -0.006, 0.003, 0.1;
  return Mobility::spatial(kMass, inertia);
}

const Environment kStillAir;

HovercraftModel craft(const Mobility& mobility) {
  return {mobility, EngineGeometry(skewEngines(), Vector3::Zero()), Drag(), Vector3::Zero()};
}

const Quaternion& someAttitude() {
  static const Quaternion q_WB = quaternionFromRpy({0.3, -0.4, 2.0});
  return q_WB;
}

RigidBodyState<Quaternion> moving(const HovercraftModel& model, const Vector3& v_WB,
                                  const Vector3& w_WB) {
  return model.mobility.stateOfMotion(Vector3(Vector3::Zero()), someAttitude(), {v_WB, w_WB});
}

// Errata 18: moment and force are both computed in B and both rotated into W.
TEST(HovercraftModel, ThrustsActInBodyAxesWithForceAndMoment) {
  const HovercraftModel model = craft(generalMobility());
  const Vector3 thrusts(4.0, 1.0, 2.0);
  const auto rate =
      model.derivative(moving(model, Vector3::Zero(), Vector3::Zero()), thrusts, kStillAir);
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
  const Engines engines = skewEngines();
  for (int i = 0; i < kEngineCount; ++i) {
    const EngineParameters& engine = engines[static_cast<std::size_t>(i)];
    const Vector3 f_B = thrusts[i] * engine.direction;
    force += rotate(someAttitude(), f_B);
    torque += rotate(someAttitude(), cross(engine.p_HE, f_B));
  }
  EXPECT_LT(norm(rate.force_W - force), 10.0 * kRounding);
  EXPECT_LT(norm(rate.torque_W - torque), 10.0 * kRounding);
}

// (24): dx/dt = v and dq/dt = ½ [0, w] q of the body as it moves.
TEST(HovercraftModel, VelocitiesAreThoseOfTheMomenta) {
  const HovercraftModel model = craft(generalMobility());
  const Vector3 v_WB(1.0, -2.0, 3.0);
  const Vector3 w_WB(0.5, 0.7, -1.1);
  const auto rate = model.derivative(moving(model, v_WB, w_WB), {0.0, 0.0, 0.0}, kStillAir);
  EXPECT_LT(norm(rate.v_WB - v_WB), 10.0 * kRounding);
  const Quaternion expected = quaternionRateWorld(w_WB, someAttitude());
  EXPECT_LT(norm(rate.orientation_rate + (-1.0) * expected), 10.0 * kRounding);
  EXPECT_EQ(rate.force_W, Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(rate.torque_W, Vector3(0.0, 0.0, 0.0));
}

// Drag takes components along the axes of B: with a coefficient on the y axis of B alone, only the
// part of the velocity along that axis is braked.
TEST(HovercraftModel, DragActsAlongBodyAxes) {
  HovercraftModel model = craft(generalMobility());
  model.drag.linear = {0.0, 3.0, 0.0};
  model.drag.angular_linear = {0.0, 0.0, 0.2};
  const Vector3 v_WB(1.0, -2.0, 0.5);
  const Vector3 w_WB(0.5, 0.7, -1.1);
  const auto rate = model.derivative(moving(model, v_WB, w_WB), {0.0, 0.0, 0.0}, kStillAir);
  const Vector3 y_W = rotate(someAttitude(), Vector3::UnitY());
  const Vector3 z_W = rotate(someAttitude(), Vector3::UnitZ());
  EXPECT_LT(norm(rate.force_W - (-3.0 * dot(v_WB, y_W)) * y_W), 20.0 * kRounding);
  EXPECT_LT(norm(rate.torque_W - (-0.2 * dot(w_WB, z_W)) * z_W), 20.0 * kRounding);
}

TEST(HovercraftModel, TheShorterDerivativeHasTheSameBits) {
  HovercraftModel model = craft(generalMobility());
  model.drag.linear = {0.8, 1.2, 1.6};
  model.drag.quadratic = {0.4, 0.9, 1.1};
  model.drag.angular_linear = {0.12, 0.13, 0.14};
  model.drag.angular_quadratic = {0.05, 0.06, 0.07};
  model.weight_W = Vector3(0.0, 0.0, -19.6);
  const Environment windy = {{1.0, -2.0, 0.5}};
  const ActuatorArray<double> thrusts = {4.0, 1.0, 2.0};
  const auto state = moving(model, Vector3(3.0, -1.0, 0.5), Vector3(0.2, 0.7, -1.1));
  const auto whole = model.derivative(state, thrusts, windy);
  const auto shorter = model.derivativeOfEngines(state, model.wrenchOfEngines(thrusts), windy);
  EXPECT_EQ(shorter.v_WB, whole.v_WB);
  EXPECT_EQ(shorter.force_W, whole.force_W);
  EXPECT_EQ(shorter.torque_W, whole.torque_W);
  EXPECT_EQ(shorter.orientation_rate.s, whole.orientation_rate.s);
  EXPECT_EQ(shorter.orientation_rate.v, whole.orientation_rate.v);
}

TEST(HovercraftModel, CraftThatDriftsWithTheAirFeelsNoDrag) {
  HovercraftModel model = craft(generalMobility());
  model.drag.linear = {1.0, 2.0, 3.0};
  model.drag.quadratic = {4.0, 5.0, 6.0};
  const Environment windy = {{3.0, -1.0, 0.5}};
  const auto drifting =
      model.derivative(moving(model, windy.wind_W, Vector3::Zero()), {0, 0, 0}, windy);
  EXPECT_LT(norm(drifting.force_W), 20.0 * kRounding);
  const auto resting =
      model.derivative(moving(model, Vector3::Zero(), Vector3::Zero()), {0, 0, 0}, windy);
  EXPECT_GT(dot(resting.force_W, windy.wind_W), 1.0);
}

TEST(HovercraftModel, WeightActsInTheWorldAndAPlanarCraftDoesNotFeelIt) {
  HovercraftModel spatial = craft(generalMobility());
  spatial.weight_W = {0.0, 0.0, -19.62};
  const auto falling =
      spatial.derivative(moving(spatial, Vector3::Zero(), Vector3::Zero()), {0, 0, 0}, kStillAir);
  EXPECT_EQ(falling.force_W, spatial.weight_W);
  EXPECT_EQ(falling.torque_W, Vector3(0.0, 0.0, 0.0));
  HovercraftModel planar = craft(Mobility::planar(kMass, Matrix3::Identity()));
  planar.weight_W = spatial.weight_W;
  const RigidBodyState<Quaternion> rest;
  EXPECT_EQ(planar.derivative(rest, {0, 0, 0}, kStillAir).force_W, Vector3(0.0, 0.0, 0.0));
}

// ---- measured order with lagging engines --------------------------------------------------------

constexpr std::array<Integrator, 4> kIntegrators = {Integrator::kEuler,
                                                    Integrator::kSemiImplicitEuler,
                                                    Integrator::kHeun, Integrator::kRungeKutta4};
constexpr std::array<int, 4> kOrders = {1, 1, 2, 4};

/// A quarter of a second of a craft whose engines spin up with lags of 0.1, 0.2 and 0.4 s, with
/// every drag term. No component of a velocity in B changes its sign, where |u| u would not be
/// smooth.
RigidBodyState<Quaternion> spinUp(Integrator integrator, int steps) {
  Engines engines = skewEngines();
  engines[0].time_constant = 0.1;
  engines[1].time_constant = 0.2;
  engines[2].time_constant = 0.4;
  const std::int64_t step_ns = kNanosecondsPerSecond / 4 / steps;
  HovercraftModel model = craft(generalMobility());
  model.drag.linear = {0.8, 1.2, 1.0};
  model.drag.quadratic = {0.4, 0.9, 0.7};
  model.drag.angular_linear = {0.05, 0.06, 0.07};
  model.drag.angular_quadratic = {0.02, 0.03, 0.04};
  const Environment environment = {{-6.0, 5.0, 4.0}};
  const EngineDynamics dynamics(engines, step_ns);
  EngineStates states;
  states[0].commanded = 4.0;
  states[1].commanded = 0.2;
  states[2].commanded = 1.0;
  RigidBodyState<Quaternion> body = moving(model, {1.0, 0.5, -0.3}, {0.6, 1.0, 0.8});
  for (Tick tick = 0; tick < steps; ++tick) {
    const ThrustCourse thrusts = dynamics.course(states, tick);
    const DrivenBody system = {model, thrusts, environment};
    body = integrationStep(integrator, body, system, toSeconds(step_ns));
    for (std::size_t i = 0; i < kEngineCount; ++i) {
      states[i].thrust = thrusts.end[i];
    }
  }
  return body;
}

double distance(const RigidBodyState<Quaternion>& a, const RigidBodyState<Quaternion>& b) {
  const double angle = angleBetween(a.orientation, b.orientation);
  return std::sqrt(squaredNorm(a.p_WB - b.p_WB) + squaredNorm(a.momentum_W - b.momentum_W) +
                   squaredNorm(a.angular_momentum_W - b.angular_momentum_W) + angle * angle);
}

// Each stage sees the thrust at its own time: the order survives. Reference: RK4 with steps 50
// times shorter than those of its finer run.
TEST(DrivenBody, EveryIntegratorKeepsItsOrderWithLaggingEngines) {
  const auto reference = spinUp(Integrator::kRungeKutta4, 2000);
  constexpr std::array<int, 4> steps = {2000, 2000, 500, 20};
  for (std::size_t i = 0; i < kIntegrators.size(); ++i) {
    const double coarse = distance(spinUp(kIntegrators[i], steps[i]), reference);
    const double fine = distance(spinUp(kIntegrators[i], 2 * steps[i]), reference);
    const double measured = std::log2(coarse / fine);
    EXPECT_NEAR(measured, kOrders[i], 0.1) << "integrator " << i;
    RecordProperty("order_" + std::to_string(i), std::to_string(measured));
  }
}

// ---- closed forms of whole craft ----------------------------------------------------------------

/// The shipped craft of the Caltech testbed, with its engines' commands renewed ten times a second.
Simulation mvwtAfter(double seconds, const Vector3& thrusts) {
  Simulation simulation(loadScenario("config/mvwt.yaml"));
  const auto ticks = static_cast<Tick>(std::llround(seconds / simulation.scenario().stepSize()));
  while (simulation.tick() < ticks) {
    if (simulation.tick() % 100 == 0) {
      simulation.push({simulation.tick(), 0, kAllEngines, thrusts});
    }
    simulation.step();
  }
  return simulation;
}

// m u' = 2 · 4.5 N - 4.5 N s/m · u: u = 2.0 m/s (1 - e^(-t/τ)), τ = 5.15 kg / 4.5 N s/m = 1.1444 s,
// published as 1.144: at its steepest, u' = u_inf/τ, that rounding is 1e-3 m/s.
TEST(Mvwt, BothEnginesFullDriveItStraightToTwoMetresPerSecond) {
  for (const double t : {0.1, 0.5, 1.144, 3.0, 8.0}) {
    const Motion motion = mvwtAfter(t, {0.0, 4.5, 4.5}).motion(0);
    const double tau = 5.15 / 4.5;
    EXPECT_NEAR(motion.twist.v_WB.x(), 2.0 * (1.0 - std::exp(-t / tau)), 1e-12) << t;
    EXPECT_NEAR(motion.twist.v_WB.x(), 2.0 * (1.0 - std::exp(-t / 1.144)), 1e-3) << t;
    // x = ∫ u dt
    EXPECT_NEAR(motion.p_WB.x(), 2.0 * (t - tau * (1.0 - std::exp(-t / tau))), 1e-11) << t;
    EXPECT_EQ(motion.p_WB.y(), 0.0) << t;
    EXPECT_EQ(motion.twist.w_WB.z(), 0.0) << t;
  }
}

// Izz w' = 0.123 m · 4.5 N - 0.41 N m s · w: w = 1.35 rad/s (1 - e^(-t/τ)), τ = 0.047/0.41 =
// 0.1146 s. The right engine turns it to the left.
TEST(Mvwt, OneEngineFullTurnsItWith135RadiansPerSecond) {
  const double rate = 0.123 * 4.5 / 0.41;
  EXPECT_NEAR(rate, 1.35, 1e-12);
  const double tau = 0.047 / 0.41;
  EXPECT_NEAR(tau, 0.115, 0.5e-3);
  for (const double t : {0.05, 0.115, 0.5, 2.0}) {
    const double expected = rate * (1.0 - std::exp(-t / tau));
    const Motion to_left = mvwtAfter(t, {0.0, 0.0, 4.5}).motion(0);
    const Motion to_right = mvwtAfter(t, {0.0, 4.5, 0.0}).motion(0);
    EXPECT_NEAR(to_left.twist.w_WB.z(), expected, 1e-9) << t;
    EXPECT_NEAR(to_right.twist.w_WB.z(), -expected, 1e-9) << t;
  }
}

/// A craft of 2 kg that only moves along x, in RK4 at 1 ms.
Scenario sledge() {
  Scenario scenario;
  scenario.step_ns = 1000000;
  scenario.integrator = Integrator::kRungeKutta4;
  VehicleScenario vehicle;
  vehicle.name = "sledge";
  vehicle.mass_properties.mass = kMass;
  vehicle.mass_properties.I_BBo_B = Matrix3::Identity();
  for (EngineParameters& engine : vehicle.engines) engine.max_thrust = 10.0;
  scenario.vehicles.push_back(vehicle);
  return scenario;
}

Motion after(double seconds, const Scenario& scenario, double rear_thrust) {
  Simulation simulation(scenario);
  simulation.push({0, 0, kAllEngines, {rear_thrust, 0.0, 0.0}});
  const auto ticks = static_cast<Tick>(std::llround(seconds * 1000.0));
  while (simulation.tick() < ticks) simulation.step();
  return simulation.motion(0);
}

// m v' = F - c v²: v = sqrt(F/c) tanh(t sqrt(F c)/m), F = 4.5 N, c = 0.5 N s²/m²: 3 m/s at most.
TEST(Hovercraft, QuadraticDragGivesATanh) {
  Scenario scenario = sledge();
  scenario.vehicles[0].drag.quadratic = {0.5, 0.0, 0.0};
  for (const double t : {0.2, 1.0, 3.0}) {
    const double expected = 3.0 * std::tanh(t * std::sqrt(4.5 * 0.5) / kMass);
    EXPECT_NEAR(after(t, scenario, 4.5).twist.v_WB.x(), expected, 1e-12) << t;
  }
}

// m v' = c (wind - v): at rest at first, then v = wind (1 - e^(-t c/m)), the wind's speed in the
// end.
TEST(Hovercraft, UnpoweredCraftDriftsAwayWithTheWind) {
  Scenario scenario = sledge();
  scenario.vehicles[0].drag.linear = {4.0, 4.0, 0.0};
  scenario.wind = {1.5, -0.5, 0.0};
  for (const double t : {0.1, 0.5, 2.0}) {
    const Vector3 expected = (1.0 - std::exp(-t * 4.0 / kMass)) * scenario.wind;
    EXPECT_LT(norm(after(t, scenario, 0.0).twist.v_WB - expected), 1e-12) << t;
  }
  EXPECT_LT(norm(after(20.0, scenario, 0.0).twist.v_WB - scenario.wind), 1e-12);
}

// T' = (F - T)/τ from T = 0 and m v' = T: v = F/m (t - τ (1 - e^(-t/τ))).
TEST(Hovercraft, LaggingEngineDelaysTheCraftByItsTimeConstant) {
  Scenario scenario = sledge();
  const double tau = 0.25;
  scenario.vehicles[0].engines[0].time_constant = tau;
  for (const double t : {0.1, 0.5, 2.0}) {
    const double expected = 6.0 / kMass * (t - tau * (1.0 - std::exp(-t / tau)));
    EXPECT_NEAR(after(t, scenario, 6.0).twist.v_WB.x(), expected, 1e-11) << t;
  }
}

}  // namespace
}  // namespace hovercraft
