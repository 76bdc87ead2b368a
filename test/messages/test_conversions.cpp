#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/messages/conversions.h"

#include "../support/numbers.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Command;
using hovercraft::Quaternion;
using hovercraft::Vector3;
using hovercraft::testing::kNan;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

void expectEqual(const Quaternion& a, const Quaternion& b) {
  EXPECT_EQ(a.s, b.s);
  EXPECT_EQ(a.v, b.v);
}

void expectNear(const Vector3& a, const Vector3& b, double tolerance) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "component " << i;
}

class Dice {
 public:
  Vector3 vector() { return {number_(engine_), number_(engine_), number_(engine_)}; }
  Quaternion turn() { return hovercraft::normalized({number_(engine_), vector()}); }

 private:
  std::mt19937 engine_{20240607};
  std::uniform_real_distribution<double> number_{-1.0, 1.0};
};

TEST(Conversions, VectorsPointsAndQuaternionsComeBackToTheLastBit) {
  Dice dice;
  for (int i = 0; i < 20; ++i) {
    const Vector3 v = dice.vector() / 3.0;
    const Quaternion q = dice.turn();
    EXPECT_EQ(fromMessage(toVector3Message(v)), v);
    EXPECT_EQ(fromMessage(toPointMessage(v)), v);
    expectEqual(fromMessage(toQuaternionMessage(q)), q);
  }
}

TEST(Conversions, EachComponentHasItsPlaceInTheMessage) {
  const geometry_msgs::Vector3 vector = toVector3Message({1.0, 2.0, 3.0});
  EXPECT_EQ(vector.x, 1.0);
  EXPECT_EQ(vector.y, 2.0);
  EXPECT_EQ(vector.z, 3.0);
  const geometry_msgs::Point point = toPointMessage({4.0, 5.0, 6.0});
  EXPECT_EQ(point.x, 4.0);
  EXPECT_EQ(point.y, 5.0);
  EXPECT_EQ(point.z, 6.0);
  const geometry_msgs::Quaternion quaternion = toQuaternionMessage({0.1, {0.2, 0.3, 0.4}});
  EXPECT_EQ(quaternion.w, 0.1);
  EXPECT_EQ(quaternion.x, 0.2);
  EXPECT_EQ(quaternion.y, 0.3);
  EXPECT_EQ(quaternion.z, 0.4);
}

/// A body that moves and turns evenly, at time t: its motion has a closed form.
hovercraft::Motion evenMotion(const hovercraft::Motion& start, double t) {
  const Vector3 w = start.twist.w_WB;
  const double rate = hovercraft::norm(w);
  const Quaternion turn = {std::cos(0.5 * rate * t), std::sin(0.5 * rate * t) / rate * w};
  hovercraft::Motion motion = start;
  motion.p_WB = start.p_WB + t * start.twist.v_WB;
  motion.q_WB = turn * start.q_WB;
  return motion;
}

TEST(Conversions, TheTwistOfBaseLinkIsTheRateOfItsPose) {
  Dice dice;
  // A central difference is off by dt²/6 |w|³ |p_HB| < 1e-8/6 * 5.2 * 1.8 = 1.6e-8, its roundings
  // by 1e-16/dt = 1e-12.
  constexpr double dt = 1e-4;         // s
  constexpr double tolerance = 2e-8;  // m/s, rad/s
  for (int i = 0; i < 20; ++i) {
    hovercraft::Motion motion = {};
    motion.p_WB = dice.vector();
    motion.q_WB = dice.turn();
    motion.twist = {dice.vector(), dice.vector()};
    const Vector3 p_HB = dice.vector();
    const HullMotion hull = hullMotion(motion, p_HB);
    const HullMotion before = hullMotion(evenMotion(motion, -dt), p_HB);
    const HullMotion after = hullMotion(evenMotion(motion, dt), p_HB);
    const Vector3 v_WH = (after.p_WH - before.p_WH) / (2.0 * dt);
    expectNear(hovercraft::rotate(hull.q_WH, hull.v_WH_H), v_WH, tolerance);
    const Quaternion turned = after.q_WH * hovercraft::conjugate(before.q_WH);
    expectNear(hovercraft::rotate(hull.q_WH, hull.w_WH_H), turned.v / dt, tolerance);
  }
}

TEST(Conversions, TheCentreOfMassIsWhereTheScenarioPutsItInBaseLink) {
  Dice dice;
  for (int i = 0; i < 20; ++i) {
    hovercraft::Motion motion = {};
    motion.p_WB = dice.vector();
    motion.q_WB = dice.turn();
    const Vector3 p_HB = dice.vector();
    const HullMotion hull = hullMotion(motion, p_HB);
    expectEqual(hull.q_WH, motion.q_WB);
    expectNear(hull.p_WH + hovercraft::rotate(hull.q_WH, p_HB), motion.p_WB, 1e-15);
  }
}

TEST(Conversions, ThePoseOfACentredCraftIsThatOfItsCentreOfMass) {
  hovercraft::Motion motion = {};
  motion.p_WB = {1.0, 2.0, 3.0};
  motion.q_WB = hovercraft::normalized({0.5, {0.1, -0.7, 0.2}});
  EXPECT_EQ(hullMotion(motion, Vector3::Zero()).p_WH, motion.p_WB);
}

