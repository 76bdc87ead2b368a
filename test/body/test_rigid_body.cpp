#include <cmath>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "hovercraft_sim/body/rigid_body.h"

#include "../support/numbers.h"
#include "../support/orientations.h"

namespace hovercraft {
namespace {

using testing::kRounding;

constexpr unsigned kSeed = 20261122;
constexpr int kSamples = 100;

class RandomBodies {
 public:
  double number() { return number_(engine_); }
  Vector3 vector() { return {number(), number(), number()}; }
  Quaternion unit() { return normalized(Quaternion{number(), vector()}); }

  /// Inertia of point masses at random places: it meets the triangle inequality, with all products.
  Matrix3 inertia() {
    Matrix3 sum = Matrix3::Zero();
    for (int point = 0; point < 4; ++point) {
      const Vector3 r = vector();
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) sum(i, j) += (i == j ? squaredNorm(r) : 0.0) - r[i] * r[j];
      }
    }
    return sum;
  }

 private:
  std::mt19937 engine_{kSeed};
  std::normal_distribution<double> number_;
};

template <class T>
class RigidBody : public ::testing::Test {};

TYPED_TEST_SUITE(RigidBody, testing::Orientations, testing::OrientationName);

// (10): 2 N along y at the point 3 m ahead of the centre turn with 6 N m about z, wherever the body
// is.
TEST(Wrench, MomentOfAForceIsTakenAboutTheCentreOfMass) {
  const Vector3 p_WB(10.0, 20.0, 30.0);
  const Wrench wrench = wrenchOfForceAt({0.0, 2.0, 0.0}, {13.0, 20.0, 30.0}, p_WB);
  EXPECT_EQ(wrench.force, Vector3(0.0, 2.0, 0.0));
  EXPECT_EQ(wrench.torque, Vector3(0.0, 0.0, 6.0));
}

TEST(Wrench, ForceAlongALineHasTheSameMomentAtEachOfItsPoints) {
  RandomBodies random;
  for (int n = 0; n < kSamples; ++n) {
    const Vector3 force = random.vector();
    const Vector3 point = random.vector();
    const Vector3 p_WB = random.vector();
    const Vector3 further = point + 2.5 * force;
    const Vector3 difference =
        wrenchOfForceAt(force, point, p_WB).torque - wrenchOfForceAt(force, further, p_WB).torque;
    EXPECT_LT(norm(difference), 20.0 * kRounding * (1.0 + squaredNorm(force))) << "sample " << n;
  }
}

// (11): F and M are sums. Two opposite forces, 2 N at ±0.5 m: no force, a couple of 2 N m.
TEST(Wrench, WrenchesOfSeveralForcesAddUp) {
  const Vector3 p_WB(1.0, 1.0, 1.0);
  const Wrench couple = wrenchOfForceAt({0.0, 2.0, 0.0}, {1.5, 1.0, 1.0}, p_WB) +
                        wrenchOfForceAt({0.0, -2.0, 0.0}, {0.5, 1.0, 1.0}, p_WB);
  EXPECT_EQ(couple.force, Vector3(0.0, 0.0, 0.0));
  EXPECT_EQ(couple.torque, Vector3(0.0, 0.0, 2.0));
}

// v + w × (p - x), w = 2 rad/s about z, the point 3 m ahead: v + (0, 6, 0).
TEST(Twist, PointsOfATurningBodyHaveDifferentVelocities) {
  const Twist twist = {{1.0, 0.0, 0.5}, {0.0, 0.0, 2.0}};
  const Vector3 p_WB(5.0, 5.0, 5.0);
  EXPECT_EQ(velocityOfPoint(twist, {8.0, 5.0, 5.0}, p_WB), Vector3(1.0, 6.0, 0.5));
  EXPECT_EQ(velocityOfPoint(twist, {5.0, 8.0, 5.0}, p_WB), Vector3(-5.0, 0.0, 0.5));
  EXPECT_EQ(velocityOfPoint(twist, p_WB, p_WB), twist.v_WB);
}

// Power of a force = F · v(p) = F · v + M · w: (10) and the velocity of a point are dual.
TEST(Twist, PowerOfAForceIsThatOfItsWrench) {
  RandomBodies random;
  for (int n = 0; n < kSamples; ++n) {
    const Twist twist = {random.vector(), random.vector()};
    const Vector3 force = random.vector();
    const Vector3 point = random.vector();
    const Vector3 p_WB = random.vector();
    const Wrench wrench = wrenchOfForceAt(force, point, p_WB);
    EXPECT_NEAR(dot(force, velocityOfPoint(twist, point, p_WB)),
                dot(wrench.force, twist.v_WB) + dot(wrench.torque, twist.w_WB), 100.0 * kRounding)
        << "sample " << n;
  }
}

