#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/collision/motion.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"

#include "random_bodies.h"

namespace hovercraft {
namespace {

TEST(StepMotion, TurnsAtConstantAngularVelocity) {
  RandomBodies random(41);
  for (const double angle : {0.0, 1e-12, 1e-3, 0.3, 1.0, 3.0, 12.0, 100.0}) {
    const Vector3 axis = random.unitVector();
    StepMotion motion;
    motion.q_WB = random.orientation();
    motion.w_WB = 4.0 * angle * axis;
    const Matrix3 expected =
        rotationMatrix(normalized(quaternionFromAxisAngle(axis, angle) * motion.q_WB));
    EXPECT_LT((motion.at(0.25).R_AB - expected).cwiseAbs().maxCoeff(), 1e-15 * (1.0 + 4.0 * angle))
        << angle;
  }
}

TEST(StepMotion, TurnsFasterAtConstantAngularAcceleration) {
  StepMotion motion;
  motion.w_WB = Vector3(0.0, 0.0, 2.0);
  motion.alpha_WB = Vector3(0.0, 0.0, -12.0);
  // 2 t - 6 t²: back where it was after a third of a second, then on.
  EXPECT_LT((motion.at(1.0 / 3.0).R_AB - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-15);
  const Matrix3 expected = rotationMatrix(quaternionFromAxisAngle(Vector3::UnitZ(), -4.0));
  EXPECT_LT((motion.at(1.0).R_AB - expected).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_EQ(motion.angularVelocity(1.0), Vector3(0.0, 0.0, -10.0));
  EXPECT_EQ(motion.fastestTurn(1.0), Vector3(0.0, 0.0, -10.0));
  EXPECT_EQ(motion.fastestTurn(0.25), Vector3(0.0, 0.0, 2.0));
}

TEST(StepMotion, BentKeepsItsEndsAndGetsTheirVelocities) {
  StepMotion motion = motionBetween(Vector3(1, 2, 3), {}, Vector3(2, 2, 2),
                                    quaternionFromAxisAngle(Vector3::UnitX(), 0.5), 0.5);
  // Of the turn only what lies along its axis.
  motion.bend(Vector3(0, 4, 0), Vector3(3, 1, 0), 0.5);
  EXPECT_LT(norm(motion.at(0.5).p_AB - Vector3(2, 2, 2)), 1e-15);
  const Matrix3 end = rotationMatrix(quaternionFromAxisAngle(Vector3::UnitX(), 0.5));
  EXPECT_LT((motion.at(0.5).R_AB - end).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT(norm(motion.v_WB + 0.5 * motion.a_WB - (motion.v_WB + Vector3(0, 4, 0))), 1e-15);
  EXPECT_LT(norm(motion.w_WB - Vector3(-0.5, 0, 0)), 1e-14);
  EXPECT_LT(norm(motion.angularVelocity(0.5) - Vector3(2.5, 0, 0)), 1e-14);
  // What ends as it began has turned to and fro.
  StepMotion back = motionBetween(Vector3::Zero(), {}, Vector3::Zero(), {}, 0.5);
  back.bend(Vector3::Zero(), Vector3(0, 0, 2), 0.5);
  EXPECT_EQ(back.w_WB, Vector3(0, 0, -1));
  EXPECT_EQ(back.at(0.5).R_AB, Matrix3::Identity());
  EXPECT_NEAR(back.at(0.25).R_AB(1, 0), -std::sin(0.125), 1e-15);
}

TEST(StepMotion, FallsOnAParabola) {
  StepMotion motion;
  motion.p_WB = Vector3(1, 2, 3);
  motion.v_WB = Vector3(4, 0, 8);
  motion.a_WB = Vector3(0, 0, -16);
  EXPECT_EQ(motion.at(0.5).p_AB, Vector3(3, 2, 5));
}

TEST(StepMotion, BetweenTwoPosesEndsAtThem) {
  RandomBodies random(42);
  for (int i = 0; i < 100; ++i) {
    const Vector3 p_start = random.unitVector();
    const Vector3 p_end = random.unitVector();
    const Quaternion q_start = random.orientation();
    const Quaternion q_end =
        i % 2 == 0 ? random.orientation()
                   : normalized(quaternionFromAxisAngle(random.unitVector(), 1e-9) * q_start);
    const StepMotion motion = motionBetween(p_start, q_start, p_end, q_end, 0.01);
    EXPECT_LT(norm(motion.at(0.01).p_AB - p_end), 1e-15);
    EXPECT_LT((motion.at(0.01).R_AB - rotationMatrix(q_end)).cwiseAbs().maxCoeff(), 4e-15);
    EXPECT_LE(norm(motion.w_WB), 314.16);  // the short way: at most pi
  }
  EXPECT_THROW(motionBetween(Vector3::Zero(), {}, Vector3::Zero(), {}, 0.0), std::logic_error);
}

TEST(SweptBox, HoldsEveryVertexAtEveryTime) {
  RandomBodies random(43);
  for (int i = 0; i < 100; ++i) {
    const ConvexPolyhedron body = random.ellipsoidHull(20, {1.0, 0.5, 0.2});
    StepMotion motion;
    motion.p_WB = 3.0 * random.unitVector();
    motion.q_WB = random.orientation();
    motion.v_WB = 5.0 * random.unitVector();
    motion.a_WB = 20.0 * random.unitVector();
    motion.w_WB = random.uniform(0.0, 10.0) * random.unitVector();
    motion.alpha_WB = random.uniform(-4.0, 4.0) * motion.w_WB;
    const AxisAlignedBox box = sweptBox(body, motion, 0.5);
    for (int k = 0; k <= 50; ++k) {
      const Pose X_WB = motion.at(0.01 * k);
      for (int v = 0; v < body.vertexCount(); ++v) {
        const Vector3 p = transform(X_WB, body.vertex(v));
        ASSERT_TRUE(box.overlaps({p, p})) << "sample " << i << ", time " << 0.01 * k;
      }
    }
  }
}

// It ends as it began, and was elsewhere in between.
TEST(SweptBox, HoldsABodyThatTurnsToAndFro) {
  const ConvexPolyhedron rod = boxPolyhedron(Vector3(2.0, 0.02, 0.02));
  StepMotion motion;
  motion.bend(Vector3::Zero(), Vector3(0.0, 0.0, 0.4), 0.5);
  const Vector3 tip = transform(motion.at(0.25), Vector3(1.0, 0.0, 0.0));
  EXPECT_LT(tip.y(), -0.02);
  EXPECT_TRUE(sweptBox(rod, motion, 0.5).overlaps({tip, tip}));
}

// At rest the box is that of the body, to rounding.
TEST(SweptBox, OfABodyAtRestIsTight) {
  const AxisAlignedBox box = sweptBox(boxPolyhedron(Vector3(2, 4, 6)), StepMotion(), 1.0);
  EXPECT_LT(norm(box.high - Vector3(1, 2, 3)), 1e-12);
  EXPECT_LT(norm(box.low - Vector3(-1, -2, -3)), 1e-12);
}

}  // namespace
}  // namespace hovercraft