void expectTurnsXTo(const Vector3& direction) {
  SCOPED_TRACE(::testing::Message() << direction.transpose());
  const Quaternion turn = turnFromX(direction);
  EXPECT_NEAR(hovercraft::norm(turn), 1.0, 1e-15);
  expectNear(hovercraft::rotate(turn, Vector3::UnitX()), direction / hovercraft::norm(direction),
             1e-15);
  // The shortest turn is about an axis at right angles to x, by half a turn at most.
  EXPECT_EQ(turn.v.x(), 0.0);
  EXPECT_GE(turn.s, 0.0);
}

TEST(Conversions, AnEngineFrameTurnsXTheShortestWayToTheThrust) {
  Dice dice;
  for (int i = 0; i < 50; ++i) {
    const Vector3 v = dice.vector();
    expectTurnsXTo(v / hovercraft::norm(v));
  }
  for (int axis = 0; axis < 3; ++axis) {
    expectTurnsXTo(Vector3::Unit(axis));
    expectTurnsXTo(-Vector3::Unit(axis));
  }
  expectEqual(turnFromX(Vector3::UnitX()), Quaternion::identity());
}

TEST(Conversions, AThrustAsternOrNearlySoIsTurnedToAsWell) {
  for (const double off : {1e-3, 1e-5, 1e-8, 1e-12, 1e-160, 1e-300}) {
    expectTurnsXTo({-std::sqrt(1.0 - off * off), off, 0.0});
    expectTurnsXTo({-std::sqrt(1.0 - off * off), 0.0, -off});
  }
  // A scenario may give a direction's length within 1e-6 of 1.
  expectTurnsXTo({-0.9999995, 0.0, 0.0});
  expectTurnsXTo({-1.0000005, 0.0, 0.0});
  expectTurnsXTo({-1.0000005, 1e-9, 0.0});
}

TEST(Conversions, AThrustCommandIsForAllEngines) {
  hovercraft_sim::ThrustCommand message;
  message.rear = 1.5;
  message.left = -2.5;
  message.right = 3.5;
  const auto command = toCommand(message, 2);
  ASSERT_TRUE(command);
  EXPECT_EQ(command->tick, 0);
  EXPECT_EQ(command->vehicle, 2U);
  EXPECT_EQ(command->engines, hovercraft::kAllEngines);
  EXPECT_EQ(command->thrusts, Vector3(1.5, -2.5, 3.5));
}

TEST(Conversions, AThrustCommandWithOneThrustThatIsNotFiniteIsNone) {
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    for (double hovercraft_sim::ThrustCommand::*field :
         {&hovercraft_sim::ThrustCommand::rear, &hovercraft_sim::ThrustCommand::left,
          &hovercraft_sim::ThrustCommand::right}) {
      hovercraft_sim::ThrustCommand message;
      message.*field = bad;
      EXPECT_FALSE(toCommand(message, 0));
    }
    EXPECT_FALSE(toCommand(bad, 1, 0));
  }
}

TEST(Conversions, ASingleThrustIsForItsEngineOnly) {
  for (std::size_t i = 0; i < hovercraft::kEngineNames.size(); ++i) {
    const auto command = toCommand(-0.25, i, 1);
    ASSERT_TRUE(command);
    EXPECT_EQ(command->tick, 0);
    EXPECT_EQ(command->vehicle, 1U);
    EXPECT_EQ(command->engines, 1U << i);
    EXPECT_EQ(command->thrusts, Vector3(-0.25 * Vector3::Unit(static_cast<int>(i))));
  }
}

TEST(Conversions, AnAppliedCommandComesBack) {
  const Command command = {123456789012, 3, 5, {0.1, 0.0, -0.3}};
  const hovercraft_sim::AppliedCommand message = toMessage(command);
  EXPECT_EQ(message.engines,
            hovercraft_sim::AppliedCommand::REAR | hovercraft_sim::AppliedCommand::RIGHT);
  const Command back = toCommand(message, 3);
  EXPECT_EQ(back.tick, command.tick);
  EXPECT_EQ(back.vehicle, command.vehicle);
  EXPECT_EQ(back.engines, command.engines);
  EXPECT_EQ(back.thrusts, command.thrusts);
}

TEST(Conversions, AnEngineReportKeepsEveryField) {
  const hovercraft_sim::Engine saturated = toMessage({1.0, 2.0, true, false, 3.0});
  EXPECT_EQ(saturated.commanded, 1.0);
  EXPECT_EQ(saturated.applied, 2.0);
  EXPECT_TRUE(saturated.saturated);
  EXPECT_FALSE(saturated.timed_out);
  EXPECT_EQ(saturated.age, 3.0);
  const hovercraft_sim::Engine timed_out = toMessage({0.0, 0.0, false, true, -1.0});
  EXPECT_FALSE(timed_out.saturated);
  EXPECT_TRUE(timed_out.timed_out);
  EXPECT_EQ(timed_out.age, -1.0);
}

}  // namespace
}  // namespace hovercraft_ros