TYPED_TEST(RigidBody, SpatialMomentaGiveBackTheirVelocities) {
  RandomBodies random;
  for (int n = 0; n < kSamples; ++n) {
    const Matrix3 inertia = random.inertia();
    const Mobility mobility = Mobility::spatial(2.5, inertia);
    const Twist twist = {random.vector(), random.vector()};
    const TypeParam orientation = testing::orientationOf<TypeParam>(random.unit());
    const auto state = mobility.stateOfMotion({1.0, 2.0, 3.0}, orientation, twist);
    EXPECT_EQ(state.p_WB, Vector3(1.0, 2.0, 3.0));
    const Twist back = mobility.twist(state);
    // Î⁻¹ Î costs the condition number of Î, for four random points well below 1e3.
    EXPECT_LT(norm(back.v_WB - twist.v_WB), 4.0 * kRounding) << "sample " << n;
    EXPECT_LT(norm(back.w_WB - twist.w_WB), 1e3 * kRounding * norm(twist.w_WB)) << "sample " << n;
  }
}

// (20): L = Î_W w with Î_W = R Î Rᵀ, and P = m v (18).
TYPED_TEST(RigidBody, AngularMomentumIsTheRotatedTensorTimesAngularVelocity) {
  RandomBodies random;
  for (int n = 0; n < kSamples; ++n) {
    const Matrix3 inertia = random.inertia();
    const Quaternion q_WB = random.unit();
    const Twist twist = {random.vector(), random.vector()};
    const auto state = Mobility::spatial(2.5, inertia)
                           .stateOfMotion(Vector3(Vector3::Zero()),
                                          testing::orientationOf<TypeParam>(q_WB), twist);
    const Matrix3 R_WB = rotationMatrix(q_WB);
    const Matrix3 inertia_W = product(product(R_WB, inertia), Matrix3(R_WB.transpose()));
    EXPECT_LT(norm(state.momentum_W - 2.5 * twist.v_WB), 4.0 * kRounding);
    EXPECT_LT(norm(state.angular_momentum_W - times(inertia_W, twist.w_WB)),
              10.0 * kRounding * inertia.trace() * norm(twist.w_WB))
        << "sample " << n;
  }
}

// Box of 1, 2, 3 kg m² that turns with 2 rad/s about its y axis, which lies along W's z after a
// quarter turn about x: L = 2 kg m² · 2 rad/s along z, T = ½ 2 · 2² = 4 J; and ½ 3 kg (2 m/s)² = 6.
TYPED_TEST(RigidBody, KineticEnergyIsThatOfTranslationAndRotation) {
  const Matrix3 inertia = Vector3(1.0, 2.0, 3.0).asDiagonal();
  const Mobility mobility = Mobility::spatial(3.0, inertia);
  const double half = std::sqrt(0.5);
  const TypeParam orientation =
      testing::orientationOf<TypeParam>(Quaternion{half, {half, 0.0, 0.0}});
  const auto state = mobility.stateOfMotion(Vector3(Vector3::Zero()), orientation,
                                            {{0.0, 2.0, 0.0}, {0.0, 0.0, 2.0}});
  EXPECT_NEAR(state.angular_momentum_W.z(), 4.0, 4.0 * kRounding);
  EXPECT_NEAR(kineticEnergy(state, mobility), 10.0, 10.0 * kRounding);
}

// A body with 1, 2, 3 kg m² whose y axis lies along W's z after a quarter turn about x. Its rotor
// has 0.5 N m s about y. All together does not turn (L = 0): the body turns the other way with
// 0.5/2 rad/s about y, which is W's z, and has ½ 2 · 0.25² J. At rest all of L is the rotor's.
TYPED_TEST(RigidBody, ARotorTurnsItsBodyTheOtherWay) {
  const Mobility mobility = Mobility::spatial(3.0, Vector3(1.0, 2.0, 3.0).asDiagonal());
  const double half = std::sqrt(0.5);
  const TypeParam orientation =
      testing::orientationOf<TypeParam>(Quaternion{half, {half, 0.0, 0.0}});
  const Vector3 rotors_B(0.0, 0.5, 0.0);
  const Vector3 zero = Vector3::Zero();
  RigidBodyState<TypeParam> state;
  state.orientation = orientation;
  EXPECT_LT(norm(mobility.twist(state, rotors_B).w_WB - Vector3(0.0, 0.0, -0.25)), kRounding);
  EXPECT_EQ(mobility.angularVelocityInBody(zero, rotationMatrix(orientation), rotors_B),
            Vector3(0.0, -0.25, 0.0));
  EXPECT_NEAR(kineticEnergy(state, mobility, rotors_B), 0.0625, kRounding);
  const auto resting = mobility.stateOfMotion(zero, orientation, {zero, zero}, rotors_B);
  EXPECT_LT(norm(resting.angular_momentum_W - Vector3(0.0, 0.0, 0.5)), kRounding);
  EXPECT_NEAR(kineticEnergy(resting, mobility, rotors_B), 0.0, kRounding);
  const auto turning = mobility.stateOfMotion(zero, orientation, {zero, {0.0, 0.0, 2.0}}, rotors_B);
  EXPECT_LT(norm(turning.angular_momentum_W - Vector3(0.0, 0.0, 4.5)), 4.0 * kRounding);
}

