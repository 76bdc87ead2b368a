#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <stdexcept>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "hovercraft_sim/body/mass_properties.h"
#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/rotation.h"

#include "../support/sample_meshes.h"

namespace hovercraft {
namespace {

using testing::boxMesh;
using testing::joined;
using testing::moved;
using testing::starMesh;
using testing::turnedOver;

double largestEntry(const Matrix3& A) {
  return A.cwiseAbs().maxCoeff();
}

Matrix3 diagonal(double xx, double yy, double zz) {
  return Vector3(xx, yy, zz).asDiagonal();
}

/// Largest difference of two bodies, each part relative to the second one's size.
double difference(const MassProperties& a, const MassProperties& b) {
  const double length = std::sqrt(b.I_BBo_B.trace() / b.mass);
  return std::max({std::abs(a.mass / b.mass - 1.0), norm(a.p_HB - b.p_HB) / length,
                   largestEntry(a.I_BBo_B - b.I_BBo_B) / largestEntry(b.I_BBo_B)});
}

Vector3 randomVector(std::mt19937& engine, double size) {
  std::uniform_real_distribution<double> number(-size, size);
  const double x = number(engine);
  const double y = number(engine);
  return {x, y, number(engine)};
}

Matrix3 randomRotation(std::mt19937& engine) {
  return rotationFromRpy(randomVector(engine, 3.0));
}

MassProperties randomlyPlaced(std::mt19937& engine, const MassProperties& part, double distance) {
  const Matrix3 R = randomRotation(engine);
  return placed(part, R, randomVector(engine, distance));
}

std::string messageOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

// ∫ (y² + z²) dm over a box (a, b, c) = m (b² + c²)/12: 12/12 (4 + 9), (9 + 1), (1 + 4).
TEST(MassProperties, BoxHasItsClosedForm) {
  const MassProperties box = boxMassProperties(12.0, {1.0, 2.0, 3.0});
  EXPECT_EQ(box.mass, 12.0);
  EXPECT_EQ(box.p_HB, Vector3(Vector3::Zero()));
  EXPECT_EQ(box.I_BBo_B, diagonal(13.0, 10.0, 5.0));
  EXPECT_EQ(boxVolume({1.0, 2.0, 3.0}), 6.0);
}

/// A body of revolution of density 1 kg/m³ about z as a stack of discs, r²(z) from z = -h/2 to h/2.
/// A disc of thickness dz has dm = π r² dz, dIzz = dm r²/2, about the origin dIxx = dm (r²/4 + z²).
/// Where r² is a polynomial of degree 2 the integrands have degree 4: three Gauss points are exact.
MassProperties stackOfDiscs(const std::function<double(double)>& squared_radius, double h) {
  const std::array<double, 3> at{-std::sqrt(0.6), 0.0, std::sqrt(0.6)};
  const std::array<double, 3> weight{5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};
  double mass = 0.0;
  double first = 0.0;
  double axial = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double z = 0.5 * h * at[i];
    const double squared = squared_radius(z);
    const double dm = 0.5 * h * weight[i] * kPi * squared;
    mass += dm;
    first += dm * z;
    axial += dm * squared / 2.0;
    across += dm * (squared / 4.0 + z * z);
  }
  const double center = first / mass;
  across -= mass * center * center;
  return {mass, {0.0, 0.0, center}, diagonal(across, across, axial)};
}

TEST(MassProperties, SphereIsAStackOfDiscs) {
  const double r = 0.7;
  const MassProperties discs = stackOfDiscs([=](double z) { return r * r - z * z; }, 2.0 * r);
  EXPECT_LT(difference(sphereMassProperties(sphereVolume(r), r), discs), 1e-15);
  // 2/5 m r²: a solid ball, not a shell.
  EXPECT_NEAR(sphereMassProperties(5.0, 3.0).I_BBo_B(1, 1), 18.0, 1e-14);
}

TEST(MassProperties, CylinderIsAStackOfDiscs) {
  const double r = 0.7;
  const double h = 1.9;
  const MassProperties discs = stackOfDiscs([=](double) { return r * r; }, h);
  EXPECT_LT(difference(cylinderMassProperties(cylinderVolume(r, h), r, h), discs), 1e-15);
  // m r²/2 about the axis, m (3 r² + h²)/12 across: 12/2 * 4, 12/12 * (12 + 9).
  EXPECT_EQ(cylinderMassProperties(12.0, 2.0, 3.0).I_BBo_B, diagonal(21.0, 21.0, 24.0));
}

TEST(MassProperties, ConeIsAStackOfDiscs) {
  const double r = 0.7;
  const double h = 1.9;
  const MassProperties discs =
      stackOfDiscs([=](double z) { return std::pow(r * (0.5 - z / h), 2); }, h);
  EXPECT_LT(difference(coneMassProperties(coneVolume(r, h), r, h), discs), 1e-15);
  // 3/10 m r² about the axis, 3/80 m (4 r² + h²) across, a quarter of the height above the base.
  const MassProperties cone = coneMassProperties(80.0, 1.0, 4.0);
  EXPECT_LT(largestEntry(cone.I_BBo_B - diagonal(60.0, 60.0, 24.0)), 1e-13);
  EXPECT_EQ(cone.p_HB, Vector3(0.0, 0.0, -1.0));
}

TEST(MassProperties, NumbersThatAreNotPositiveAreNamed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const PolygonMesh cube = boxMesh({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  EXPECT_EQ(messageOf([&] {
              boxMassProperties(-1.0, {1.0, 1.0, 1.0});
            }),
            "mass = -1 kg: must be positive and finite");
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 flat = Vector3::Ones() - Vector3::Unit(axis);
    EXPECT_EQ(messageOf([&] { boxMassProperties(1.0, flat); }),
              "size = 0 m: must be positive and finite");
  }
  EXPECT_EQ(messageOf([&] { sphereMassProperties(1.0, nan); }),
            "radius = nan m: must be positive and finite");
  EXPECT_EQ(messageOf([&] { sphereMassProperties(0.0, 1.0); }),
            "mass = 0 kg: must be positive and finite");
  EXPECT_EQ(messageOf([&] { cylinderMassProperties(1.0, -2.0, 1.0); }),
            "radius = -2 m: must be positive and finite");
  EXPECT_EQ(messageOf([&] { cylinderMassProperties(1.0, 1.0, infinity); }),
            "length = inf m: must be positive and finite");
  EXPECT_EQ(messageOf([&] { coneMassProperties(1.0, 1.0, -3.0); }),
            "length = -3 m: must be positive and finite");
  EXPECT_EQ(messageOf([&] { meshMassProperties(cube, 0.0); }),
            "mass = 0 kg: must be positive and finite");
  EXPECT_EQ(messageOf([&] { meshMassPropertiesOfDensity(cube, -7.5); }),
            "density = -7.5 kg/m^3: must be positive and finite");
}

TEST(MassProperties, AMeshOfABoxIsABox) {
  const Vector3 low(1.0, -2.0, 0.5);
  const Vector3 size(0.3, 4.0, 2.0);
  const MassProperties expected =
      placed(boxMassProperties(7.0, size), Matrix3::Identity(), low + 0.5 * size);
  EXPECT_LT(difference(meshMassProperties(boxMesh(low, low + size), 7.0), expected), 1e-15);
}

TEST(MassProperties, DensityTimesVolumeIsTheMass) {
  const PolygonMesh box = boxMesh({0.0, 0.0, 0.0}, {1.0, 2.0, 3.0});
  const MassProperties by_density = meshMassPropertiesOfDensity(box, 500.0);
  EXPECT_NEAR(by_density.mass, 3000.0, 1e-12);
  EXPECT_LT(difference(meshMassProperties(box, 3000.0), by_density), 1e-15);
}

// l_shape.obj: [0,3] x [0,1] and [0,1] x [1,2], 0.5 high.
TEST(MassProperties, AMeshOfAnLIsAnLOfBoxes) {
  const double density = 3.0;
  const Matrix3 upright = Matrix3::Identity();
  const MassProperties foot =
      placed(boxMassProperties(1.5 * density, {3.0, 1.0, 0.5}), upright, {1.5, 0.5, 0.25});
  const MassProperties leg =
      placed(boxMassProperties(0.5 * density, {1.0, 1.0, 0.5}), upright, {0.5, 1.5, 0.25});
  const MassProperties mesh =
      meshMassPropertiesOfDensity(loadClosedMesh("test/data/l_shape.obj").mesh, density);
  EXPECT_LT(difference(mesh, composed({foot, leg})), 1e-15);
  // -∫ xy dm: 4.5 kg at (0.25, -0.25), 1.5 kg at (-0.75, 0.75) from the centre (1.25, 0.75).
  EXPECT_NEAR(mesh.I_BBo_B(0, 1), 4.5 * 0.0625 + 1.5 * 0.5625, 1e-15);
}

TEST(MassProperties, ACavityIsABodyOfNegativeMass) {
  const PolygonMesh outer = boxMesh({-2.0, -1.0, -1.0}, {2.0, 1.0, 1.0});
  const PolygonMesh wall = turnedOver(boxMesh({0.0, -0.5, -0.5}, {1.5, 0.5, 0.5}));
  MassProperties hole =
      placed(boxMassProperties(1.5, {1.5, 1.0, 1.0}), Matrix3::Identity(), {0.75, 0.0, 0.0});
  hole.mass = -hole.mass;
  hole.I_BBo_B = -hole.I_BBo_B;
  EXPECT_LT(difference(meshMassPropertiesOfDensity(joined(outer, wall), 1.0),
                       composed({boxMassProperties(16.0, {4.0, 2.0, 2.0}), hole})),
            1e-15);
}

TEST(MassProperties, PlacingTurnsTheBodyAsItTurnsItsMesh) {
  std::mt19937 engine(1);
  for (int n = 0; n < 50; ++n) {
    const PolygonMesh star = starMesh(engine);
    const Matrix3 R = randomRotation(engine);
    const Vector3 p = randomVector(engine, 5.0);
    const MassProperties turned = placed(meshMassProperties(star, 2.0), R, p);
    EXPECT_LT(difference(turned, meshMassProperties(moved(star, R, p), 2.0)), 1e-14)
        << "sample " << n;
    EXPECT_EQ(turned.I_BBo_B, Matrix3(turned.I_BBo_B.transpose())) << "sample " << n;
  }
}

TEST(MassProperties, PlacingThereAndBackChangesNothing) {
  std::mt19937 engine(2);
  const MassProperties body = meshMassProperties(starMesh(engine), 3.0);
  const Matrix3 R = randomRotation(engine);
  const Vector3 p = randomVector(engine, 5.0);
  const Matrix3 back = R.transpose();
  EXPECT_LT(difference(placed(placed(body, R, p), back, -times(back, p)), body), 1e-14);
}

TEST(MassProperties, ASinglePartComesBackToTheLastBit) {
  std::mt19937 engine(3);
  const MassProperties part = randomlyPlaced(engine, boxMassProperties(0.1, {0.3, 0.7, 1.1}), 1e6);
  const MassProperties whole = composed({part});
  EXPECT_EQ(whole.mass, part.mass);
  EXPECT_EQ(whole.p_HB, part.p_HB);
  EXPECT_EQ(whole.I_BBo_B, part.I_BBo_B);
}

// Two balls of 1 and 3 kg, 4 m apart on x: the centre 3 m from the first; across the line
// 1 * 9 + 3 * 1 = 12 kg m² more than the balls' own 0.4 (1 + 3).
TEST(MassProperties, PartsAddUpByTheParallelAxisTheorem) {
  const Matrix3 upright = Matrix3::Identity();
  const MassProperties light = placed(sphereMassProperties(1.0, 1.0), upright, {1.0, 0.0, 0.0});
  const MassProperties heavy = placed(sphereMassProperties(3.0, 1.0), upright, {5.0, 0.0, 0.0});
  const MassProperties both = composed({light, heavy});
  EXPECT_EQ(both.mass, 4.0);
  EXPECT_LT(norm(both.p_HB - Vector3(4.0, 0.0, 0.0)), 1e-15);
  EXPECT_LT(largestEntry(both.I_BBo_B - diagonal(1.6, 13.6, 13.6)), 1e-14);
}

TEST(MassProperties, CompositionDoesNotDependOnOrderOrGrouping) {
  std::mt19937 engine(4);
  std::array<MassProperties, 3> parts;
  double mass = 0.0;
  for (MassProperties& part : parts) {
    mass += 1.0;
    part = randomlyPlaced(engine, boxMassProperties(mass, {1.0, 2.0, 0.5}), 3.0);
  }
  const MassProperties whole = composed({parts[0], parts[1], parts[2]});
  EXPECT_LT(difference(composed({parts[2], parts[0], parts[1]}), whole), 1e-15);
  EXPECT_LT(difference(composed({composed({parts[0], parts[1]}), parts[2]}), whole), 1e-15);
}

// Places on a grid of 2^-20 m are still exact 2^30 m away: no bit of the tensor may change.
TEST(MassProperties, CompositionLosesNothingFarFromTheOrigin) {
  std::mt19937 engine(5);
  const Vector3 far = std::ldexp(1.0, 30) * Vector3(1.0, 1.0, -1.0);
  std::array<MassProperties, 2> here;
  std::array<MassProperties, 2> there;
  for (std::size_t i = 0; i < 2; ++i) {
    here[i] = randomlyPlaced(engine, boxMassProperties(0.1, {1.0, 2.0, 0.5}), 3.0);
    const double grid = std::ldexp(1.0, -20);
    here[i].p_HB = (here[i].p_HB / grid).array().round().matrix() * grid;
    there[i] = placed(here[i], Matrix3::Identity(), far);
  }
  EXPECT_EQ(composed({there[0], there[1]}).I_BBo_B, composed({here[0], here[1]}).I_BBo_B);
}

TEST(MassProperties, NoPartsAreRefused) {
  EXPECT_EQ(messageOf([] { composed({}); }), "parts: there must be at least one");
}

TEST(CheckInertia, EverySolidPasses) {
  std::mt19937 engine(6);
  for (int n = 0; n < 50; ++n) {
    const Matrix3 R = randomRotation(engine);
    for (const MassProperties& solid :
         {boxMassProperties(2.0, {1.0, 1e-4, 0.2}), sphereMassProperties(1e-3, 1e-3),
          cylinderMassProperties(5.0, 1e-3, 2.0), coneMassProperties(5.0, 2.0, 1e-3),
          meshMassProperties(starMesh(engine), 1e6)}) {
      EXPECT_NO_THROW(checkInertia(placed(solid, R, {0.0, 0.0, 0.0}).I_BBo_B, "inertia"))
          << "sample " << n;
    }
  }
}

// A lamina meets the triangle inequality with equality: Izz = Ixx + Iyy.
TEST(CheckInertia, ALaminaPasses) {
  EXPECT_EQ(messageOf([] { checkInertia(diagonal(0.1, 0.2, 0.1 + 0.2), "inertia"); }), "no error");
  // A plate of 1 kg, 0.632456 m by 1 m, to six digits: the largest is 3.4e-6 too large.
  EXPECT_EQ(messageOf([] { checkInertia(diagonal(0.0333333, 0.0833333, 0.116667), "inertia"); }),
            "no error");
}

TEST(CheckInertia, AnEntryThatIsNotFiniteIsNamed) {
  Matrix3 tensor = diagonal(1.0, 1.0, 1.0);
  tensor(0, 2) = tensor(2, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(messageOf([&] { checkInertia(tensor, "inertia"); }),
            "inertia: ixz = nan kg m^2: must be finite");
  tensor = diagonal(1.0, std::numeric_limits<double>::infinity(), 1.0);
  EXPECT_EQ(messageOf([&] { checkInertia(tensor, "hull"); }),
            "hull: iyy = inf kg m^2: must be finite");
  tensor = diagonal(1.0, 1.0, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(messageOf([&] { checkInertia(tensor, "hull"); }),
            "hull: izz = -inf kg m^2: must be finite");
}

TEST(CheckInertia, ATensorThatIsNotSymmetricIsRefused) {
  Matrix3 tensor = diagonal(1.0, 1.0, 1.0);
  tensor(0, 1) = 0.25;
  EXPECT_EQ(messageOf([&] { checkInertia(tensor, "inertia"); }),
            "inertia: must be symmetric, but ixy = 0.25 kg m^2 and iyx = 0 kg m^2");
}

// Six digits of the largest entry: 1e-5 of 1e6 kg m^2 is nothing, of 1e-3 kg m^2 all there is.
TEST(CheckInertia, SymmetryIsThatOfSixDigitsWhateverTheSize) {
  for (const double size : {1e-3, 1.0, 1e6}) {
    Matrix3 tensor = diagonal(size, size, size);
    tensor(0, 1) = 0.9e-5 * size;
    EXPECT_EQ(messageOf([&] { checkInertia(tensor, "inertia"); }), "no error") << size;
    tensor(0, 1) = 1.1e-5 * size;
    EXPECT_NE(messageOf([&] { checkInertia(tensor, "inertia"); }), "no error") << size;
  }
}

TEST(CheckInertia, AMomentThatIsNotPositiveIsRefused) {
  EXPECT_EQ(messageOf([] { checkInertia(diagonal(1.0, -0.5, 1.0), "inertia"); }),
            "inertia: must be positive definite: its smallest principal moment is -0.5 kg m^2");
  EXPECT_EQ(messageOf([] { checkInertia(Matrix3::Zero(), "inertia"); }),
            "inertia: must be positive definite: its smallest principal moment is 0 kg m^2");
  EXPECT_NE(messageOf([] { checkInertia(diagonal(1.0, 1.0, 0.0), "inertia"); }), "no error");
}

// [1 2; 2 1] has the eigenvalues 3 and -1, although every entry is positive.
TEST(CheckInertia, ProductsOfInertiaCanMakeAMomentNegative) {
  Matrix3 tensor = diagonal(1.0, 1.0, 3.0);
  tensor(0, 1) = tensor(1, 0) = 2.0;
  const std::string message = messageOf([&] { checkInertia(tensor, "inertia"); });
  EXPECT_EQ(message.find("inertia: must be positive definite"), 0U) << message;
}

TEST(CheckInertia, AMomentLargerThanTheOtherTwoIsRefused) {
  EXPECT_EQ(messageOf([] { checkInertia(diagonal(1.0, 4.0, 2.0), "inertia"); }),
            "inertia: its largest principal moment is 4 kg m^2: must be at most 3 kg m^2, the sum "
            "of the other two");
  EXPECT_NE(messageOf([] { checkInertia(diagonal(1.0, 3.0001, 2.0), "inertia"); }), "no error");
}

// The triangle inequality is one of principal moments: it may fail where the entries meet it.
// diag(1, 1, 3) turned by 45° about x has the diagonal (1, 2, 2).
TEST(CheckInertia, TheTriangleInequalityHoldsInEveryFrame) {
  const Matrix3 R = rotationX(kPi / 4.0);
  const Matrix3 tensor = product(product(R, diagonal(1.0, 1.0, 3.0)), R.transpose());
  EXPECT_LT(tensor(2, 2), 2.1);
  const std::string message = messageOf([&] { checkInertia(tensor, "inertia"); });
  EXPECT_NE(message.find("the sum of the other two"), std::string::npos) << message;
}

TEST(PrincipalInertia, MomentsAscendAndAxesAreRightHanded) {
  const PrincipalInertia principal = principalInertia(diagonal(3.0, 1.0, 2.0));
  EXPECT_LT(norm(principal.moments - Vector3(1.0, 2.0, 3.0)), 1e-15);
  Matrix3 expected;           // columns y, z, x
  expected << 0.0, 0.0, 1.0,  //
      1.0, 0.0, 0.0,          //
      0.0, 1.0, 0.0;
  EXPECT_LT(largestEntry(principal.axes - expected), 1e-15);
}

// Whatever axes a body is turned by, its principal axes turn with it up to their signs, which
// follow the rule of the header.
TEST(PrincipalInertia, AxesTurnWithTheBody) {
  std::mt19937 engine(7);
  const Vector3 moments(1.0, 1.5, 2.0);
  for (int n = 0; n < 200; ++n) {
    const Matrix3 R = randomRotation(engine);
    const Matrix3 tensor = product(product(R, diagonal(1.0, 1.5, 2.0)), R.transpose());
    const PrincipalInertia principal = principalInertia(tensor);
    EXPECT_LT(norm(principal.moments - moments), 1e-14) << "sample " << n;
    EXPECT_NEAR(principal.axes.determinant(), 1.0, 1e-14) << "sample " << n;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(std::abs(principal.axes.col(i).dot(R.col(i))), 1.0, 1e-14) << "sample " << n;
    }
    for (int i = 0; i < 2; ++i) {
      int first = 0;
      while (std::abs(principal.axes(first, i)) <= 0.57) ++first;
      EXPECT_GT(principal.axes(first, i), 0.0) << "sample " << n;
    }
  }
}

// An axis along (1, -1, 0)/√2 has two components of the same size: rounding must not choose.
TEST(PrincipalInertia, RoundingDoesNotChooseTheSign) {
  for (const double nudge : {-1e-13, 0.0, 1e-13}) {
    const Matrix3 R = rotationZ(-kPi / 4.0 + nudge);
    const Matrix3 tensor = product(product(R, diagonal(1.0, 1.5, 2.0)), R.transpose());
    const Vector3 axis = principalInertia(tensor).axes.col(0);
    EXPECT_LT(norm(axis - Vector3(1.0, -1.0, 0.0) / std::sqrt(2.0)), 1e-12);
  }
}

}  // namespace
}  // namespace hovercraft
