#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/hovercraft/rotors.h"
#include "hovercraft_sim/hovercraft/step_inputs.h"
#include "hovercraft_sim/math/constants.h"

#include "../support/numbers.h"
#include "../support/skew_engines.h"

namespace hovercraft {
namespace {

using testing::kRounding;

constexpr double kRotorStep = 1e-3;
constexpr std::int64_t kRotorStepNs = 1000000;
constexpr Integrator kMethods[] = {Integrator::kEuler, Integrator::kSemiImplicitEuler,
                                   Integrator::kHeun, Integrator::kRungeKutta4, Integrator::kLie4};

/// Nothing acts on it.
HovercraftModel freeCraft(const Mobility& mobility, std::vector<Rotor> rotors) {
  HovercraftModel model{mobility, EngineGeometry({}, Vector3::Zero()), Drag(), Vector3::Zero(), {}};
  model.rotors = std::move(rotors);
  return model;
}

Rotor rotorOf(std::size_t id, double scale, const Vector3& axis) {
  return {id, false, scale, std::abs(scale), axis};
}

/// Levels that follow commands with a lag of 0.2 s.
struct LaggingActuators {
  explicit LaggingActuators(std::size_t count) : dynamics(parametersOf(count), kRotorStepNs) {
    states.resize(count);
  }
  static ActuatorArray<EngineParameters> parametersOf(std::size_t count) {
    ActuatorArray<EngineParameters> parameters;
    parameters.resize(count);
    for (EngineParameters& one : parameters) {
      one.min_thrust = -100.0;
      one.max_thrust = 100.0;
      one.time_constant = 0.2;
    }
    return parameters;
  }
  ThrustCourse next() {
    const ThrustCourse course = dynamics.course(states, tick++);
    for (std::size_t i = 0; i < states.size(); ++i) states[i].thrust = course.end[i];
    return course;
  }

