#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/pads.h"
#include "hovercraft_sim/math/rotation.h"

#include "flown_craft.h"

namespace hovercraft {
namespace {

std::vector<Vector3> boxCorners() {
  std::vector<Vector3> corners;
  for (const double x : {-0.2, 0.2}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double z : {-0.05, 0.05}) corners.emplace_back(x, y, z);
    }
  }
  return corners;
}

/// A block on its corners, and nothing else.
struct Block {
  Mobility mobility = Mobility::spatial(2.0, Vector3(0.01, 0.03, 0.035).asDiagonal());
  Pads pads;
  PlaneGround ground{GroundPlane()};

  StateDerivative<Quaternion> derivative(const RigidBodyState<Quaternion>& state,
                                         Stage /*stage*/) const {
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    const Vector3 v_WB = mobility.velocity(state.momentum_W);
    const Vector3 w_WB_B = mobility.angularVelocityInBody(state.angular_momentum_W, R_WB);
    const BodyMotion motion = {R_WB, state.p_WB, transposeTimes(R_WB, v_WB), w_WB_B,
                               Vector3::Zero()};
    const Wrench wrench = pads.wrenchInBody(motion, ground);
    return {v_WB, orientationRate(times(R_WB, w_WB_B), state.orientation),
            times(R_WB, wrench.force) + Vector3(0.0, 0.0, -2.0 * 10.0), times(R_WB, wrench.torque)};
  }
  Twist twist(const RigidBodyState<Quaternion>& state) const { return mobility.twist(state); }
};

TEST(Pads, BlockComesToRestWithItsCornersSunkByTheStatedDepth) {
  Block block;
  block.pads = Pads(boxCorners(), 20.0, {1e-3, {10.0, 0.5, 0.02}});
  auto state = block.mobility.stateOfMotion(Vector3(0.0, 0.0, 0.1),
                                            quaternionFromRpy({0.1, 0.2, 0.3}), Twist());
  for (int i = 0; i < 5000; ++i) {
    state = integrationStep(Integrator::kRungeKutta4, state, block, 1e-3);
  }
  EXPECT_NEAR(state.p_WB.z(), 0.05 - 1e-3, 1e-9);
  EXPECT_NEAR(rotationMatrix(state.orientation)(2, 2), 1.0, 1e-12);
  EXPECT_NEAR(norm(state.momentum_W), 0.0, 1e-8);
}

TEST(Pads, MomentOfASymmetricHullIsZeroToTheLastBit) {
  std::vector<Vector3> corners = boxCorners();
  std::swap(corners[1], corners[6]);
  corners.emplace_back(0.0, 0.0, -0.06);
  const Pads pads(corners, 20.0, {});
  BodyMotion motion;
  motion.R_WB = rotationFromRpy({0.0, 0.0, 1.1});
  motion.p_WB = Vector3(0.3, -0.2, 0.047);
  motion.v_WB_B = motion.u_B = Vector3(0.0, 0.0, -0.1);
  motion.w_WB_B = Vector3::Zero();
  const Wrench wrench = pads.wrenchInBody(motion, PlaneGround(GroundPlane()));
  EXPECT_GT(wrench.force.z(), 1.0);
  EXPECT_EQ(squaredNorm(wrench.torque), 0.0);
}

TEST(Pads, ManyVerticesPushAsEachByItself) {
  std::vector<Vector3> cloud;
  Wrench sum;
  BodyMotion motion;
  motion.R_WB = rotationFromRpy({0.1, -0.2, 0.4});
  motion.p_WB = Vector3(0.0, 0.0, 0.03);
  motion.v_WB_B = motion.u_B = Vector3(0.3, 0.1, -0.1);
  motion.w_WB_B = Vector3(0.2, 0.5, -0.3);
  const PlaneGround ground{GroundPlane()};
  for (int i = 0; i < 77; ++i) {
    cloud.emplace_back(0.2 * std::cos(i), 0.2 * std::sin(i), 0.05 * std::cos(3.0 * i));
    sum = sum + Pads({cloud.back()}, 20.0, {}).wrenchInBody(motion, ground);
  }
  const Wrench all = Pads(cloud, 20.0, {}).wrenchInBody(motion, ground);
  EXPECT_NEAR(norm(all.force - sum.force), 0.0, 1e-11 * norm(sum.force));
  EXPECT_NEAR(norm(all.torque - sum.torque), 0.0, 1e-11 * norm(sum.torque));
  EXPECT_GT(norm(sum.force), 100.0);
}

/// A plane that does not say that it is one: each vertex asks it.
class UnknownPlane final : public Ground {
 public:
  explicit UnknownPlane(const GroundPlane& plane) : ground_(plane) {}
  void sample(const GroundQuery& query, GroundSample* samples) const override {
    ground_.sample(query, samples);
  }

 private:
  PlaneGround ground_;
};

TEST(Pads, BoxAroundThemDecidesAsEachVertexDoes) {
  const std::vector<Vector3> vertices = {{0.18, 0.15, -0.042},  {0.18, -0.15, -0.042},
                                         {-0.18, 0.15, -0.042}, {-0.18, -0.15, -0.042},
                                         {0.1, 0.0, 0.05},      {0.0, 0.02, -0.04}};
  const Pads pads(vertices, 50.0, PadParameters());
  std::mt19937 random(20261127);
  std::uniform_real_distribution<double> share(-1.0, 1.0);
  int pressed = 0;
  int clear = 0;
  for (int i = 0; i < 2000; ++i) {
    const Matrix3 slope = rotationFromRpy({0.3 * share(random), 0.3 * share(random), 0.0});
    const GroundPlane plane = {slope.col(2), 0.5 * share(random)};
    BodyMotion motion;
    motion.R_WB = rotationFromRpy({0.3 * share(random), 0.3 * share(random), 3.0 * share(random)});
    motion.v_WB_B = Vector3(share(random), share(random), share(random));
    motion.w_WB_B = Vector3(share(random), share(random), share(random));
    motion.u_B = motion.v_WB_B;
    const Vector3 beside(share(random), share(random), 0.0);
    const double height = 0.08 + 0.05 * share(random);
    motion.p_WB =
        beside +
        ((plane.offset - dot(plane.nhat_W, beside)) / plane.nhat_W.z() + height) * Vector3::UnitZ();
    const Wrench fast = pads.wrenchInBody(motion, PlaneGround(plane));
    const Wrench slow = pads.wrenchInBody(motion, UnknownPlane(plane));
    ASSERT_EQ(fast.force, slow.force) << i;
    ASSERT_EQ(fast.torque, slow.torque) << i;
    ++(slow.force.isZero() ? clear : pressed);
  }
  EXPECT_GT(pressed, 500);
  EXPECT_GT(clear, 500);
}

}  // namespace
}  // namespace hovercraft
