#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/contact/manifold.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/math/constants.h"
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

std::vector<ContactPoint> pointsOf(const ContactManifold& manifold) {
  return {manifold.points.begin(), manifold.points.begin() + manifold.count};
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
  const Pose X_WB = poseOf(Vector3(0.25 * kPi, 0.0, 0.0), Vector3(0.0, 0.0, 0.5 + height));
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
  const Vector3 roll(0.25 * kPi, 0.0, 0.0);
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
  const double quarter = 0.25 * kPi;
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

/// Each direction of the plane has a point at the rim, not farther from it than 25 degrees.
void expectSupportAllAround(const ContactManifold& manifold, double radius) {
  for (int degree = 0; degree < 360; ++degree) {
    const double angle = degree * kPi / 180.0;
    double farthest = -radius;
    for (int i = 0; i < manifold.count; ++i) {
      const Vector3& p = manifold.points[static_cast<std::size_t>(i)].p_WC;
      farthest = std::max(farthest, std::cos(angle) * p.x() + std::sin(angle) * p.y());
    }
    EXPECT_GT(farthest, 0.9 * radius) << degree << " degrees";
  }
}

TEST(Manifold, ARoundFaceOfManyCornersIsHeldAllAround) {
  for (const int sides : {64, 80, 100, 128, 300}) {
    SCOPED_TRACE(sides);
    const ConvexPolyhedron can = cylinderPolyhedron(0.3, 0.4, sides);
    const Pose above = poseOf(Vector3::Zero(), Vector3(0.0, 0.0, 0.7 + kGap));
    expectSupportAllAround(manifoldOf(floorBox(), Pose(), can, above), 0.3);
    const Pose below = poseOf(Vector3::Zero(), Vector3(0.0, 0.0, -0.7 - kGap));
    expectSupportAllAround(manifoldOf(can, below, floorBox(), Pose()), 0.3);
    // Both round: the common area is clipped by each side.
    const Pose on_top = poseOf(Vector3::Zero(), Vector3(0.0, 0.0, 0.4 + kGap));
    expectSupportAllAround(manifoldOf(can, Pose(), can, on_top), 0.3);
  }
}

TEST(Manifold, TheSizeOfTheGroundDoesNotMergeTheCornersOfASmallBody) {
  const ConvexPolyhedron ground = boxPolyhedron(Vector3(600.0, 600.0, 1.0));
  const ConvexPolyhedron box = boxPolyhedron(Vector3::Constant(0.05));
  const Pose X_WB = poseOf(Vector3(0.0, 0.0, 0.2), Vector3(3.0, 4.0, 0.525 + kGap));
  EXPECT_EQ(manifoldOf(ground, Pose(), box, X_WB).count, 4);
  EXPECT_EQ(manifoldOf(box, X_WB, ground, Pose()).count, 4);
}

// A can that leans by so little that many corners are near the floor: the lowest is the one that
// hits, wherever the eight farthest lie.
TEST(Manifold, TheClosestPointsAreAmongThePoints) {
  const ConvexPolyhedron can = cylinderPolyhedron(0.3, 0.4, 128);
  for (int k = 0; k < 48; ++k) {
    const double towards = k * 2.0 * kPi / 48.0;
    const double lean = 3e-6;  // rad
    Pose X_WB =
        poseOf(Vector3(lean * std::cos(towards), lean * std::sin(towards), 0.0), Vector3::Zero());
    double lowest = 0.0;
    for (int i = 0; i < can.vertexCount(); ++i) {
      lowest = std::min(lowest, transform(X_WB, can.vertex(i)).z());
    }
    X_WB.p_AB.z() = 0.5 - lowest + kGap;
    const ContactManifold manifold = manifoldOf(floorBox(), Pose(), can, X_WB);
    double least = 1.0;
    for (int i = 0; i < manifold.count; ++i) {
      least = std::min(least, manifold.points[static_cast<std::size_t>(i)].gap);
    }
    EXPECT_LT(least, 1.3 * kGap) << "leans towards " << k << " of 48";
    for (const ContactPoint& point : pointsOf(manifold)) {
      EXPECT_GT(point.gap, 0.9 * kGap);
      EXPECT_NEAR(point.p_WC.head<2>().norm(), 0.3, 1e-3);  // at the rim
      EXPECT_NEAR(point.p_WC.z(), 0.5, 2e-6);
    }
  }
}

TEST(Manifold, CornersBeyondTheBandAreLeftOut) {
  const ConvexPolyhedron box = boxPolyhedron(Vector3(0.4, 0.2, 0.2));
  const double tilt = 1e-5;  // rad: the far edge is 4 µm higher
  const ContactManifold manifold =
      manifoldOf(floorBox(), Pose(), box,
                 poseOf(Vector3(0.0, tilt, 0.0), Vector3(0.0, 0.0, 0.6 + 0.2 * tilt + kGap)));
  EXPECT_EQ(manifold.count, 2);
}

// Two bars turned by 45 degrees about x touch with an edge each, somewhere off the axes: both
// points lie in the middle of the gap, in y and z as well.
TEST(Manifold, ParallelEdgesMeetInTheMiddleOfTheGap) {
  const ConvexPolyhedron bar = boxPolyhedron(Vector3(2.0, 1.0, 1.0));
  const Matrix3 R = rotationFromRpy(Vector3(0.25 * 3.14159265358979323846, 0.0, 0.0));
  const Pose X_WA{R, Vector3(0.0, 3.0, 5.0)};
  const double edge = std::sqrt(0.5);  // m, from the axis
  const Pose X_WB{R, Vector3(0.5, 3.0, 5.0 + 2.0 * edge + 4e-3)};
  FeaturePair features;
  const ClosestFeatures closest = closestFeatures(bar, X_WA, bar, X_WB, features);
  const ContactManifold manifold = contactManifold(bar, X_WA, bar, X_WB, closest, 1e-2);
  ASSERT_EQ(manifold.count, 2);
  for (const ContactPoint& point : {manifold.points[0], manifold.points[1]}) {
    EXPECT_NEAR(point.gap, 4e-3, 1e-12);
    EXPECT_NEAR(point.p_WC.y(), 3.0, 1e-12);
    EXPECT_NEAR(point.p_WC.z(), 5.0 + edge + 2e-3, 1e-12);
  }
  EXPECT_NEAR(std::min(manifold.points[0].p_WC.x(), manifold.points[1].p_WC.x()), -0.5, 1e-12);
  EXPECT_NEAR(std::max(manifold.points[0].p_WC.x(), manifold.points[1].p_WC.x()), 1.0, 1e-12);
}

// Whichever of its six faces a cube is met at: the four corners of the common face.
TEST(Manifold, EachFaceOfACubeTouchesInItsFourCorners) {
  const ConvexPolyhedron cube = boxPolyhedron(Vector3::Ones());
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector3 normal = sign * Vector3::Unit(axis);
      const Vector3 shift = 0.25 * Vector3::Unit((axis + 1) % 3);
      const ContactManifold manifold =
          manifoldOf(cube, Pose(), cube, {Matrix3::Identity(), (1.0 + kGap) * normal + shift});
      ASSERT_EQ(manifold.count, 4) << normal.transpose();
      EXPECT_EQ(manifold.nhat_AB_W, normal);
      for (const ContactPoint& point : pointsOf(manifold)) {
        EXPECT_NEAR(dot(normal, point.p_WC), 0.5 + 0.5 * kGap, 1e-14);
        EXPECT_NEAR(std::abs(point.p_WC[(axis + 1) % 3] - 0.125), 0.375, 1e-14);
        EXPECT_NEAR(std::abs(point.p_WC[(axis + 2) % 3]), 0.5, 1e-14);
      }
    }
  }
}