  EngineDynamics dynamics;
  EngineStates states;
  Tick tick = 0;
};

TEST(Rotor, OfAThrustTurnsWithItsSquareRoot) {
  Rotor rotor;
  rotor.by_square_root = true;
  rotor.scale = 3.0;
  EXPECT_EQ(rotor.angularMomentum(4.0), 6.0);
  EXPECT_EQ(rotor.angularMomentum(-4.0), -6.0);
  EXPECT_EQ(rotor.angularMomentum(0.0), 0.0);
}

// (32): L = I w + J Omega stays 0, so the yaw rate is -J Omega/I_zz at each moment.
TEST(Rotors, SpinningUpTurnsAFreeCraftTheOtherWay) {
  const Matrix3 I = Vector3(0.03, 0.04, 0.05).asDiagonal();
  for (const Mobility& mobility : {Mobility::planar(2.0, I), Mobility::spatial(2.0, I)}) {
    const HovercraftModel model = freeCraft(mobility, {rotorOf(3, 4e-5, Vector3::UnitZ())});
    for (const Integrator integrator : kMethods) {
      LaggingActuators actuators(4);
      actuators.states[3] = {90.0, 0.0, 0};
      RigidBodyState<Quaternion> body;
      body.orientation = Quaternion{1.0, Vector3::Zero()};
      double angle = 0.0;
      for (int n = 0; n < 500; ++n) {
        const ThrustCourse course = actuators.next();
        body = integrationStep(integrator, body, DrivenBody{model, course, {}}, kRotorStep);
        const double expected = -(4e-5 * course.end[3]) / 0.05;
        ASSERT_DOUBLE_EQ(model.twist(body, course.end).w_WB.z(), expected);
        angle += 0.5 * kRotorStep * expected;
        ASSERT_EQ(norm(body.angular_momentum_W), 0.0);
      }
      EXPECT_LT(model.twist(body, actuators.next().end).w_WB.z(), -0.06);
      EXPECT_LT(body.orientation.v.z(), 0.9 * angle);  // it has turned that far: negative both
    }
  }
}

TEST(Rotors, KeepTheMomentumOfAFreeCraftToTheLastBit) {
  Matrix3 I;
  I << 0.03, 0.001, -0.002, 0.001, 0.04, 0.003, -0.002, 0.003, 0.05;
  const HovercraftModel model =
      freeCraft(Mobility::spatial(2.0, I),
                {rotorOf(3, 4e-5, Vector3::UnitZ()), rotorOf(4, -3e-5, Vector3(0.6, 0.0, 0.8)),
                 Rotor{5, true, 1e-3, 1e-2, Vector3(0.0, -0.6, 0.8)}});
  for (const Integrator integrator : kMethods) {
    LaggingActuators actuators(6);
    actuators.states[3] = {90.0, 0.0, 0};
    actuators.states[4] = {-70.0, 20.0, 0};
    actuators.states[5] = {60.0, -10.0, 0};
    auto body = model.mobility.stateOfMotion(Vector3::Zero(), Quaternion{1.0, Vector3::Zero()},
                                             {{1.0, 2.0, 3.0}, {0.3, -0.4, 0.5}});
    const auto start = body;
    for (int n = 0; n < 1000; ++n) {
      const ThrustCourse course = actuators.next();
      body = integrationStep(integrator, body, DrivenBody{model, course, {}}, kRotorStep);
    }
    EXPECT_EQ(body.angular_momentum_W, start.angular_momentum_W);
    EXPECT_EQ(body.momentum_W, start.momentum_W);
    EXPECT_GT(std::abs(body.orientation.v.x()), 1e-3);
  }
}

// Euler's equations with H along z, linear about w = 0: I_xx w_x' = -H w_y, I_yy w_y' = H w_x. So
// (w_x, w_y) goes round with H/sqrt(I_xx I_yy), and a quarter later w_y = w_x0 sqrt(I_xx/I_yy).
TEST(Rotors, ACraftNutatesWithTheRateOfTheHeavyTop) {
  constexpr double kXx = 0.03;
  constexpr double kYy = 0.04;
  constexpr double kMomentum = 0.5;  // N m s
  const HovercraftModel model =
      freeCraft(Mobility::spatial(2.0, Vector3(kXx, kYy, 0.05).asDiagonal()),
                {rotorOf(3, 0.01, Vector3::UnitZ())});
  ThrustCourse course;
  course.start = course.middle = course.end = {0.0, 0.0, 0.0, 50.0};
  constexpr double kPush = 1e-5;  // rad/s
  auto body = model.mobility.stateOfMotion(Vector3::Zero(), Quaternion{1.0, Vector3::Zero()},
                                           {Vector3::Zero(), {kPush, 0.0, 0.0}},
                                           rotorMomentum(model.rotors, course.start));
  const auto rate_now = [&] {
    const Matrix3 R_WB = rotationMatrix(body.orientation);
    return model.angularVelocityInBody(body.angular_momentum_W, R_WB, course.end);
  };
  const double period = 2.0 * kPi * std::sqrt(kXx * kYy) / kMomentum;
  const int steps = 4000;
  for (int n = 0; n < steps; ++n) {
    if (n == steps / 4) {
      EXPECT_NEAR(rate_now().x() / kPush, 0.0, 1e-6);
      EXPECT_NEAR(rate_now().y() / kPush, std::sqrt(kXx / kYy), 1e-6);
    }
    if (n == steps / 2) {
      EXPECT_NEAR(rate_now().x() / kPush, -1.0, 1e-6);
    }
    body = integrationStep(Integrator::kRungeKutta4, body, DrivenBody{model, course, {}},
                           period / steps);
  }
  EXPECT_NEAR(rate_now().x() / kPush, 1.0, 1e-6);
  EXPECT_NEAR(rate_now().y() / kPush, 0.0, 1e-6);
  EXPECT_NEAR(rate_now().z() / kPush, 0.0, 1e-3);
}

RigidBodyState<Quaternion> flownWithRotors(Integrator integrator, int steps) {
  const std::int64_t step_ns = 400000000 / steps;
  ActuatorArray<EngineParameters> parameters = LaggingActuators::parametersOf(5);
  const EngineDynamics dynamics(parameters, step_ns);
  EngineStates states;
  states.resize(5);
  states[3] = {90.0, 10.0, 0};
  states[4] = {-70.0, 30.0, 0};
  const HovercraftModel model =
      freeCraft(Mobility::spatial(2.0, Vector3(0.03, 0.04, 0.05).asDiagonal()),
                {rotorOf(3, 4e-4, Vector3::UnitZ()), rotorOf(4, 3e-4, Vector3(0.6, 0.0, 0.8))});
  auto body = model.mobility.stateOfMotion(Vector3::Zero(), Quaternion{1.0, Vector3::Zero()},
                                           {Vector3::Zero(), {0.5, 0.7, 0.3}},
                                           rotorMomentum(model.rotors, levelsOf(states)));
  for (Tick tick = 0; tick < steps; ++tick) {
    const ThrustCourse course = dynamics.course(states, tick);
    body = integrationStep(integrator, body, DrivenBody{model, course, {}}, toSeconds(step_ns));
    for (std::size_t i = 0; i < states.size(); ++i) states[i].thrust = course.end[i];
  }
  return body;
}

// The angular velocity sees the rotors of its stage.
TEST(Rotors, EveryIntegratorKeepsItsOrderWhileTheySpinUp) {
  const Quaternion reference = flownWithRotors(Integrator::kRungeKutta4, 4000).orientation;
  const auto error = [&](Integrator integrator, int steps) {
    const Quaternion q = flownWithRotors(integrator, steps).orientation;
    return norm(q.v - reference.v) + std::abs(q.s - reference.s);
  };
  const double orders[] = {1.0, 1.0, 2.0, 4.0};
  const int steps[] = {400, 400, 100, 20};
  for (std::size_t i = 0; i < 4; ++i) {
    const double order = std::log2(error(kMethods[i], steps[i]) / error(kMethods[i], 2 * steps[i]));
    EXPECT_NEAR(order, orders[i], 0.15) << i;
  }
}

TEST(Rotors, TheEnergyOfACraftIsThatOfItsHull) {
  const Matrix3 I = Vector3(0.03, 0.04, 0.05).asDiagonal();
  const Mobility mobility = Mobility::spatial(2.0, I);
  const Vector3 rotors_B(0.1, -0.2, 0.3);
  const Twist twist = {{1.0, 2.0, 3.0}, {0.3, -0.4, 0.5}};
  const Quaternion turned = quaternionFromRpy({0.4, 0.5, 0.6});
  const auto with = mobility.stateOfMotion(Vector3(Vector3::Zero()), turned, twist, rotors_B);
  const auto without = mobility.stateOfMotion(Vector3(Vector3::Zero()), turned, twist);
  EXPECT_NEAR(kineticEnergy(with, mobility, rotors_B), kineticEnergy(without, mobility),
              10.0 * kRounding);
  EXPECT_LT(norm(mobility.twist(with, rotors_B).w_WB - twist.w_WB), 10.0 * kRounding);
}

}  // namespace
}  // namespace hovercraft
