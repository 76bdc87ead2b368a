#include <random>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/rotation.h"

#include "../support/numbers.h"

namespace hovercraft {
namespace {

using testing::kRounding;

constexpr unsigned kSeed = 20261122;
constexpr int kSamples = 200;

class RandomRotations {
 public:
  Vector3 vector() { return {number_(engine_), number_(engine_), number_(engine_)}; }
  Quaternion unit() { return normalized(Quaternion{number_(engine_), vector()}); }

 private:
  std::mt19937 engine_{kSeed};
  std::normal_distribution<double> number_;
};

double difference(const Quaternion& a, const Quaternion& b) {
  return norm(a + (-1.0) * b);
}

TEST(Quaternion, UnitsMultiplyAsHamiltonCarvedThem) {
  const Quaternion i{0.0, Vector3::UnitX()};
  const Quaternion j{0.0, Vector3::UnitY()};
  const Quaternion k{0.0, Vector3::UnitZ()};
  const Quaternion minus_one{-1.0, Vector3::Zero()};
  EXPECT_EQ(difference(i * i, minus_one), 0.0);
  EXPECT_EQ(difference(j * j, minus_one), 0.0);
  EXPECT_EQ(difference(k * k, minus_one), 0.0);
  EXPECT_EQ(difference(i * (j * k), minus_one), 0.0);
  EXPECT_EQ(difference(i * j, k), 0.0);
  EXPECT_EQ(difference(j * i, -1.0 * k), 0.0);
}

TEST(Quaternion, ConjugateOfAUnitQuaternionIsItsInverse) {
  RandomRotations random;
  for (int n = 0; n < kSamples; ++n) {
    const Quaternion q = random.unit();
    EXPECT_LT(difference(q * conjugate(q), Quaternion::identity()), kRounding) << "sample " << n;
  }
}

TEST(Quaternion, RotatesAsItsMatrixDoes) {
  RandomRotations random;
  for (int n = 0; n < kSamples; ++n) {
    const Quaternion q = random.unit();
    const Vector3 v = random.vector();
    const Vector3 by_matrix = times(rotationMatrix(q), v);
    EXPECT_LT(norm(rotate(q, v) - by_matrix), 4.0 * kRounding * norm(v)) << "sample " << n;
  }
}

TEST(Quaternion, MatrixIsARotation) {
  RandomRotations random;
  for (int n = 0; n < kSamples; ++n) {
    const Matrix3 R = rotationMatrix(random.unit());
    EXPECT_LT(orthogonalityError(R), 2.0 * kRounding) << "sample " << n;
    EXPECT_NEAR(determinant(R), 1.0, 2.0 * kRounding) << "sample " << n;
  }
}

TEST(Quaternion, MatrixOfAProductIsTheProductOfMatrices) {
  RandomRotations random;
  for (int n = 0; n < kSamples; ++n) {
    const Quaternion a = random.unit();
    const Quaternion b = random.unit();
    const Matrix3 expected = product(rotationMatrix(a), rotationMatrix(b));
    EXPECT_LT((rotationMatrix(a * b) - expected).cwiseAbs().maxCoeff(), 2.0 * kRounding);
  }
}

// Rotation by theta about one axis: [cos theta/2, sin theta/2 u] against (2), (3), (4). The matrix
// (3) holds +sin in row 1, column 3: the sign that the source's R(q) has lost.
TEST(Quaternion, AxisAngleMatchesTheElementaryRotations) {
  for (const double theta : {-3.0, -1.0, 1e-8, 0.3, kPi / 2, 3.1}) {
    const Matrix3 x = rotationMatrix(quaternionFromAxisAngle(Vector3::UnitX(), theta));
    const Matrix3 y = rotationMatrix(quaternionFromAxisAngle(Vector3::UnitY(), theta));
    const Matrix3 z = rotationMatrix(quaternionFromAxisAngle(Vector3::UnitZ(), theta));
    EXPECT_LT((x - rotationX(theta)).cwiseAbs().maxCoeff(), kRounding) << theta;
    EXPECT_LT((y - rotationY(theta)).cwiseAbs().maxCoeff(), kRounding) << theta;
    EXPECT_LT((z - rotationZ(theta)).cwiseAbs().maxCoeff(), kRounding) << theta;
  }
}

TEST(Quaternion, FromMatrixInvertsMatrixUpToSign) {
  RandomRotations random;
  for (int n = 0; n < kSamples; ++n) {
    const Quaternion q = random.unit();
    const Quaternion back = quaternionFromMatrix(rotationMatrix(q));
    EXPECT_LT(angleBetween(q, back), 4.0 * kRounding) << "sample " << n;
  }
}

// Half turns have s = 0: each of Shepperd's three vector branches.
TEST(Quaternion, FromMatrixHoldsAtHalfTurns) {
  for (const Vector3& axis : {Vector3(Vector3::UnitX()), Vector3(Vector3::UnitY()),
                              Vector3(Vector3::UnitZ()), Vector3(0.6, 0.0, 0.8)}) {
    const Quaternion q = {0.0, axis};
    EXPECT_LT(angleBetween(q, quaternionFromMatrix(rotationMatrix(q))), 2.0 * kRounding);
  }
}

TEST(Quaternion, RpyRoundTripsAndAgreesWithMatrices) {
  const Vector3 rpy(0.4, -1.2, 2.9);
  const Quaternion q = quaternionFromRpy(rpy);
  EXPECT_LT((rotationMatrix(q) - rotationFromRpy(rpy)).cwiseAbs().maxCoeff(), kRounding);
  EXPECT_LT(norm(rpyFromQuaternion(q) - rpy), 4.0 * kRounding);
}

// (27): the derivative of q(t + h) = exp(h w / 2) q by a central difference, error h^2 |w|^3 / 48.
TEST(Quaternion, WorldRateIsTheDerivativeOfARotationInTheWorld) {
  RandomRotations random;
  constexpr double step = 1e-4;
  for (int n = 0; n < kSamples; ++n) {
    const Quaternion q = random.unit();
    const Vector3 w = random.vector();
    const double speed = norm(w);
    const Quaternion ahead = quaternionFromAxisAngle(w / speed, step * speed) * q;
    const Quaternion behind = quaternionFromAxisAngle(w / speed, -step * speed) * q;
    const Quaternion slope = (0.5 / step) * (ahead + (-1.0) * behind);
    EXPECT_LT(difference(quaternionRateWorld(w, q), slope),
              1e-11 + step * step * std::pow(speed, 3));
  }
}

TEST(Quaternion, BodyRateEqualsWorldRateOfTheRotatedVelocity) {
  RandomRotations random;
  for (int n = 0; n < kSamples; ++n) {
    const Quaternion q = random.unit();
    const Vector3 w_B = random.vector();
    const Quaternion expected = quaternionRateWorld(rotate(q, w_B), q);
    EXPECT_LT(difference(quaternionRateBody(q, w_B), expected), 4.0 * kRounding * norm(w_B));
  }
}

TEST(Elementary, ValuesAreTheNearestDoubles) {
  // Each literal is the true value to 20 digits (Abramowitz and Stegun, tables 4.1 and 4.6), so the
  // compiler rounds it to the nearest double.
  EXPECT_EQ(exactExp(1.0), 2.7182818284590452354);
  EXPECT_EQ(exactExp(-1.0), 0.36787944117144232160);
  EXPECT_EQ(exactLog(10.0), 2.3025850929940456840);
  EXPECT_EQ(exactLog(0.1), -2.3025850929940456284);  // of the double next to 0.1
  EXPECT_EQ(exactLog(1.0), 0.0);
  EXPECT_EQ(exactSin(1.0), 0.84147098480789650665);
  EXPECT_EQ(exactCos(1.0), 0.54030230586813971740);
  EXPECT_EQ(exactAtan2(1.0, 1.0), 0.78539816339744830962);
  EXPECT_EQ(exactAsin(1.0), 1.5707963267948966192);
  EXPECT_EQ(exactExp(0.0), 1.0);
  EXPECT_EQ(exactSin(0.0), 0.0);
}

}  // namespace
}  // namespace hovercraft