// Likewise each of its twelve edges, beside the opposite one of another cube: the ends of the
// common part, from -0.25 to 0.5 along them.
TEST(Manifold, EachEdgeOfACubeTouchesAParallelOneInTwoPoints) {
  const ConvexPolyhedron cube = boxPolyhedron(Vector3::Ones());
  for (int axis = 0; axis < 3; ++axis) {
    for (const double one : {-1.0, 1.0}) {
      for (const double two : {-1.0, 1.0}) {
        const Vector3 beside = one * Vector3::Unit(axis) + two * Vector3::Unit((axis + 1) % 3);
        const int along = (axis + 2) % 3;
        const ContactManifold manifold =
            manifoldOf(cube, Pose(), cube,
                       {Matrix3::Identity(), (1.0 + kGap) * beside + 0.25 * Vector3::Unit(along)});
        ASSERT_EQ(manifold.count, 2) << beside.transpose();
        const double x0 = manifold.points[0].p_WC[along];
        const double x1 = manifold.points[1].p_WC[along];
        EXPECT_NEAR(std::min(x0, x1), -0.25, 1e-12);
        EXPECT_NEAR(std::max(x0, x1), 0.5, 1e-12);
        for (const ContactPoint& point : pointsOf(manifold)) {
          EXPECT_NEAR(point.gap, kGap * std::sqrt(2.0), 1e-14);
        }
      }
    }
  }
}

