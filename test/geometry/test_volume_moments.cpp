#include <array>
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/shells.h"
#include "hovercraft_sim/geometry/volume_moments.h"
#include "hovercraft_sim/math/rotation.h"

#include "../support/sample_meshes.h"

namespace hovercraft {
namespace {

using testing::boxMesh;
using testing::joined;
using testing::kOne;
using testing::moved;
using testing::starMesh;
using testing::tetrahedronMesh;
using testing::turnedOver;

double largestEntry(const Matrix3& A) {
  return A.cwiseAbs().maxCoeff();
}

/// Largest difference of two sets of moments, each part relative to the second one's size.
double difference(const VolumeMoments& a, const VolumeMoments& b) {
  const double length = std::sqrt(b.second_about_centroid.trace() / b.volume);
  return std::max({std::abs(a.volume / b.volume - 1.0), norm(a.centroid - b.centroid) / length,
                   largestEntry(a.second_about_centroid - b.second_about_centroid) /
                       largestEntry(b.second_about_centroid)});
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

// A box (a, b, c): ∫ x² dV about its middle = abc a²/12, the products vanish by symmetry.
TEST(VolumeMoments, BoxHasItsClosedForm) {
  const VolumeMoments moments = volumeMoments(boxMesh({1.0, 2.0, 3.0}, {3.0, 5.0, 9.0}));
  EXPECT_NEAR(moments.volume, 36.0, 1e-14);
  EXPECT_LT(norm(moments.centroid - Vector3(2.0, 3.5, 6.0)), 1e-15);
  const Matrix3 expected = Vector3(12.0, 27.0, 108.0).asDiagonal();
  EXPECT_LT(largestEntry(moments.second_about_centroid - expected), 1e-13);
}

// The corner tetrahedron with legs (a, b, c): about the corner ∫ dV = abc/6, ∫ x dV = V a/4, ∫ x²
// dV = V a²/10, ∫ xy dV = V ab/20 (integrals of monomials over a simplex, i! j! k! / (i+j+k+3)!);
// about the centroid V a² (1/10 - 1/16) = 3/80 V a² and V ab (1/20 - 1/16) = -V ab/80.
TEST(VolumeMoments, CornerTetrahedronHasItsClosedForm) {
  const VolumeMoments moments = volumeMoments(loadTriangleMesh("test/data/tetrahedron.stl"));
  const Vector3 legs(1.0, 2.0, 3.0);
  EXPECT_NEAR(moments.volume, 1.0, 1e-15);
  EXPECT_LT(norm(moments.centroid - legs / 4.0), 1e-15);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double expected = (i == j ? 3.0 : -1.0) / 80.0 * legs(i) * legs(j);
      EXPECT_NEAR(moments.second_about_centroid(i, j), expected, 1e-15) << i << j;
    }
  }
}

// For any tetrahedron ∫ r rᵀ dV about the centroid = V/20 Σ rᵢ rᵢᵀ over its corners.
TEST(VolumeMoments, RandomTetrahedraAgreeWithTheCornerFormula) {
  std::mt19937 engine(1);
  for (int n = 0; n < 200; ++n) {
    std::array<Vector3, 4> corners;
    for (Vector3& corner : corners) corner = randomVector(engine, 1.0);
    Matrix3 edges;
    for (int i = 0; i < 3; ++i)
      edges.col(i) = corners[static_cast<std::size_t>(i) + 1] - corners[0];
    if (determinant(edges) < 0.0) {
      std::swap(corners[2], corners[3]);
    }
    VolumeMoments expected;
    expected.volume = std::abs(determinant(edges)) / 6.0;
    expected.centroid = (corners[0] + corners[1] + corners[2] + corners[3]) / 4.0;
    for (const Vector3& corner : corners) {
      const Vector3 r = corner - expected.centroid;
      expected.second_about_centroid += expected.volume / 20.0 * r * r.transpose();
    }
    EXPECT_LT(difference(volumeMoments(tetrahedronMesh(corners)), expected), 1e-12)
        << "sample " << n;
  }
}

// The image of the unit cube about its middle under x -> A x: volume det A, ∫ r rᵀ dV = det A A Aᵀ
// / 12.
TEST(VolumeMoments, RandomParallelepipedsAgreeWithTheirClosedForm) {
  std::mt19937 engine(2);
  for (int n = 0; n < 200; ++n) {
    Matrix3 A;
    for (int column = 0; column < 3; ++column) A.col(column) = randomVector(engine, 1.0);
    if (determinant(A) < 0.0) A = -A;
    const Vector3 p = randomVector(engine, 1.0);
    const VolumeMoments expected{determinant(A), p,
                                 determinant(A) / 12.0 * product(A, A.transpose())};
    EXPECT_LT(difference(volumeMoments(moved(boxMesh(-0.5 * kOne, 0.5 * kOne), A, p)), expected),
              1e-12)
        << "sample " << n;
  }
}

/// The same integrals by another way, as Mirtich (1996) has them: the flux of (x³/3, 0, 0) for ∫ x²
/// dV, of (x² y/2, 0, 0) for ∫ xy dV and so on through each triangle, by a quadrature that is exact
/// up to degree 5 (Radon 1948, seven points).
VolumeMoments momentsByFlux(const TriangleMesh& mesh) {
  const double root = std::sqrt(15.0);
  const std::array<double, 3> at{1.0 / 3.0, (6.0 - root) / 21.0, (6.0 + root) / 21.0};
  const std::array<double, 3> weight{9.0 / 40.0, (155.0 - root) / 1200.0, (155.0 + root) / 1200.0};
  double volume = 0.0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();
  for (const auto& t : mesh.triangles) {
    const Vector3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vector3& b = mesh.vertices[static_cast<std::size_t>(t[1])];
    const Vector3& c = mesh.vertices[static_cast<std::size_t>(t[2])];
    const Vector3 area = 0.5 * cross(b - a, c - a);
    const auto add = [&](const Vector3& x, double w) {
      volume += w * area.x() * x.x();
      for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        first(i) += w * area(i) * x(i) * x(i) / 2.0;
        second(i, i) += w * area(i) * x(i) * x(i) * x(i) / 3.0;
        second(i, j) += w * area(i) * x(i) * x(i) * x(j) / 2.0;
        second(j, i) = second(i, j);
      }
    };
    add(at[0] * (a + b + c), weight[0]);
    for (std::size_t k = 1; k < 3; ++k) {
      const double far = 1.0 - 2.0 * at[k];
      add(far * a + at[k] * (b + c), weight[k]);
      add(far * b + at[k] * (c + a), weight[k]);
      add(far * c + at[k] * (a + b), weight[k]);
    }
  }
  const Vector3 centroid = first / volume;
  return {volume, centroid, second - volume * centroid * centroid.transpose()};
}

