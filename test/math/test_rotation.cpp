#include <random>
#include <stdexcept>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/rotation.h"

namespace hovercraft {
namespace {

Matrix3 commutator(double a, double b) {
  return product(rotationX(a), rotationY(b)) - product(rotationY(b), rotationX(a));
}

// The source's exercise (5): R1 R2 != R2 R1.
TEST(Rotation, RotationsAboutDifferentAxesDoNotCommute) {
  EXPECT_GT(commutator(0.3, 0.4).cwiseAbs().maxCoeff(), 0.1);
  EXPECT_GT(commutator(kPi / 2, kPi / 2).cwiseAbs().maxCoeff(), 0.9);
}

// ... but half turns about perpendicular axes do (errata 15).
TEST(Rotation, HalfTurnsAboutPerpendicularAxesCommute) {
  EXPECT_LT(commutator(kPi, kPi).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Rotation, QuarterTurnsFollowTheRightHandRule) {
  EXPECT_LT(norm(times(rotationX(kPi / 2), Vector3::UnitY()) - Vector3::UnitZ()), 1e-15);
  EXPECT_LT(norm(times(rotationY(kPi / 2), Vector3::UnitZ()) - Vector3::UnitX()), 1e-15);
  EXPECT_LT(norm(times(rotationZ(kPi / 2), Vector3::UnitX()) - Vector3::UnitY()), 1e-15);
}

TEST(Rotation, SkewMatrixIsTheCrossProduct) {
  const Vector3 w(0.3, -2.0, 5.0);
  const Vector3 r(-1.0, 0.7, 0.2);
  EXPECT_EQ(times(skew(w), r), cross(w, r));
  EXPECT_EQ(skew(w).transpose(), -skew(w));
}

TEST(Rotation, RateIsTheSkewMatrixTimesR) {
  const Matrix3 R = rotationFromRpy({0.1, 0.2, 0.3});
  const Vector3 w(1.0, -2.0, 3.0);
  EXPECT_LT((rotationRate(w, R) - product(skew(w), R)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Rotation, NearestRotationLeavesARotationAlone) {
  const Matrix3 R = rotationFromRpy({1.0, -0.5, 2.0});
  EXPECT_LT((nearestRotation(R) - R).cwiseAbs().maxCoeff(), 1e-15);
}

// R (1 + S) with S symmetric has the polar factors R and (1 + S): R is what must come back.
TEST(Rotation, NearestRotationIsThePolarFactor) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> number(-0.25, 0.25);
  for (int n = 0; n < 100; ++n) {
    const Matrix3 R = rotationFromRpy({4 * number(engine), 4 * number(engine), 8 * number(engine)});
    Matrix3 S;
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) S(i, j) = S(j, i) = number(engine);
    }
    const Matrix3 stretched = product(R, Matrix3(Matrix3::Identity() + S));
    EXPECT_LT((nearestRotation(stretched) - R).cwiseAbs().maxCoeff(), 3e-15) << "sample " << n;
  }
}

TEST(Rotation, NearestRotationRefusesAReflection) {
  const Matrix3 reflection = Vector3(1.0, 1.0, -1.0).asDiagonal();
  EXPECT_THROW(nearestRotation(reflection), std::logic_error);
  EXPECT_THROW(nearestRotation(Matrix3::Zero()), std::logic_error);
}

TEST(Vector, InverseAndCofactorsAgreeWithTheirDefinition) {
  Matrix3 A;
  A << 2.0, -1.0, 0.5,  //
      0.3, 4.0, 1.0,    //
      -0.7, 0.2, 3.0;
  EXPECT_LT((product(inverse(A), A) - Matrix3::Identity()).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_NEAR(determinant(A), A.determinant(), 1e-13);
}

}  // namespace
}  // namespace hovercraft