// Gaps and band of 2^-20 m to the last bit.
TEST(Manifold, ACornerAtTheBandIsStillAPoint) {
  const double gap = 0x1p-20;
  const ConvexPolyhedron cube = boxPolyhedron(Vector3::Ones());
  const Pose above = poseOf(Vector3::Zero(), Vector3(0.25, 0.25, 1.0 + gap));
  FeaturePair pair;
  const ClosestFeatures closest = closestFeatures(floorBox(), Pose(), cube, above, pair);
  EXPECT_EQ(contactManifold(floorBox(), Pose(), cube, above, closest, gap).count, 4);
  const double less = std::nextafter(gap, 0.0);
  EXPECT_EQ(contactManifold(floorBox(), Pose(), cube, above, closest, less).count, 1);
}

// The common area of two squares of which one is turned by 45 degrees has eight corners, in pairs
// of which any direction prefers one.
TEST(Manifold, ExactlyEightCornersAllStay) {
  const ConvexPolyhedron cube = boxPolyhedron(Vector3::Ones());
  const ConvexPolyhedron wide = boxPolyhedron(Vector3(1.3, 1.3, 1.0));
  const Pose above = poseOf(Vector3(0.0, 0.0, 0.25 * kPi), Vector3(0.0, 0.0, 1.0 + kGap));
  const ContactManifold manifold = manifoldOf(cube, Pose(), wide, above);
  ASSERT_EQ(manifold.count, 8);
  const double cut = 1.3 * std::sqrt(0.5) - 0.5;  // |x| + |y| <= 1.3/sqrt(2)
  for (const ContactPoint& point : pointsOf(manifold)) {
    EXPECT_NEAR(std::max(std::abs(point.p_WC.x()), std::abs(point.p_WC.y())), 0.5, 1e-14);
    EXPECT_NEAR(std::min(std::abs(point.p_WC.x()), std::abs(point.p_WC.y())), cut, 1e-14);
  }
}

// A round can on a narrow bar: ten corners in two bunches, of which several directions choose the
// same.
TEST(Manifold, NoPointComesTwice) {
  const ConvexPolyhedron can = cylinderPolyhedron(0.3, 0.4, 64);
  const ConvexPolyhedron bar = boxPolyhedron(Vector3(10.0, 0.1, 1.0));
  const Pose above = poseOf(Vector3::Zero(), Vector3(0.0, 0.0, 0.7 + kGap));
  const ContactManifold manifold = manifoldOf(bar, Pose(), can, above);
  EXPECT_GE(manifold.count, 4);
  const std::vector<ContactPoint> points = pointsOf(manifold);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(norm(points[i].p_WC - points[j].p_WC), 1e-3) << i << " and " << j;
    }
  }
}