TEST(VolumeMoments, RandomConcaveBodiesAgreeWithSurfaceQuadrature) {
  std::mt19937 engine(3);
  for (int n = 0; n < 100; ++n) {
    const TriangleMesh star = starMesh(engine);
    EXPECT_LT(difference(volumeMoments(star), momentsByFlux(star)), 1e-13) << "sample " << n;
  }
}

// Points on a grid of 0.05: a body of about 4 m³ holds 32,000 of them, its surface passes through
// about a fifth of their cells; the sum of so many independent roundings is good to 1 %.
TEST(VolumeMoments, AConcaveBodyAgreesWithCountingPointsInside) {
  std::mt19937 engine(4);
  const TriangleMesh star = starMesh(engine);
  const double step = 0.05;
  VolumeMoments counted;
  Matrix3 second = Matrix3::Zero();
  for (double x = -1.5; x < 1.5; x += step) {
    for (double y = -1.5; y < 1.5; y += step) {
      for (double z = -1.5; z < 1.5; z += step) {
        const Vector3 point(x + 0.013, y + 0.017, z + 0.019);
        if (windingNumber(star, point) < 0.5) continue;
        counted.volume += step * step * step;
        counted.centroid += step * step * step * point;
        second += step * step * step * point * point.transpose();
      }
    }
  }
  counted.centroid /= counted.volume;
  counted.second_about_centroid =
      second - counted.volume * counted.centroid * counted.centroid.transpose();
  EXPECT_LT(difference(volumeMoments(star), counted), 0.01);
}

// 2^n m away a vertex on a grid of 2^(n - 52) m is still exact: nothing but the place may change.
// About the origin the second moments would be 2^(2 n) times larger and lose all their digits.
TEST(VolumeMoments, NothingIsLostFarFromTheOrigin) {
  std::mt19937 engine(5);
  for (const int n : {20, 40}) {
    TriangleMesh star = starMesh(engine);
    const double grid = std::ldexp(1.0, n - 52);
    for (Vector3& vertex : star.vertices) vertex = (vertex / grid).array().round().matrix() * grid;
    const Vector3 far = std::ldexp(1.0, n) * Vector3(1.0, -1.0, 1.0);
    const VolumeMoments here = volumeMoments(star);
    const VolumeMoments there = volumeMoments(moved(star, Matrix3::Identity(), far));
    EXPECT_NEAR(there.volume, here.volume, 2e-15 * here.volume) << n;
    EXPECT_LT(norm(there.centroid - far - here.centroid), grid) << n;
    EXPECT_LT(largestEntry(there.second_about_centroid - here.second_about_centroid),
              5e-15 * largestEntry(here.second_about_centroid))
        << n;
  }
}

