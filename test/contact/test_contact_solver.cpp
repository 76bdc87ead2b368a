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
    solver.add(upper);
    demand.b = 1;
    demand.nhat_AB_W = Vector3(0.0, 0.0, 1.0);
  }
  Vector3 solved() {
    solver.add(demand);
    solver.solve({100, 1, 1e-15});
    return solver.impulse(0);
  }

  ContactSolver solver;
  ContactDemand demand;
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

}  // namespace
}  // namespace hovercraft