// Two cubes turned by 1e-7 rad against each other: their sides cross in the middle, at no corner.
TEST(Manifold, SidesThatNearlyLieAlongEachOtherMakeNoCorner) {
  const ConvexPolyhedron cube = boxPolyhedron(Vector3::Ones());
  const Pose above = poseOf(Vector3(0.0, 0.0, 1e-7), Vector3(0.0, 0.0, 1.0 + kGap));
  const ContactManifold manifold = manifoldOf(cube, Pose(), cube, above);
  ASSERT_EQ(manifold.count, 4);
  for (const ContactPoint& point : pointsOf(manifold)) {
    EXPECT_NEAR(std::abs(point.p_WC.x()), 0.5, 1e-6);
    EXPECT_NEAR(std::abs(point.p_WC.y()), 0.5, 1e-6);
  }
}

/// A cube with a narrower box on it that leans by 1e-4 rad and hangs over its side, so that an edge
/// of each is closest, along a normal that is neither face's.
struct LeaningBox {
  LeaningBox() {
    X_WB = poseOf(Vector3(-2e-4, 1e-4, 0.3), Vector3(0.6, 0.1, 1.01));
    for (int i = 0; i < 4; ++i) X_WB.p_AB.z() -= closest(false).distance - kGap;
  }
  ClosestFeatures closest(bool swapped) const {
    FeaturePair pair;
    return swapped ? closestFeatures(box, X_WB, cube, Pose(), pair)
                   : closestFeatures(cube, Pose(), box, X_WB, pair);
  }
  ContactManifold manifold(bool swapped, double band) const {
    return swapped ? contactManifold(box, X_WB, cube, Pose(), closest(true), band)
                   : contactManifold(cube, Pose(), box, X_WB, closest(false), band);
  }
  ConvexPolyhedron cube = boxPolyhedron(Vector3::Ones());
  ConvexPolyhedron box = boxPolyhedron(Vector3(1.0, 0.4, 1.0));
  Pose X_WB;
};

// The whole common area counts: 0.5 m lean by 1e-4 rad, up to 1e-4 m of gap.
TEST(Manifold, FacesThatLeanByLittleTouchInTheirCommonArea) {
  const LeaningBox leaning;
  for (const bool swapped : {false, true}) {
    const ContactManifold manifold = leaning.manifold(swapped, 1e-3);
    EXPECT_TRUE(manifold.of_face);
    EXPECT_NE(manifold.nhat_AB_W, leaning.closest(swapped).nhat_AB_W);
    EXPECT_GE(manifold.count, 4);
    double least = 1.0;
    for (const ContactPoint& point : pointsOf(manifold)) {
      const Vector3 p_B = inverseTransform(leaning.X_WB, point.p_WC);
      EXPECT_LE(std::max(std::abs(point.p_WC.x()), std::abs(point.p_WC.y())), 0.5 + 1e-6);
      EXPECT_LE(std::max(std::abs(p_B.x()), 2.5 * std::abs(p_B.y())), 0.5 + 1e-6);
      EXPECT_NEAR(point.p_WC.z(), 0.5, 2e-4);
      EXPECT_GT(point.gap, 0.0);
      least = std::min(least, point.gap);
    }
    EXPECT_NEAR(least, kGap, 1e-8);
  }
}

TEST(Manifold, FacesThatLeanAndAreBeyondTheBandTouchInTheClosestPoints) {
  const LeaningBox leaning;
  for (const bool swapped : {false, true}) {
    const ContactManifold manifold = leaning.manifold(swapped, 0.5 * kGap);
    const ClosestFeatures closest = leaning.closest(swapped);
    EXPECT_FALSE(manifold.of_face);
    EXPECT_EQ(manifold.nhat_AB_W, closest.nhat_AB_W);
    ASSERT_EQ(manifold.count, 1);
    EXPECT_EQ(manifold.points[0].gap, closest.distance);
  }
}

}  // namespace
}  // namespace hovercraft