// Far from the body's middle there is a thin long spike: the middle of the box around both is not
// the centroid, the spike's own moments are far larger per volume.
TEST(VolumeMoments, NothingIsLostWhereTheCentroidIsFarFromTheMiddle) {
  const VolumeMoments cube = volumeMoments(boxMesh(-kOne, kOne));
  const TriangleMesh spike = boxMesh({1.0e4, 0.0, 0.0}, {1.0e4 + 1.0, 1e-9, 1e-9});
  const VolumeMoments both = volumeMoments(joined(boxMesh(-kOne, kOne), spike));
  // 1e-18 m³ at 1e4 m to 1e4 + 1 m: second moment 1e-18 (1e8 + 1e4 + 1/3) beside 8/3 of the other.
  EXPECT_NEAR(both.second_about_centroid(0, 0) - cube.second_about_centroid(0, 0), 1.0001e-10,
              2e-15);
  EXPECT_NEAR(both.second_about_centroid(1, 1), cube.second_about_centroid(1, 1), 1e-15);
}

TEST(VolumeMoments, ARotatedAndMovedBodyHasRotatedAndMovedMoments) {
  std::mt19937 engine(6);
  for (int n = 0; n < 50; ++n) {
    const TriangleMesh star = starMesh(engine);
    const Matrix3 R = randomRotation(engine);
    const Vector3 p = randomVector(engine, 10.0);
    VolumeMoments expected = volumeMoments(star);
    expected.centroid = times(R, expected.centroid) + p;
    expected.second_about_centroid =
        product(product(R, expected.second_about_centroid), R.transpose());
    EXPECT_LT(difference(volumeMoments(moved(star, R, p)), expected), 1e-14) << "sample " << n;
  }
}

// Lengths times s: volume times s³, second moments times s⁵; a power of two changes no digit.
TEST(VolumeMoments, ScaleWithTheThirdAndTheFifthPowerOfLength) {
  std::mt19937 engine(7);
  const TriangleMesh star = starMesh(engine);
  const VolumeMoments moments = volumeMoments(star);
  const VolumeMoments larger =
      volumeMoments(moved(star, 4.0 * Matrix3::Identity(), Vector3::Zero()));
  EXPECT_EQ(larger.volume, 64.0 * moments.volume);
  EXPECT_EQ(larger.centroid, Vector3(4.0 * moments.centroid));
  EXPECT_EQ(larger.second_about_centroid, Matrix3(1024.0 * moments.second_about_centroid));
}

// Moments of disjoint bodies add about a common point.
TEST(VolumeMoments, TwoBodiesAddUp) {
  std::mt19937 engine(8);
  for (int n = 0; n < 20; ++n) {
    const TriangleMesh a = starMesh(engine);
    const TriangleMesh b = moved(starMesh(engine), randomRotation(engine), {3.5, 0.0, 0.0});
    const VolumeMoments of_a = volumeMoments(a);
    const VolumeMoments of_b = volumeMoments(b);
    VolumeMoments expected;
    expected.volume = of_a.volume + of_b.volume;
    expected.centroid =
        (of_a.volume * of_a.centroid + of_b.volume * of_b.centroid) / expected.volume;
    for (const VolumeMoments& part : {of_a, of_b}) {
      const Vector3 d = part.centroid - expected.centroid;
      expected.second_about_centroid +=
          part.second_about_centroid + part.volume * d * d.transpose();
    }
    EXPECT_LT(difference(volumeMoments(joined(a, b)), expected), 1e-14) << "sample " << n;
  }
}

TEST(VolumeMoments, ACavityIsTakenAway) {
  const TriangleMesh wall = turnedOver(boxMesh({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}));
  const VolumeMoments moments = volumeMoments(joined(boxMesh(-2.0 * kOne, 2.0 * kOne), wall));
  EXPECT_NEAR(moments.volume, 63.0, 1e-13);
  EXPECT_LT(norm(moments.centroid + 0.5 / 63.0 * kOne), 1e-15);
}

// A face may start at any of its corners.
TEST(VolumeMoments, DoNotDependOnTheFirstCornerOfATriangle) {
  std::mt19937 engine(9);
  TriangleMesh star = starMesh(engine);
  const VolumeMoments before = volumeMoments(star);
  for (auto& t : star.triangles) t = {t[1], t[2], t[0]};
  EXPECT_LT(difference(volumeMoments(star), before), 1e-14);
}

TEST(VolumeMoments, TheVolumeOfASurfaceTurnedOverIsNegative) {
  EXPECT_NEAR(signedVolume(turnedOver(boxMesh(Vector3::Zero(), {1.0, 2.0, 3.0}))), -6.0, 1e-14);
  EXPECT_EQ(signedVolume({}), 0.0);
}

TEST(VolumeMoments, AMeshWithoutPositiveVolumeIsOurOwnBug) {
  EXPECT_THROW(volumeMoments({}), std::logic_error);
  EXPECT_THROW(volumeMoments(turnedOver(boxMesh(Vector3::Zero(), kOne))), std::logic_error);
}

}  // namespace
}  // namespace hovercraft
