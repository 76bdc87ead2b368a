#include <gtest/gtest.h>

#include "hovercraft_sim/contact/contact_solver.h"

namespace hovercraft {
namespace {

/// A fixed body and one of 1 kg above it that a resting contact must stop.
struct OneOnAnother {
  OneOnAnother() {
    solver.add(ContactBody());
    ContactBody upper;
    upper.p_WB = Vector3(0.0, 0.0, 0.1);
    upper.inverse_mass = Vector3::Constant(1.0);
    upper.inverse_inertia = Matrix3::Identity();
    upper.twist.v_WB = Vector3(0.3, 0.0, -2.0);
    demand.b = solver.add(upper);
    demand.nhat_AB_W = Vector3(0.0, 0.0, 1.0);
  }
  Vector3 solved() {
    solver.add(demand);
    solver.solve({100, 1, 1e-15});
    return solver.impulse(0);
  }

  ContactSolver solver;
  ContactConstraint demand;
};

// The force of the last step is the start of the next; its direction turns with the bodies.
TEST(ContactSolver, AStartAcrossTheNormalIsForgottenWithoutFriction) {
  OneOnAnother pair;
  pair.demand.start = Vector3(0.4, -0.2, 1.0);
  EXPECT_EQ(pair.solved(), Vector3(0.0, 0.0, 2.0));
  EXPECT_EQ(pair.solver.bodies()[1].twist.v_WB, Vector3(0.3, 0.0, 0.0));
}

TEST(ContactSolver, AStartAcrossTheNormalIsCutToTheFriction) {
  OneOnAnother pair;
  pair.demand.friction = 0.05;
  pair.demand.start = Vector3(0.4, -0.2, 1.0);
  const Vector3 impulse = pair.solved();
  EXPECT_NEAR(impulse.x(), -0.05 * 2.0, 1e-12);  // against the slip
  EXPECT_NEAR(impulse.y(), 0.0, 1e-12);
}

TEST(ContactSolver, AStartThatPullsIsNone) {
  OneOnAnother pair;
  pair.demand.start = Vector3(0.0, 0.0, -5.0);
  EXPECT_EQ(pair.solved(), Vector3(0.0, 0.0, 2.0));
}

// The start is an impulse that acted already, on 1 kg and, 0.1 m from its centre, on 1 kg m^2.
TEST(ContactSolver, AStartActsAtOnce) {
  OneOnAnother pair;
  pair.demand.friction = 1.0;
  pair.demand.start = Vector3(0.25, -0.5, 1.0);
  pair.solver.add(pair.demand);
  EXPECT_EQ(pair.solver.bodies()[1].twist.v_WB, Vector3(0.55, -0.5, -1.0));
  EXPECT_EQ(pair.solver.impulse(0), pair.demand.start);
  EXPECT_LT(norm(pair.solver.velocityAt(0) - Vector3(0.5525, -0.505, -1.0)), 1e-15);
}

// The normal of a point is its own: a floor that is not touched, then a wall that holds all.
TEST(ContactSolver, EachPointHasTheTangentsOfItsNormal) {
  OneOnAnother pair;
  pair.solver.bodies()[1].inverse_inertia.setZero();  // does not turn
  pair.solver.bodies()[1].twist.v_WB = Vector3(-0.6, -0.8, 1.5);
  pair.solver.add(pair.demand);
  pair.demand.nhat_AB_W = Vector3(0.6, 0.8, 0.0);
  pair.demand.friction = 10.0;  // 1 N s of the wall would hold 10
  pair.solver.add(pair.demand);
  pair.solver.solve({100, 1, 1e-15});
  EXPECT_LT(norm(pair.solver.bodies()[1].twist.v_WB), 1e-14);
  EXPECT_LT(norm(pair.solver.impulse(0)), 1e-14);
  EXPECT_LT(norm(pair.solver.impulse(1) - Vector3(0.6, 0.8, -1.5)), 1e-14);
}

// Neither can move along z: whatever the slip there, friction across is all for what it can stop.
// 2 m/s against the wall, 0.1 of it along y: 10 - 0.2 m/s are left.
TEST(ContactSolver, NothingPushesAlongWhereNeitherCanMove) {
  OneOnAnother pair;
  pair.solver.bodies()[1].inverse_mass = Vector3(1.0, 1.0, 0.0);
  pair.solver.bodies()[1].inverse_inertia.setZero();
  pair.solver.bodies()[1].twist.v_WB = Vector3(-2.0, 10.0, 0.5);
  pair.demand.nhat_AB_W = Vector3(1.0, 0.0, 0.0);
  pair.demand.friction = 0.1;
  EXPECT_LT(norm(pair.solved() - Vector3(2.0, -0.2, 0.0)), 1e-14);
  EXPECT_LT(norm(pair.solver.bodies()[1].twist.v_WB - Vector3(0.0, 9.8, 0.5)), 1e-14);
}

/// A row of bodies of 1 kg between two fixed ones, each joined to the next along x.
struct Row {
  explicit Row(int count) {
    solver.add(ContactBody());
    for (int i = 0; i < count; ++i) {
      ContactBody body;
      body.inverse_mass = Vector3::Constant(1.0);
      body.twist.v_WB = Vector3(i == 0 ? 1.0 : 0.0, 0.0, 0.0);
      solver.add(body);
    }
    solver.add(ContactBody());
    for (int i = 0; i <= count; ++i) {
      ContactConstraint joint;
      joint.a = i;
      joint.b = i + 1;
      joint.nhat_AB_W = Vector3(1.0, 0.0, 0.0);
      joint.bilateral = true;
      solver.add(joint);
    }
  }
  ContactSolver solver;
};

// One sweep in the order of the points. Two bodies, 1 m/s of the second: the joint between them
// gives each half of it, the one to the wall stops the second; the first is left with its half.
TEST(ContactSolver, MakesNoMoreSweepsThanItMay) {
  Row row(2);
  row.solver.bodies()[1].twist.v_WB.x() = 0.0;
  row.solver.bodies()[2].twist.v_WB.x() = 1.0;
  EXPECT_EQ(row.solver.solve({1, 1, 0.0}), 1);
  EXPECT_EQ(row.solver.impulse(1), Vector3(-0.5, 0.0, 0.0));
  EXPECT_EQ(row.solver.impulse(2), Vector3(0.5, 0.0, 0.0));
  EXPECT_EQ(row.solver.bodies()[1].twist.v_WB.x(), 0.5);
  EXPECT_EQ(row.solver.bodies()[2].twist.v_WB.x(), 0.0);
}

// A change of 1 m/s is within the tolerance, so that the least number of sweeps is all it makes.
TEST(ContactSolver, IsDoneAfterTheLeastSweepsOnceTheChangeIsSmall) {
  for (const int least : {1, 3}) {
    Row row(8);
    row.solver.bodies()[8].twist.v_WB.x() = 0.5;
    EXPECT_EQ(row.solver.solve({100, least, 2.0}), least);
  }
}

// Sweeps alone shrink the slowest of 17 joints' errors by cos^2(pi/17) = 0.966 each, hence 1e-12 of
// it takes 27.6/0.0344 = 800; going on between them takes a third.
TEST(ContactSolver, GoesOnBetweenTheSweeps) {
  Row row(16);
  for (std::size_t i = 0; i < 16; ++i) {
    row.solver.bodies()[i + 1].twist.v_WB.x() = 0.1 * static_cast<double>(i);
  }
  EXPECT_LT(row.solver.solve({2000, 1, 1e-12}), 400);
  for (const ContactBody& body : row.solver.bodies()) EXPECT_LT(norm(body.twist.v_WB), 1e-10);
}

// The tangents go by the slip that the normal of the same sweep leaves: of a point off the centre
// nothing slips after one.
TEST(ContactSolver, AfterASweepAPointThatHoldsDoesNotSlip) {
  OneOnAnother pair;
  pair.demand.p_WC = Vector3(0.3, -0.4, 0.0);
  pair.demand.bilateral = true;
  pair.solver.add(pair.demand);
  EXPECT_EQ(pair.solver.solve({1, 1, 0.0}), 1);
  const Vector3 v = pair.solver.velocityAt(0);
  EXPECT_NEAR(v.x(), 0.0, 1e-15);
  EXPECT_NEAR(v.y(), 0.0, 1e-15);
}

/// Cubes of 1 kg and 1 m, each on the one below and the first on the floor, that fall at a speed.
void addStack(ContactSolver& solver, int count, double speed) {
  solver.add(ContactBody());  // the floor
  for (int i = 0; i < count; ++i) {
    ContactBody cube;
    cube.p_WB = Vector3(0.0, 0.0, 0.5 + i);
    cube.inverse_mass = Vector3::Ones();
    cube.inverse_inertia = 6.0 * Matrix3::Identity();
    cube.twist.v_WB = Vector3(0.0, 0.0, -speed);
    solver.add(cube);
    for (const double x : {-0.5, 0.5}) {
      for (const double y : {-0.5, 0.5}) {
        ContactConstraint corner;
        corner.a = i + 1;
        corner.b = i;
        corner.nhat_AB_W = Vector3(0.0, 0.0, -1.0);
        corner.p_WC = Vector3(x, y, i);
        corner.friction = 0.5;
        solver.add(corner);
      }
    }
  }
}

// What an active set leaves is a part of what it stops: of a fall of 50 ms it is more than is asked
// for by steps of 1 ms, and no number of sweeps would find less.
TEST(ContactSolver, AStackIsSolvedInAFewSweepsHoweverFastItFalls) {
  for (const double speed : {1e-3, 0.5, 100.0}) {
    ContactSolver solver;
    addStack(solver, 10, speed);
    EXPECT_LT(solver.solve({1000, 4, 3e-7, 3e-10}), 30) << speed;
    for (std::size_t i = 1; i < solver.bodies().size(); ++i) {
      EXPECT_LT(norm(solver.bodies()[i].twist.v_WB), 1e-7 * std::max(1.0, speed)) << speed;
    }
  }
}

// B is a table that nothing moves and that turns: 1 m beside its centre it goes with w x r =
// (1, 1, 1) x (-1, 0, 0) = (0, -1, 1), and what sticks to it there goes with it.
TEST(ContactSolver, ATableThatTurnsTakesAlongWhatSticksToIt) {
  ContactSolver solver;
  ContactBody body;
  body.p_WB = Vector3(-1.0, 0.0, 0.1);
  body.inverse_mass = Vector3::Constant(1.0);
  ContactBody table;
  table.twist.w_WB = Vector3(1.0, 1.0, 1.0);
  ContactConstraint demand;
  demand.a = solver.add(body);
  demand.b = solver.add(table);
  demand.nhat_AB_W = Vector3(0.0, 0.0, -1.0);
  demand.p_WC = Vector3(-1.0, 0.0, 0.0);
  demand.friction = 10.0;
  solver.add(demand);
  solver.solve({100, 1, 1e-15});
  EXPECT_LT(norm(solver.bodies()[0].twist.v_WB - Vector3(0.0, -1.0, 1.0)), 1e-14);
  EXPECT_EQ(solver.bodies()[1].twist.w_WB, Vector3(1.0, 1.0, 1.0));
}

}  // namespace
}  // namespace hovercraft