TYPED_TEST(RigidBody, PlanarStateKeepsOnlyMotionInThePlane) {
  RandomBodies random;
  const Matrix3 inertia = random.inertia();
  const Mobility mobility = Mobility::planar(2.0, inertia);
  const TypeParam yawed = testing::orientationOf<TypeParam>(Quaternion{0.8, {0.0, 0.0, 0.6}});
  const auto state = mobility.stateOfMotion({1.0, 2.0, 3.0}, yawed, {{4.0, 5.0, 6.0}, {7, 8, 9}});
  EXPECT_EQ(state.momentum_W, Vector3(8.0, 10.0, 0.0));
  EXPECT_EQ(mobility.twist(state).v_WB, Vector3(4.0, 5.0, 0.0));
  EXPECT_EQ(state.angular_momentum_W.x(), 0.0);
  EXPECT_EQ(state.angular_momentum_W.y(), 0.0);
}

// In the plane w = (0, 0, w): its bearing takes the moments that products of inertia make, and
// L_z = I_zz w. A spatial body with the same L would turn about another axis.
TYPED_TEST(RigidBody, ProductsOfInertiaDoNotTurnAPlanarBodyOutOfThePlane) {
  Matrix3 inertia;
  inertia << 2.0, 0.3, 0.4,  //
      0.3, 3.0, -0.5,        //
      0.4, -0.5, 4.0;
  const Mobility planar = Mobility::planar(1.0, inertia);
  const Mobility spatial = Mobility::spatial(1.0, inertia);
  const TypeParam yawed = testing::orientationOf<TypeParam>(Quaternion{0.8, {0.0, 0.0, 0.6}});
  const auto state =
      planar.stateOfMotion(Vector3(Vector3::Zero()), yawed, {Vector3::Zero(), {0.0, 0.0, 1.5}});
  EXPECT_NEAR(state.angular_momentum_W.z(), 4.0 * 1.5, 10.0 * kRounding);
  const Twist twist = planar.twist(state);
  EXPECT_EQ(twist.w_WB.x(), 0.0);
  EXPECT_EQ(twist.w_WB.y(), 0.0);
  EXPECT_NEAR(twist.w_WB.z(), 1.5, 4.0 * kRounding);
  EXPECT_GT(norm(spatial.twist(state).w_WB - twist.w_WB), 0.1);
}

TEST(Mobility, PlanarModelDropsForcesAndMomentsOutOfThePlane) {
  const Matrix3 inertia = Matrix3::Identity();
  const Wrench wrench = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  const Wrench planar = Mobility::planar(1.0, inertia).project(wrench);
  EXPECT_EQ(planar.force, Vector3(1.0, 2.0, 0.0));
  EXPECT_EQ(planar.torque, Vector3(0.0, 0.0, 6.0));
  const Wrench spatial = Mobility::spatial(1.0, inertia).project(wrench);
  EXPECT_EQ(spatial.force, wrench.force);
  EXPECT_EQ(spatial.torque, wrench.torque);
}

TEST(Mobility, UncheckedMassOrInertiaIsOurOwnMistake) {
  EXPECT_THROW(Mobility::spatial(0.0, Matrix3::Identity()), std::logic_error);
  EXPECT_THROW(Mobility::spatial(1.0, Matrix3::Zero()), std::logic_error);
  EXPECT_THROW(Mobility::planar(-1.0, Matrix3::Identity()), std::logic_error);
  EXPECT_THROW(Mobility::planar(1.0, Matrix3::Zero()), std::logic_error);
}

}  // namespace
}  // namespace hovercraft
