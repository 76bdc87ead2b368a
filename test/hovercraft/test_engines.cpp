#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/math/elementary.h"

#include "../support/numbers.h"
#include "../support/skew_engines.h"

namespace hovercraft {
namespace {

constexpr std::int64_t kStepNs = 10000000;  // 10 ms
constexpr int kRear = static_cast<int>(EngineId::kRear);
constexpr int kLeft = static_cast<int>(EngineId::kLeft);

using testing::Engines;
using testing::kRounding;
using testing::skewEngines;

EngineState commanded(double thrust, Tick tick = 0) {
  EngineState state;
  state.commanded = thrust;
  state.command_tick = tick;
  return state;
}

// (33), (34) to (37): what the two matrices give is F_c + F_l + F_p and r_c × F_c + r_l × F_l +
// r_p × F_p, engine by engine and together.
TEST(EngineGeometry, MatricesAreTheSumsOverEngines) {
  const Engines engines = skewEngines();
  const Vector3 p_HB(0.03, -0.02, 0.01);
  const EngineGeometry geometry(engines, p_HB);
  const Vector3 thrusts(4.0, -1.5, 2.25);
  Vector3 force_sum = Vector3::Zero();
  Vector3 torque_sum = Vector3::Zero();
  for (int i = 0; i < kEngineCount; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const EngineParameters& engine = engines[index];
    const Vector3 force = thrusts[i] * engine.direction;
    const Vector3 torque = cross(engine.p_HE - p_HB, force);
    Vector3 alone = Vector3::Zero();
    alone[i] = thrusts[i];
    EXPECT_LT(norm(geometry.wrenchInBody(alone).force - force), kRounding) << kEngineNames[index];
    EXPECT_LT(norm(geometry.wrenchInBody(alone).torque - torque), kRounding) << kEngineNames[index];
    force_sum += force;
    torque_sum += torque;
  }
  EXPECT_LT(norm(geometry.wrenchInBody(thrusts).force - force_sum), 4.0 * kRounding);
  EXPECT_LT(norm(geometry.wrenchInBody(thrusts).torque - torque_sum), 4.0 * kRounding);
}

// Figure 7: the rear engine on the x axis drives ahead and does not turn the craft; the left one
// pushes to the right and, being ahead of the centre, turns it clockwise; the right one mirrors it.
TEST(EngineGeometry, SteeringEnginesAtTheFrontTurnTheCraft) {
  Engines engines;
  engines[0].p_HE = {-0.25, 0.0, 0.0};
  engines[0].direction = {1.0, 0.0, 0.0};
  engines[1].p_HE = {0.2, 0.15, 0.0};
  engines[1].direction = {0.0, -1.0, 0.0};
  engines[2].p_HE = {0.2, -0.15, 0.0};
  engines[2].direction = {0.0, 1.0, 0.0};
  const EngineGeometry geometry(engines, Vector3::Zero());
  EXPECT_EQ(geometry.wrenchInBody({3.0, 0.0, 0.0}).force, Vector3(3.0, 0.0, 0.0));
  EXPECT_EQ(geometry.wrenchInBody({3.0, 0.0, 0.0}).torque, Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(geometry.wrenchInBody({0.0, 2.0, 0.0}).force, Vector3(0.0, -2.0, 0.0));
  EXPECT_EQ(geometry.wrenchInBody({0.0, 2.0, 0.0}).torque, Vector3(0.0, 0.0, -0.4));
  EXPECT_EQ(geometry.wrenchInBody({0.0, 0.0, 2.0}).torque, Vector3(0.0, 0.0, 0.4));
}

TEST(EngineDynamics, DemandIsHeldWithinTheLimits) {
  Engines engines = skewEngines();
  engines[0].min_thrust = -1.25;
  const EngineDynamics dynamics(engines, kStepNs);
  const auto demanded = [&](double thrust) {
    return dynamics.demandedThrust(kRear, commanded(thrust), 0);
  };
  EXPECT_EQ(demanded(3.0), 3.0);
  EXPECT_EQ(demanded(5.0), 5.0);
  EXPECT_EQ(demanded(5.5), 5.0);
  EXPECT_EQ(demanded(1e300), 5.0);
  EXPECT_EQ(demanded(-1.0), -1.0);
  EXPECT_EQ(demanded(-2.0), -1.25);
}

// Limits that nobody set are 0.
TEST(EngineDynamics, AnEngineWithoutLimitsGivesNoThrust) {
  const EngineDynamics dynamics({}, kStepNs);
  EXPECT_EQ(dynamics.demandedThrust(kRear, commanded(5.0), 0), 0.0);
  EXPECT_EQ(dynamics.demandedThrust(kRear, commanded(-5.0), 0), 0.0);
}

TEST(EngineDynamics, SaturationBeginsBeyondTheLimits) {
  Engines engines = skewEngines();
  engines[0].min_thrust = -1.25;
  const EngineDynamics dynamics(engines, kStepNs);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(dynamics.isSaturated(kRear, commanded(5.0)));
  EXPECT_TRUE(dynamics.isSaturated(kRear, commanded(std::nextafter(5.0, infinity))));
  EXPECT_FALSE(dynamics.isSaturated(kRear, commanded(-1.25)));
  EXPECT_TRUE(dynamics.isSaturated(kRear, commanded(std::nextafter(-1.25, -infinity))));
  EXPECT_FALSE(dynamics.isSaturated(kLeft, commanded(0.0)));
  EXPECT_TRUE(dynamics.isSaturated(kLeft, commanded(-0.1)));
}

TEST(EngineDynamics, WithoutLagThrustIsTheDemandFromTheStartOfTheStepOn) {
  const EngineDynamics dynamics(skewEngines(), kStepNs);
  EngineStates states;
  states[0] = commanded(2.0);
  states[0].thrust = 0.7;
  const ThrustCourse course = dynamics.course(states, 0);
  EXPECT_EQ(course.start[kRear], 2.0);
  EXPECT_EQ(course.middle[kRear], 2.0);
  EXPECT_EQ(course.end[kRear], 2.0);
}

// T' = (D - T)/τ: T(s) = D + (T0 - D) exp(-s/τ) at s = 0, h/2, h.
TEST(EngineDynamics, LagIsTheExactSolutionAtEachStage) {
  Engines engines = skewEngines();
  engines[0].time_constant = 0.03;
  engines[1].time_constant = 0.2;
  const EngineDynamics dynamics(engines, kStepNs);
  EngineStates states;
  states[0] = commanded(9.0);  // demand 5, the limit
  states[0].thrust = 1.5;
  states[1] = commanded(0.5);
  states[1].thrust = 4.0;
  const ThrustCourse course = dynamics.course(states, 0);
  const auto expected = [](double demand, double thrust, double time, double constant) {
    return demand + (thrust - demand) * std::exp(-time / constant);
  };
  EXPECT_NEAR(course.start[0], 1.5, kRounding);
  EXPECT_NEAR(course.middle[0], expected(5.0, 1.5, 0.005, 0.03), 4.0 * kRounding);
  EXPECT_NEAR(course.end[0], expected(5.0, 1.5, 0.01, 0.03), 4.0 * kRounding);
  EXPECT_NEAR(course.start[1], 4.0, kRounding);
  EXPECT_NEAR(course.middle[1], expected(0.5, 4.0, 0.005, 0.2), 4.0 * kRounding);
  EXPECT_NEAR(course.end[1], expected(0.5, 4.0, 0.01, 0.2), 4.0 * kRounding);
  EXPECT_EQ(course.at(Stage::kStart), course.start);
  EXPECT_EQ(course.at(Stage::kMiddle), course.middle);
  EXPECT_EQ(course.at(Stage::kEnd), course.end);
}

// Exact means: as many short steps as one likes, the same curve. 1000 steps of 1 ms, τ = 0.3 s.
TEST(EngineDynamics, LagDoesNotDependOnTheStepSize) {
  Engines engines = skewEngines();
  engines[0].time_constant = 0.3;
  const EngineDynamics dynamics(engines, 1000000);
  EngineStates states;
  states[0] = commanded(4.0);
  for (Tick tick = 0; tick < 1000; ++tick) states[0].thrust = dynamics.course(states, tick).end[0];
  EXPECT_NEAR(states[0].thrust, 4.0 * (1.0 - std::exp(-1.0 / 0.3)), 1e-13);
}

// The bits of a thrust must not depend on the C library's exp: an engine at 1 N whose demand is 0
// keeps exp(-h/τ) N.
TEST(EngineDynamics, DecayIsTheNearestDouble) {
  Engines engines = skewEngines();
  engines[0].time_constant = 0.01;  // h/τ = 1
  EngineStates states;
  states[0].thrust = 1.0;
  const ThrustCourse course = EngineDynamics(engines, kStepNs).course(states, 0);
  EXPECT_EQ(course.middle[0], exactExp(-0.5));
  EXPECT_EQ(course.end[0], exactExp(-1.0));
}

TEST(EngineDynamics, TimeOutComesAtItsTickAndNotOneEarlier) {
  Engines engines = skewEngines();
  engines[0].timeout_ns = 500000000;  // 50 ticks
  const EngineDynamics dynamics(engines, kStepNs);
  const EngineState state = commanded(3.0, 7);
  EXPECT_FALSE(dynamics.isTimedOut(kRear, state, 7));
  EXPECT_FALSE(dynamics.isTimedOut(kRear, state, 56));
  EXPECT_EQ(dynamics.demandedThrust(kRear, state, 56), 3.0);
  EXPECT_TRUE(dynamics.isTimedOut(kRear, state, 57));
  EXPECT_EQ(dynamics.demandedThrust(kRear, state, 57), 0.0);
  EXPECT_EQ(dynamics.commandAge(state, 57), 500000000);
}

// A time-out that is no multiple of the step takes effect at the first tick after it.
TEST(EngineDynamics, TimeOutBetweenTicksComesAtTheNextOne) {
  Engines engines = skewEngines();
  engines[0].timeout_ns = 10000001;
  const EngineDynamics dynamics(engines, kStepNs);
  EXPECT_FALSE(dynamics.isTimedOut(kRear, commanded(3.0), 1));
  EXPECT_TRUE(dynamics.isTimedOut(kRear, commanded(3.0), 2));
}

TEST(EngineDynamics, ANewCommandReArmsTheTimeOut) {
  Engines engines = skewEngines();
  engines[0].timeout_ns = 500000000;
  const EngineDynamics dynamics(engines, kStepNs);
  EXPECT_TRUE(dynamics.isTimedOut(kRear, commanded(3.0, 0), 60));
  EXPECT_FALSE(dynamics.isTimedOut(kRear, commanded(3.0, 60), 60));
  EXPECT_FALSE(dynamics.isTimedOut(kRear, commanded(3.0, 60), 109));
  EXPECT_TRUE(dynamics.isTimedOut(kRear, commanded(3.0, 60), 110));
}

TEST(EngineDynamics, TimeOutOfZeroNeverComes) {
  const EngineDynamics dynamics(skewEngines(), kStepNs);
  EXPECT_FALSE(dynamics.isTimedOut(kRear, commanded(3.0), 1000000000));
}

TEST(EngineDynamics, AnEngineThatWasNeverCommandedRestsAndHasNoAge) {
  Engines engines = skewEngines();
  engines[0].timeout_ns = 1;
  const EngineDynamics dynamics(engines, kStepNs);
  const EngineState state;
  EXPECT_EQ(dynamics.commandAge(state, 1000), -1);
  EXPECT_FALSE(dynamics.isTimedOut(kRear, state, 1000));
  EXPECT_EQ(dynamics.demandedThrust(kRear, state, 1000), 0.0);
}

// After a time-out a lagging engine runs down with its own time constant; it does not jump.
TEST(EngineDynamics, ATimedOutEngineRunsDownWithItsLag) {
  Engines engines = skewEngines();
  engines[0].time_constant = 0.1;
  engines[0].timeout_ns = kStepNs;
  EngineStates states;
  states[0] = commanded(3.0);
  states[0].thrust = 3.0;
  const ThrustCourse course = EngineDynamics(engines, kStepNs).course(states, 1);
  EXPECT_EQ(course.start[0], 3.0);
  EXPECT_NEAR(course.end[0], 3.0 * std::exp(-0.1), 4.0 * kRounding);
}

TEST(EngineDynamics, AnUncheckedStepSizeIsOurOwnMistake) {
  EXPECT_THROW(EngineDynamics(skewEngines(), 0), std::logic_error);
}

// What course() returns: the first step that has other thrusts. A lag changes them in each step;
// without one the next time-out does: commands of tick 3, 50 and 80 ticks of it.
TEST(EngineDynamics, TellsUntilWhenThrustsStay) {
  Engines engines = skewEngines();
  engines[0].timeout_ns = 80 * kStepNs;
  engines[1].timeout_ns = 50 * kStepNs;
  EngineStates states;
  states[0] = commanded(2.0, 3);
  states[1] = commanded(1.0, 3);
  ThrustCourse course;
  const auto until = [&](Tick tick) {
    return EngineDynamics(engines, kStepNs).course(states, tick, course);
  };
  EXPECT_EQ(until(3), 53);
  EXPECT_EQ(until(52), 53);
  EXPECT_EQ(until(53), 83);
  EXPECT_EQ(until(83), std::numeric_limits<Tick>::max());
  engines[2].time_constant = 0.1;
  EXPECT_EQ(until(5), 53);  // it has no command, nor a thrust that could run down
  states[2] = commanded(1.0, 5);
  EXPECT_EQ(until(5), 5);
  engines[2].time_constant = 0.0;
  EXPECT_EQ(until(5), 53);
}

// Thrusts 1 + 2 x + 3 x^2 of the share x: a parabola is its own course in every piece of a step.
TEST(ThrustCourse, APieceOfAParabolaIsTheParabolaThere) {
  const auto exact = [](double x) { return 1.0 + 2.0 * x + 3.0 * x * x; };
  ThrustCourse course;
  for (std::size_t i = 0; i < course.start.size(); ++i) {
    const double scale = static_cast<double>(i + 1);
    course.start[i] = scale * exact(0.0);
    course.middle[i] = scale * exact(0.5);
    course.end[i] = scale * exact(1.0);
  }
  const ThrustCourse piece = course.piece(0.002, 0.008, 0.01);
  for (std::size_t i = 0; i < course.start.size(); ++i) {
    const double scale = static_cast<double>(i + 1);
    EXPECT_NEAR(piece.start[i], scale * exact(0.2), 20.0 * kRounding) << i;
    EXPECT_NEAR(piece.middle[i], scale * exact(0.5), 20.0 * kRounding) << i;
    EXPECT_NEAR(piece.end[i], scale * exact(0.8), 20.0 * kRounding) << i;
  }
}

TEST(EngineState, IsFaultyWhereItIsStuckOrWeakerThanItWas) {
  EngineState state;
  EXPECT_FALSE(state.isFaulty());
  state.efficiency = 0.5;
  EXPECT_TRUE(state.isFaulty());
  state.efficiency = 0.0;
  EXPECT_TRUE(state.isFaulty());
  state.efficiency = 1.0;
  state.stuck = true;
  EXPECT_TRUE(state.isFaulty());
}

TEST(EngineState, LevelsAreTheThrustsOfAll) {
  EngineStates states;
  states.resize(5);
  for (std::size_t id = 0; id < states.size(); ++id) {
    states[id].thrust = 1.5 + static_cast<double>(id);
    states[id].commanded = -7.0;
  }
  const ActuatorArray<double> levels = levelsOf(states);
  ASSERT_EQ(levels.size(), 5U);
  for (std::size_t id = 0; id < 5; ++id) EXPECT_EQ(levels[id], 1.5 + static_cast<double>(id));
}

}  // namespace
}  // namespace hovercraft
