#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/hovercraft/step_inputs.h"

#include "../support/numbers.h"
#include "../support/skew_engines.h"

namespace hovercraft {
namespace {

using testing::kRounding;

constexpr double kDensity = 1.2;

struct Situation {
  ActuatorArray<double> levels;
  Vector3 u_B = Vector3::Zero();
  Vector3 w_WB_B = Vector3::Zero();

  ForceInputs inputs() const { return {levels, u_B, w_WB_B}; }
};

Situation withLevels(std::initializer_list<double> levels) {
  Situation situation;
  situation.levels = levels;
  return situation;
}

// ---- fan: T = T0 max(0, 1 - V/V0) ---------------------------------------------------------------

TEST(FanForce, ActsAtItsPlaceAlongItsDirection) {
  FanForce fan;
  fan.id = 3;
  fan.place = {{-0.2, 0.3, 0.1}, {0.6, 0.0, 0.8}};
  Situation situation = withLevels({9.0, 9.0, 9.0, 2.0});
  situation.u_B = {5.0, 1.0, 2.0};
  const Wrench wrench = fan.wrench(situation.inputs());
  EXPECT_LT(norm(wrench.force - Vector3(1.2, 0.0, 1.6)), kRounding);
  // r x F = (0.3 1.6 - 0.1 0, 0.1 1.2 + 0.2 1.6, 0 - 0.3 1.2)
  EXPECT_LT(norm(wrench.torque - Vector3(0.48, 0.44, -0.36)), kRounding);
}

TEST(FanForce, FallsWithTheSpeedOfTheAirIntoItsDisc) {
  FanForce fan;
  fan.id = 3;
  fan.inverse_free_speed = 1.0 / 20.0;
  const auto thrust = [&fan](double at_rest, double speed) {
    Situation situation = withLevels({0.0, 0.0, 0.0, at_rest});
    situation.u_B.x() = speed;
    return fan.thrust(situation.inputs());
  };
  EXPECT_EQ(thrust(4.0, 0.0), 4.0);
  EXPECT_NEAR(thrust(4.0, 5.0), 3.0, kRounding);
  EXPECT_EQ(thrust(4.0, 20.0), 0.0);
  EXPECT_EQ(thrust(4.0, 30.0), 0.0);
  EXPECT_NEAR(thrust(4.0, -5.0), 5.0, kRounding);
  EXPECT_NEAR(thrust(-4.0, -5.0), -3.0, kRounding);
  EXPECT_EQ(thrust(-4.0, -30.0), 0.0);
}

// A fan at r sees u + w x r: turning at 2 rad/s, one 0.5 m to the left moves backwards by 1 m/s.
TEST(FanForce, SeesTheAirOfItsOwnPlace) {
  FanForce fan;
  fan.id = 3;
  fan.place.p_BE = {0.0, 0.5, 0.0};
  fan.inverse_free_speed = 0.1;
  Situation situation = withLevels({0.0, 0.0, 0.0, 1.0});
  situation.w_WB_B = {0.0, 0.0, 2.0};
  EXPECT_NEAR(fan.thrust(situation.inputs()), 1.1, kRounding);
}

// ---- propeller: T = rho n^2 D^4 kT(J), Q = rho n^2 D^5 kQ(J), J = V/(n D) -----------------------

constexpr double kDiameter = 0.3;

PropellerForce propeller() {
  PropellerForce force;
  force.id = 3;
  force.diameter = kDiameter;
  force.thrust_scale = kDensity * std::pow(kDiameter, 4);
  force.torque_scale = kDensity * std::pow(kDiameter, 5);
  force.thrust_coefficients = {0.11, -0.06, -0.05};
  force.torque_coefficients = {0.006, 0.001, -0.004};
  return force;
}

Situation flying(double n, double speed) {
  Situation situation = withLevels({0.0, 0.0, 0.0, n});
  situation.u_B.x() = speed;
  return situation;
}

TEST(PropellerForce, IsThatOfItsAdvanceRatio) {
  for (const double n : {20.0, 55.0, 130.0}) {
    for (const double speed : {0.0, 2.0, 9.0}) {
      const double J = speed / (n * kDiameter);
      const double kT = 0.11 - 0.06 * J - 0.05 * J * J;
      const double kQ = 0.006 + 0.001 * J - 0.004 * J * J;
      const Wrench wrench = propeller().wrench(flying(n, speed).inputs());
      const double T = kDensity * n * n * std::pow(kDiameter, 4) * kT;
      EXPECT_NEAR(wrench.force.x(), T, 1e-12) << n << " " << speed;
      const double Q = kDensity * n * n * std::pow(kDiameter, 5) * kQ;
      EXPECT_NEAR(wrench.torque.x(), -Q, 1e-12) << n << " " << speed;
    }
  }
}

TEST(PropellerForce, ThatStandsIsADragInTheWind) {
  const double speed = 7.0;
  const double expected = kDensity * kDiameter * kDiameter * -0.05 * speed * speed;
  EXPECT_NEAR(propeller().thrust(flying(0.0, speed).inputs()), expected, 1e-12);
  EXPECT_NEAR(propeller().thrust(flying(0.0, -speed).inputs()), -expected, 1e-12);
}

TEST(PropellerForce, BackwardsOnTheSpotItPushesBackAndTurnsTheHullTheOtherWay) {
  const Wrench ahead = propeller().wrench(flying(50.0, 0.0).inputs());
  const Wrench astern = propeller().wrench(flying(-50.0, 0.0).inputs());
  EXPECT_GT(ahead.force.x(), 0.0);
  EXPECT_EQ(astern.force.x(), -ahead.force.x());
  EXPECT_EQ(astern.torque.x(), -ahead.torque.x());
}

// ---- rudder -------------------------------------------------------------------------------------

constexpr double kDisc = 0.07;  // m²
constexpr double kArea = 0.02;  // m²
constexpr double kSlope = 3.0;  // 1/rad

RudderForce rudder() {
  RudderForce force;
  force.id = 4;
  force.place.p_BE = {-0.4, 0.0, 0.0};
  force.half_density_area = 0.5 * kDensity * kArea;
  force.lift_slope = kSlope;
  force.drag_at_rest = 0.01;
  force.drag_growth = 1.4;
  force.inverse_density_disc = 1.0 / (kDensity * kDisc);
  FanForce fan;
  fan.id = 3;
  force.fan = fan;
  return force;
}

Situation steering(double thrust, double delta, double speed) {
  Situation situation = withLevels({0.0, 0.0, 0.0, thrust, delta});
  situation.u_B.x() = speed;
  return situation;
}

// On the spot V_d^2 = T/(rho A): q = T/(2 A), whatever the density.
TEST(RudderForce, OnTheSpotItHasTheStreamOfItsFan) {
  const double q = 3.0 / (2.0 * kDisc);
  const Wrench wrench = rudder().wrench(steering(3.0, 0.2, 0.0).inputs());
  EXPECT_NEAR(wrench.force.y(), q * kArea * kSlope * 0.2, 1e-12);
  EXPECT_NEAR(wrench.force.x(), -q * kArea * (0.01 + 1.4 * 0.04), 1e-12);
  // Aft of the centre: to the left at the stern turns the bow to the right.
  EXPECT_NEAR(wrench.torque.z(), -0.4 * wrench.force.y(), 1e-12);
}

// Without thrust V_d = V; the far wake of momentum theory: V_d (V_d - V) = T/(rho A).
TEST(RudderForce, TheStreamIsThatOfMomentumTheory) {
  const double delta = 0.1;
  const auto stream_speed = [&](double thrust, double speed) {
    const double lift = rudder().wrench(steering(thrust, delta, speed).inputs()).force.y();
    return std::sqrt(lift / (0.5 * kDensity * kArea * kSlope * delta));
  };
  EXPECT_NEAR(stream_speed(0.0, 6.0), 6.0, 1e-12);
  for (const double speed : {0.0, 1.0, 8.0, -2.0}) {
    const double v = stream_speed(5.0, speed);
    EXPECT_NEAR(v * (v - speed), 5.0 / (kDensity * kDisc), 1e-10) << speed;
  }
  EXPECT_EQ(rudder().wrench(steering(0.0, delta, -3.0).inputs()).force.y(), 0.0);
  EXPECT_NEAR(stream_speed(-5.0, 6.0), 6.0, 1e-12);  // a fan that blows forwards gives no stream
}

TEST(RudderForce, MirroredAnglesGiveMirroredForces) {
  const Wrench left = rudder().wrench(steering(3.0, 0.3, 4.0).inputs());
  const Wrench right = rudder().wrench(steering(3.0, -0.3, 4.0).inputs());
  EXPECT_EQ(left.force.x(), right.force.x());
  EXPECT_EQ(left.force.y(), -right.force.y());
  EXPECT_EQ(left.torque.z(), -right.torque.z());
}

TEST(RudderForce, WithoutAFanItHasTheAirThatTheCraftMeets) {
  RudderForce alone = rudder();
  alone.fan = std::monostate();
  const Wrench wrench = alone.wrench(steering(3.0, 0.2, 5.0).inputs());
  EXPECT_NEAR(wrench.force.y(), 0.5 * kDensity * 25.0 * kArea * kSlope * 0.2, 1e-12);
}

// ---- measured order -----------------------------------------------------------------------------

RigidBodyState<Quaternion> flown(Integrator integrator, int steps) {
  constexpr std::int64_t kDurationNs = 400000000;
  const std::int64_t step_ns = kDurationNs / steps;
  ActuatorArray<EngineParameters> parameters(testing::skewEngines());
  EngineParameters lagging;
  lagging.min_thrust = -200.0;
  lagging.max_thrust = 200.0;
  lagging.time_constant = 0.15;
  for (int i = 0; i < 3; ++i) parameters.append(lagging);
  const EngineDynamics dynamics(parameters, step_ns);
  EngineStates states;
  states.resize(parameters.size());
  states[3].commanded = 4.0;
  states[4].commanded = 0.4;
  states[5].commanded = 90.0;
  Matrix3 inertia;
  inertia << 0.02, 0.001, -0.002, 0.001, 0.03, 0.0015, -0.002, 0.0015, 0.04;
  HovercraftModel model = {Mobility::spatial(2.0, inertia),
                           EngineGeometry(testing::skewEngines(), Vector3::Zero()),
                           Drag(),
                           Vector3::Zero(),
                           {}};
  FanForce fan;
  fan.id = 3;
  fan.place.p_BE = {-0.1, 0.05, 0.02};
  fan.inverse_free_speed = 0.02;
  RudderForce steered = rudder();
  steered.fan = fan;
  PropellerForce screw = propeller();
  screw.id = 5;
  screw.place.p_BE = {-0.1, -0.05, 0.02};
  model.forces = {fan, steered, screw};
  const Environment still;
  auto body = model.mobility.stateOfMotion(Vector3::Zero(), Quaternion{1.0, Vector3::Zero()},
                                           {{3.0, 0.2, 0.1}, {0.2, 0.3, 0.5}});
  for (Tick tick = 0; tick < steps; ++tick) {
    const ThrustCourse course = dynamics.course(states, tick);
    body = integrationStep(integrator, body, DrivenBody{model, course, still}, toSeconds(step_ns));
    for (std::size_t i = 0; i < states.size(); ++i) states[i].thrust = course.end[i];
  }
  return body;
}

// Each force sees the levels of its stage: the order survives. Reference: RK4 with 50 times shorter
// steps.
TEST(Forces, EveryIntegratorKeepsItsOrder) {
  const auto reference = flown(Integrator::kRungeKutta4, 4000);
  const auto error = [&](Integrator integrator, int steps) {
    const auto body = flown(integrator, steps);
    return norm(body.p_WB - reference.p_WB) +
           norm(body.angular_momentum_W - reference.angular_momentum_W);
  };
  struct Expected {
    Integrator integrator;
    double order;
    int steps;
  };
  for (const Expected& expected :
       {Expected{Integrator::kEuler, 1.0, 400}, Expected{Integrator::kSemiImplicitEuler, 1.0, 400},
        Expected{Integrator::kHeun, 2.0, 200}, Expected{Integrator::kRungeKutta4, 4.0, 40}}) {
    const double order = std::log2(error(expected.integrator, expected.steps) /
                                   error(expected.integrator, 2 * expected.steps));
    EXPECT_NEAR(order, expected.order, 0.15) << static_cast<int>(expected.integrator);
  }
}

// ---- their sum ----------------------------------------------------------------------------------

// Two fans of 3 and 2 N beside and before the centre, and a rudder behind it of rho S/2 = 0.5 kg/m,
// C_la = 2/rad at 0.25 rad in air of 2 m/s: 0.5 2^2 2 0.25 = 1 N to the left, no drag. Forces
// (3, 2, 0) + (0, 1, 0); moments about z: 0.2 3 + 0.4 2 - 0.5 1.
TEST(Forces, OfAllActuatorsAddUpWithTheirMoments) {
  FanForce ahead;
  ahead.id = 3;
  ahead.place = {{0.0, -0.2, 0.0}, {1.0, 0.0, 0.0}};
  FanForce aside;
  aside.id = 4;
  aside.place = {{0.4, 0.0, 0.0}, {0.0, 1.0, 0.0}};
  RudderForce rudder;
  rudder.id = 5;
  rudder.place = {{-0.5, 0.0, 0.0}, {1.0, 0.0, 0.0}};
  rudder.half_density_area = 0.5;
  rudder.lift_slope = 2.0;
  Situation situation = withLevels({0.0, 0.0, 0.0, 3.0, 2.0, 0.25});
  situation.u_B.x() = 2.0;
  const Wrench sum = wrenchInBody({ahead, aside, rudder}, situation.inputs());
  EXPECT_LT(norm(sum.force - Vector3(3.0, 3.0, 0.0)), 4.0 * kRounding);
  EXPECT_LT(norm(sum.torque - Vector3(0.0, 0.0, 0.9)), 4.0 * kRounding);
}

}  // namespace
}  // namespace hovercraft
