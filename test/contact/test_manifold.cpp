#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "hovercraft_sim/contact/manifold.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/math/rotation.h"

namespace hovercraft {
namespace {

constexpr double kGap = 1e-7;   // m
constexpr double kBand = 1e-6;  // m

ContactManifold manifoldOf(const ConvexPolyhedron& A, const Pose& X_WA, const ConvexPolyhedron& B,
                           const Pose& X_WB) {
  FeaturePair pair;
  return contactManifold(A, X_WA, B, X_WB, closestFeatures(A, X_WA, B, X_WB, pair), kBand);
}

Pose poseOf(const Vector3& rpy, const Vector3& p) {
  return {rotationFromRpy(rpy), p};
}

const ConvexPolyhedron& floorBox() {
  static const ConvexPolyhedron body = boxPolyhedron(Vector3(10.0, 10.0, 1.0));
  return body;
}

TEST(Manifold, AFaceOnAFaceTouchesInItsFourCorners) {
  const ConvexPolyhedron box = boxPolyhedron(Vector3(0.4, 0.2, 0.2));
  const Pose X_WB = poseOf(Vector3(0.0, 0.0, 0.3), Vector3(1.0, 2.0, 0.6 + kGap));
  for (const bool swapped : {false, true}) {
    const ContactManifold manifold = swapped ? manifoldOf(box, X_WB, floorBox(), Pose())
                                             : manifoldOf(floorBox(), Pose(), box, X_WB);
    ASSERT_EQ(manifold.count, 4);
    EXPECT_NEAR(manifold.nhat_AB_W.z(), swapped ? -1.0 : 1.0, 1e-15);
    for (int i = 0; i < 4; ++i) {
      const ContactPoint& point = manifold.points[static_cast<std::size_t>(i)];
      EXPECT_NEAR(point.gap, kGap, 1e-14);
      EXPECT_NEAR(point.p_WC.z(), 0.5 + 0.5 * kGap, 1e-14);
      const Vector3 p_B = inverseTransform(X_WB, point.p_WC);
      EXPECT_NEAR(std::abs(p_B.x()), 0.2, 1e-14);
      EXPECT_NEAR(std::abs(p_B.y()), 0.1, 1e-14);
    }
  }
}

TEST(Manifold, FacesThatHangOverTouchInTheCommonArea) {
  const ConvexPolyhedron box = boxPolyhedron(Vector3(1.0, 1.0, 1.0));
  const Pose X_WB = poseOf(Vector3::Zero(), Vector3(0.75, 0.25, 1.0 + kGap));
  const ContactManifold manifold = manifoldOf(box, Pose(), box, X_WB);
  ASSERT_EQ(manifold.count, 4);
  for (int i = 0; i < 4; ++i) {
    const Vector3& p = manifold.points[static_cast<std::size_t>(i)].p_WC;
    EXPECT_NEAR(std::abs(p.x() - 0.375), 0.125, 1e-14);  // from 0.25 to 0.5
    EXPECT_NEAR(std::abs(p.y() - 0.125), 0.375, 1e-14);  // from -0.25 to 0.5
  }
}

TEST(Manifold, AnEdgeOnAFaceTouchesInItsTwoEnds) {
  const ConvexPolyhedron box = boxPolyhedron(Vector3(0.4, 0.2, 0.2));
  const double height = 0.1 * std::sqrt(2.0);
  const Pose X_WB =
      poseOf(Vector3(0.25 * 3.14159265358979323846, 0.0, 0.0), Vector3(0.0, 0.0, 0.5 + height));
  Pose lifted = X_WB;
  lifted.p_AB.z() += kGap;
  const ContactManifold manifold = manifoldOf(floorBox(), Pose(), box, lifted);
  ASSERT_EQ(manifold.count, 2);
  for (int i = 0; i < 2; ++i) {
    const Vector3& p = manifold.points[static_cast<std::size_t>(i)].p_WC;
    EXPECT_NEAR(std::abs(p.x()), 0.2, 1e-14);
    EXPECT_NEAR(p.y(), 0.0, 1e-14);
  }
}

TEST(Manifold, ParallelEdgesTouchInTheEndsOfTheirCommonPart) {
  const ConvexPolyhedron box = boxPolyhedron(Vector3(0.4, 0.2, 0.2));
  const double height = 0.2 * std::sqrt(2.0);
  const Vector3 roll(0.25 * 3.14159265358979323846, 0.0, 0.0);
  const ContactManifold manifold = manifoldOf(box, poseOf(roll, Vector3::Zero()), box,
                                              poseOf(roll, Vector3(0.1, 0.0, height + kGap)));
  ASSERT_EQ(manifold.count, 2);
  const double x0 = manifold.points[0].p_WC.x();
  const double x1 = manifold.points[1].p_WC.x();
  EXPECT_NEAR(std::min(x0, x1), -0.1, 1e-12);
  EXPECT_NEAR(std::max(x0, x1), 0.2, 1e-12);
}

TEST(Manifold, ACornerAndCrossingEdgesTouchInOnePoint) {
  const ConvexPolyhedron box = boxPolyhedron(Vector3(0.2, 0.2, 0.2));
  const Matrix3 R = rotationFromRpy(Vector3(0.3, 0.5, 0.0));
  double lowest = 0.0;
  for (int i = 0; i < box.vertexCount(); ++i) {
    lowest = std::min(lowest, times(R, box.vertex(i)).z());
  }
  EXPECT_EQ(manifoldOf(floorBox(), Pose(), box, {R, Vector3(0.0, 0.0, 0.5 - lowest + kGap)}).count,
            1);
  const double quarter = 0.25 * 3.14159265358979323846;
  const double height = 0.2 * std::sqrt(2.0);
  EXPECT_EQ(manifoldOf(box, poseOf(Vector3(quarter, 0.0, 0.0), Vector3::Zero()), box,
                       poseOf(Vector3(0.0, quarter, 0.0), Vector3(0.0, 0.0, height + kGap)))
                .count,
            1);
}

TEST(Manifold, OfManyCornersTheFarthestInEightDirectionsStay) {
  const ConvexPolyhedron can = cylinderPolyhedron(0.3, 0.4, 24);
  const ContactManifold manifold =
      manifoldOf(floorBox(), Pose(), can, poseOf(Vector3::Zero(), Vector3(0.0, 0.0, 0.7 + kGap)));
  EXPECT_EQ(manifold.count, 8);
  Vector3 sum = Vector3::Zero();
  for (int i = 0; i < manifold.count; ++i) {
    sum += manifold.points[static_cast<std::size_t>(i)].p_WC;
  }
  EXPECT_NEAR(sum.x(), 0.0, 0.1);
  EXPECT_NEAR(sum.y(), 0.0, 0.1);
}

TEST(Manifold, CornersBeyondTheBandAreLeftOut) {
  const ConvexPolyhedron box = boxPolyhedron(Vector3(0.4, 0.2, 0.2));
  const double tilt = 1e-5;  // rad: the far edge is 4 µm higher
  const ContactManifold manifold =
      manifoldOf(floorBox(), Pose(), box,
                 poseOf(Vector3(0.0, tilt, 0.0), Vector3(0.0, 0.0, 0.6 + 0.2 * tilt + kGap)));
  EXPECT_EQ(manifold.count, 2);
}

}  // namespace
}  // namespace hovercraft
