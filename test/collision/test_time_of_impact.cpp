#include <algorithm>

#include <gtest/gtest.h>

#include "hovercraft_sim/collision/time_of_impact.h"
#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/math/constants.h"

#include "random_bodies.h"

namespace hovercraft {
namespace {

StepMotion moving(const Vector3& p, const Vector3& v, const Vector3& w = Vector3(0, 0, 0)) {
  StepMotion motion;
  motion.p_WB = p;
  motion.v_WB = v;
  motion.w_WB = w;
  return motion;
}

const ImpactMethod kMethods[] = {ImpactMethod::kAdvance, ImpactMethod::kBisection};

// A point that falls from 1 m meets the floor at sqrt(2 h / g).
TEST(VertexPlaneImpact, OfAFallingPointIsTheClosedForm) {
  for (const ImpactMethod method : kMethods) {
    StepMotion motion = moving(Vector3(0, 0, 1), Vector3(0, 0, 0));
    motion.a_WB = Vector3(0, 0, -9.81);
    const VertexImpact impact =
        vertexPlaneImpact(Vector3(0, 0, 0), motion, {Vector3(0, 0, 1), 0.0}, {1.0, 1e-10, method});
    ASSERT_EQ(impact.status, ImpactStatus::kImpact);
    EXPECT_NEAR(impact.time, std::sqrt(2.0 / 9.81), 1e-10);
    EXPECT_LE(impact.time, std::sqrt(2.0 / 9.81));
  }
}

// The tip of a turning arm dips below the plane and comes up again within the step: both ends of
// the step are clear. It enters at cos(10 t) = 0.95.
TEST(VertexPlaneImpact, FindsAVertexThatEntersAndLeavesWithinTheStep) {
  for (const ImpactMethod method : kMethods) {
    StepMotion motion = moving(Vector3(0, 0, 0), Vector3(0, 0, 0), Vector3(10, 0, 0));
    motion.q_WB = quaternionFromAxisAngle(Vector3::UnitX(), -1.0);
    const VertexImpact impact = vertexPlaneImpact(Vector3(0, 0, -1), motion,
                                                  {Vector3(0, 0, 1), -0.95}, {0.2, 1e-9, method});
    const double expected = (1.0 - std::acos(0.95)) / 10.0;
    ASSERT_EQ(impact.status, ImpactStatus::kImpact);
    EXPECT_NEAR(impact.time, expected, 1e-9);
    EXPECT_LE(impact.time, expected);
    const VertexImpact miss = vertexPlaneImpact(Vector3(0, 0, -1), motion,
                                                {Vector3(0, 0, 1), -1.001}, {0.2, 1e-9, method});
    EXPECT_EQ(miss.status, ImpactStatus::kNone);
  }
}

// 1 cm at 100 m/s against 1 mm in a step of 10 ms: it goes through and 0.5 m beyond between the
// ends of the step. The gap of 0.4945 m closes at 100 m/s.
TEST(TimeOfImpact, ABulletDoesNotTunnelThroughAPlate) {
  const ConvexPolyhedron bullet = boxPolyhedron(Vector3(0.01, 0.01, 0.01));
  const ConvexPolyhedron plate = boxPolyhedron(Vector3(0.001, 1, 1));
  for (const ImpactMethod method : kMethods) {
    const TimeOfImpact impact =
        timeOfImpact(bullet, moving(Vector3(-0.5, 0, 0), Vector3(100, 0, 0)), plate, StepMotion(),
                     {0.01, 1e-8, method});
    ASSERT_EQ(impact.status, ImpactStatus::kImpact);
    EXPECT_NEAR(impact.time, 0.004945, 1e-10);
    EXPECT_LE(impact.time, 0.004945);
    EXPECT_GT(impact.closest.distance, 0.0);
    EXPECT_LE(impact.closest.distance, 1e-8);
  }
}

// A rod of length 2 turns by 170 degrees in the step; a cube stands on a corner at angle 90 degrees
// and radius 0.98: at both ends of the step the rod is far from it.
TEST(TimeOfImpact, ASpinningRodDoesNotPassACorner) {
  const ConvexPolyhedron rod = boxPolyhedron(Vector3(2, 0.01, 0.01));
  const ConvexPolyhedron cube = boxPolyhedron(Vector3(0.1, 0.1, 0.1));
  StepMotion corner = moving(Vector3(0, 0.98 + 0.05 * std::sqrt(2.0), 0), Vector3(0, 0, 0));
  corner.q_WB = quaternionFromAxisAngle(Vector3::UnitZ(), kPi / 4);
  const StepMotion spin =
      moving(Vector3(0, 0, 0), Vector3(0, 0, 0), Vector3(0, 0, kPi * 170 / 180));
  // The rod's leading corner (1, 0.005), at radius r and atan(0.005) ahead of the rod, meets the
  // side y - x = 0.98 of the cube: r sin b - r cos b = 0.98 at its angle b.
  const double r = std::sqrt(1.0 + 0.005 * 0.005);
  const double b = kPi / 4 + std::asin(0.98 / (r * std::sqrt(2.0)));
  const double expected = (b - std::atan(0.005)) / (kPi * 170 / 180);
  for (const ImpactMethod method : kMethods) {
    const TimeOfImpact impact = timeOfImpact(rod, spin, cube, corner, {1.0, 1e-8, method});
    ASSERT_EQ(impact.status, ImpactStatus::kImpact);
    EXPECT_NEAR(impact.time, expected, 1e-8);
    EXPECT_LE(impact.time, expected);
  }
}

TEST(TimeOfImpact, BodiesThatPassEachOtherDoNotMeet) {
  const ConvexPolyhedron cube = boxPolyhedron(Vector3(1, 1, 1));
  for (const ImpactMethod method : kMethods) {
    const TimeOfImpact impact =
        timeOfImpact(cube, moving(Vector3(-10, 0, 0), Vector3(20, 0, 0)), cube,
                     moving(Vector3(0, 1.001, 0), Vector3(0, 0, 0)), {1.0, 1e-6, method});
    EXPECT_EQ(impact.status, ImpactStatus::kNone);
    EXPECT_EQ(impact.time, 1.0);
  }
}

TEST(TimeOfImpact, BodiesThatOverlapAtTheStartAreReported) {
  const ConvexPolyhedron cube = boxPolyhedron(Vector3(1, 1, 1));
  const TimeOfImpact impact = timeOfImpact(
      cube, StepMotion(), cube, moving(Vector3(0.9, 0, 0), Vector3(1, 0, 0)), {1.0, 1e-6});
  EXPECT_EQ(impact.status, ImpactStatus::kOverlapping);
  EXPECT_THROW(timeOfImpact(cube, StepMotion(), cube, StepMotion(), {0.0, 1e-6}), std::logic_error);
}

/// Two boxes whose faces look at each other, nearly parallel, a small gap apart.
struct FacingBoxes {
  ConvexPolyhedron A = boxPolyhedron(Vector3(0.2, 0.2, 0.2));
  StepMotion motion_A;
  StepMotion motion_B;

  explicit FacingBoxes(RandomBodies& random) {
    const double tilt = std::pow(10.0, random.uniform(-7.0, -1.0));
    motion_B.q_WB = quaternionFromAxisAngle(random.unitVector(), tilt);
    motion_B.p_WB = Vector3(random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15), 0.4);
    motion_A.w_WB = std::pow(10.0, random.uniform(-4.0, 1.0)) * random.unitVector();
    motion_B.w_WB = std::pow(10.0, random.uniform(-4.0, 1.0)) * random.unitVector();
    motion_B.v_WB = std::pow(10.0, random.uniform(-5.0, 0.0)) * random.unitVector();
    motion_B.a_WB = 10.0 * random.unitVector();
    // About an axis of their own, or both about one: then level edges stay level.
    if (random.uniform(0.0, 1.0) < 0.5) motion_A.w_WB = random.uniform(-1.0, 1.0) * motion_B.w_WB;
    motion_A.alpha_WB = std::pow(10.0, random.uniform(-1.0, 3.0)) * motion_A.w_WB;
    motion_B.alpha_WB = -std::pow(10.0, random.uniform(-1.0, 3.0)) * motion_B.w_WB;
    FeaturePair fresh;
    const ClosestFeatures start = closestFeatures(A, motion_A.at(0.0), A, motion_B.at(0.0), fresh);
    const double gap = std::pow(10.0, random.uniform(-6.0, -3.0));
    motion_B.p_WB -= (start.distance - gap) * start.nhat_AB_W;
  }
};

// Also while a vertex changes: tilts, turns and gaps of all sizes that a step can have.
TEST(TimeOfImpact, WhatIsClearStaysApart) {
  RandomBodies random(77);
  int clear = 0;
  for (int i = 0; i < 20000; ++i) {
    const FacingBoxes boxes(random);
    FeaturePair pair;
    const ClosestFeatures start =
        closestFeatures(boxes.A, boxes.motion_A.at(0.0), boxes.A, boxes.motion_B.at(0.0), pair);
    const ImpactSearch search = {1e-3, 0.5 * start.distance};
    if (!isClear(boxes.A, boxes.motion_A, boxes.A, boxes.motion_B, start, search)) continue;
    ++clear;
    for (int k = 0; k <= 20; ++k) {
      const double t = search.duration * k / 20;
      const ClosestFeatures now =
          closestFeatures(boxes.A, boxes.motion_A.at(t), boxes.A, boxes.motion_B.at(t), pair);
      ASSERT_EQ(now.status, Proximity::kSeparated) << "seed 77, sample " << i;
      ASSERT_GT(now.distance, 0.49 * search.tolerance) << "seed 77, sample " << i;
    }
  }
  EXPECT_GT(clear, 5000);
  EXPECT_LT(clear, 19000);
}

// Upright edges of the planar model are level with the walls, so that two vertices are the lowest.
TEST(TimeOfImpact, AnUprightEdgeAlongAWallTakesFewQueries) {
  const ConvexPolyhedron drum = cylinderPolyhedron(0.2, 0.3, 24);
  const ConvexPolyhedron wall = boxPolyhedron(Vector3(0.3, 4.0, 0.3));
  for (const double turn : {0.0, 0.05, 0.13}) {
    StepMotion motion = moving(Vector3(1.0, 0.1, 0.0), Vector3(0.0, 0.6, 0.0), Vector3(0, 0, 0.3));
    motion.q_WB = quaternionFromAxisAngle(Vector3::UnitZ(), turn);
    FeaturePair fresh;
    const ClosestFeatures start = closestFeatures(wall, Pose(), drum, motion.at(0.0), fresh);
    motion.p_WB.x() -= start.distance - 1e-6;
    const TimeOfImpact impact = timeOfImpact(wall, StepMotion(), drum, motion, {0.01, 5e-7});
    EXPECT_LT(impact.queries, 30) << turn;
  }
}

// Random bodies of 32 vertices on a collision course: both methods agree, the bodies are apart by
// no more than the tolerance at the time returned, and at no earlier of 200 times they overlap.
TEST(TimeOfImpact, IsNeverLateAndBothMethodsAgree) {
  RandomBodies random(51);
  std::vector<int> queries;
  for (int i = 0; i < 300; ++i) {
    const ConvexPolyhedron A = random.ellipsoidHull(32, {1.0, 0.7, 0.4});
    const ConvexPolyhedron B = random.ellipsoidHull(32, {1.0, 0.7, 0.4});
    StepMotion motion_A =
        moving(Vector3(0, 0, 0), Vector3(0, 0, 0), random.uniform(0, 1.5) * random.unitVector());
    motion_A.q_WB = random.orientation();
    const Vector3 start = 3.0 * random.unitVector();
    StepMotion motion_B = moving(start, Vector3(random.unitVector() * 0.3 - start),
                                 random.uniform(0, 1.5) * random.unitVector());
    motion_B.q_WB = random.orientation();
    motion_B.a_WB = 0.5 * random.unitVector();
    motion_A.alpha_WB = random.uniform(-2.0, 2.0) * motion_A.w_WB;
    motion_B.alpha_WB = random.uniform(-2.0, 2.0) * motion_B.w_WB;
    const TimeOfImpact fast = timeOfImpact(A, motion_A, B, motion_B, {1.0, 1e-6});
    const TimeOfImpact slow =
        timeOfImpact(A, motion_A, B, motion_B, {1.0, 1e-6, ImpactMethod::kBisection});
    ASSERT_EQ(fast.status, slow.status) << "seed 51, sample " << i;
    if (fast.status == ImpactStatus::kNone) continue;
    ASSERT_EQ(fast.status, ImpactStatus::kImpact);
    queries.push_back(fast.queries);
    EXPECT_GT(fast.closest.distance, 0.0);
    EXPECT_LE(fast.closest.distance, 1e-6);
    EXPECT_LE(slow.closest.distance, 1e-6);
    EXPECT_NEAR(fast.time, slow.time, 1e-3) << "seed 51, sample " << i;
    FeaturePair last;
    for (int k = 0; k < 200; ++k) {
      const double t = fast.time * k / 200;
      ASSERT_EQ(closestFeatures(A, motion_A.at(t), B, motion_B.at(t), last).status,
                Proximity::kSeparated);
    }
  }
  ASSERT_GT(queries.size(), 200U);
  std::nth_element(queries.begin(), queries.begin() + static_cast<long>(queries.size() / 2),
                   queries.end());
  EXPECT_LE(queries[queries.size() / 2], 12);
}

/// 24 points of an ellipse at height 1 over the apex in the origin, which has 24 edges.
ConvexPolyhedron flatPyramid() {
  std::vector<Vector3> points{{0, 0, 0}};
  for (int i = 0; i < 24; ++i) {
    points.emplace_back(10.0 * std::cos(kPi * i / 12), 0.1 * std::sin(kPi * i / 12), 1.0);
  }
  return convexHull(points, "pyramid");
}

// The pyramid stands on its apex over a plate and falls to its long side: its slope over the plate
// is a hundred times as steep in the one direction as in the other.
// Its rate after t is 1 - 8 t: it would pass the plane after 0.2 rad, turns back after 1/16 rad and
// never does.
TEST(TimeOfImpact, AVertexThatTurnsBackInTimeHitsNothing) {
  for (const ImpactMethod method : kMethods) {
    StepMotion motion = moving(Vector3(0, 0, 0), Vector3(0, 0, 0), Vector3(1, 0, 0));
    motion.alpha_WB = Vector3(-8, 0, 0);
    const Plane plane = {Vector3(0, 0, -1), -std::sin(0.2)};
    const VertexImpact miss =
        vertexPlaneImpact(Vector3(0, 1, 0), motion, plane, {0.2, 1e-9, method});
    EXPECT_EQ(miss.status, ImpactStatus::kNone);
    motion.alpha_WB = Vector3(8, 0, 0);
    const VertexImpact hit =
        vertexPlaneImpact(Vector3(0, 1, 0), motion, plane, {0.2, 1e-9, method});
    ASSERT_EQ(hit.status, ImpactStatus::kImpact);
    // t + 4 t² = 0.2
    EXPECT_NEAR(hit.time, (std::sqrt(1.0 + 16.0 * 0.2) - 1.0) / 8.0, 1e-8);
  }
}

/// At rest, and turning faster and faster from now on. @param alpha rad/s².
StepMotion beginning(const Vector3& p, const Vector3& alpha) {
  StepMotion motion = moving(p, Vector3(0, 0, 0));
  motion.alpha_WB = alpha;
  return motion;
}

// A tip 1 m from the middle falls 1 mm after alpha t²/2 = 1e-3. Nothing moves when the search
// begins.
TEST(TimeOfImpact, ARodThatBeginsToTurnHitsInItsTime) {
  const ConvexPolyhedron plate = boxPolyhedron(Vector3(10, 10, 1));
  const ConvexPolyhedron rod = boxPolyhedron(Vector3(2, 0.02, 0.02));
  for (const ImpactMethod method : kMethods) {
    const TimeOfImpact impact =
        timeOfImpact(plate, StepMotion(), rod, beginning(Vector3(0, 0, 0.511), Vector3(0, 100, 0)),
                     {0.01, 1e-8, method});
    ASSERT_EQ(impact.status, ImpactStatus::kImpact);
    EXPECT_NEAR(impact.time, std::sqrt(2e-5), 1e-6);
  }
}

// It leans on its lower side by 1 mm, begins to turn back, and hits with the other side, which is
// level with the first after alpha t²/2 = 1e-3; also where the plate turns about its normal.
TEST(TimeOfImpact, ABoxThatBeginsToTurnHitsWithItsOtherSide) {
  const ConvexPolyhedron plate = boxPolyhedron(Vector3(10, 10, 1));
  const ConvexPolyhedron box = boxPolyhedron(Vector3(1, 1, 1));
  StepMotion motion = beginning(Vector3(0, 0, 1.001), Vector3(0, 100, 0));
  motion.q_WB = quaternionFromAxisAngle(Vector3::UnitY(), -1e-3);
  for (const double spin : {0.0, 0.1}) {
    const StepMotion below = moving(Vector3(0, 0, 0), Vector3(0, 0, 0), Vector3(0, 0, spin));
    for (const ImpactMethod method : kMethods) {
      const TimeOfImpact impact = timeOfImpact(plate, below, box, motion, {0.01, 1e-8, method});
      ASSERT_EQ(impact.status, ImpactStatus::kImpact) << spin;
      EXPECT_EQ(impact.closest.status, Proximity::kSeparated);
      // sin a + cos a = 1.002 of its angle a: 2 mm + a²/2.
      const double angle = 2e-3 + 2e-6;
      EXPECT_NEAR(impact.time, std::sqrt(2.0 * (angle + 1e-3) / 100.0), 1e-6) << spin;
    }
  }
}

TEST(TimeOfImpact, AnApexOfManyEdgesIsNoReasonToComeLate) {
  const ConvexPolyhedron plate = boxPolyhedron(Vector3(60, 60, 1));
  const ConvexPolyhedron pyramid = flatPyramid();
  StepMotion motion = moving(Vector3(0, 0, 1.0), Vector3(0, 0, 0), Vector3(0, 1, 0));
  motion.q_WB = quaternionFromAxisAngle(Vector3::UnitX(), 0.01);
  const TimeOfImpact fast = timeOfImpact(plate, StepMotion(), pyramid, motion, {1.0, 1e-6});
  const TimeOfImpact slow =
      timeOfImpact(plate, StepMotion(), pyramid, motion, {1.0, 1e-6, ImpactMethod::kBisection});
  ASSERT_EQ(fast.status, ImpactStatus::kImpact);
  ASSERT_EQ(slow.status, ImpactStatus::kImpact);
  EXPECT_EQ(fast.closest.status, Proximity::kSeparated);
  EXPECT_NEAR(fast.time, slow.time, 1e-6);
}

/// What comes near another body in a step of 1 s, turning on the way.
StepMotion randomApproach(RandomBodies& random, double reach) {
  const Vector3 start = 1.5 * reach * random.unitVector();
  StepMotion motion = moving(start, Vector3(reach * random.unitVector() - 1.2 * start),
                             random.uniform(0, 3) * random.unitVector());
  motion.q_WB = random.orientation();
  motion.a_WB = reach * random.unitVector();
  motion.alpha_WB = random.uniform(-2.0, 2.0) * motion.w_WB;
  return motion;
}

// Boxes, cylinders with long faces, needles, sheets, an apex of many edges: no overlap before the
// time returned, none at all where there is no impact, and the fast way is not behind bisection.
TEST(TimeOfImpact, OfAllSortsOfBodiesIsNeverLate) {
  RandomBodies random(52);
  const std::vector<ConvexPolyhedron> bodies = {
      boxPolyhedron(Vector3(1, 0.5, 0.8)), boxPolyhedron(Vector3(2, 0.01, 0.01)),
      boxPolyhedron(Vector3(1, 1, 1e-3)),  cylinderPolyhedron(0.5, 0.1, 40),
      cylinderPolyhedron(0.05, 2, 24),     flatPyramid()};
  int impacts = 0;
  int misses = 0;
  for (int i = 0; i < 540; ++i) {
    const ConvexPolyhedron& A = bodies[static_cast<std::size_t>(i % 6)];
    const ConvexPolyhedron& B = bodies[static_cast<std::size_t>(i / 6 % 6)];
    const double reach = A.data().radius + B.data().radius;
    StepMotion motion_A = moving(Vector3(0, 0, 0), Vector3(0, 0, 0), 2.0 * random.unitVector());
    motion_A.q_WB = random.orientation();
    const StepMotion motion_B = randomApproach(random, reach);
    const TimeOfImpact fast = timeOfImpact(A, motion_A, B, motion_B, {1.0, 1e-6});
    const TimeOfImpact slow =
        timeOfImpact(A, motion_A, B, motion_B, {1.0, 1e-6, ImpactMethod::kBisection});
    ASSERT_EQ(fast.status, slow.status) << "seed 52, sample " << i;
    ASSERT_TRUE(fast.status == ImpactStatus::kImpact || fast.status == ImpactStatus::kNone);
    ASSERT_LE(fast.time, slow.time + 1e-6) << "seed 52, sample " << i;
    ++(fast.status == ImpactStatus::kImpact ? impacts : misses);
    FeaturePair last;
    for (int k = 0; k <= 200; ++k) {
      const double t = fast.time * k / 200;
      ASSERT_EQ(closestFeatures(A, motion_A.at(t), B, motion_B.at(t), last).status,
                Proximity::kSeparated)
          << "seed 52, sample " << i;
    }
  }
  EXPECT_GT(impacts, 100);
  EXPECT_GT(misses, 100);
}

// It spins about the normal while it slides along: neither closes the gap.
TEST(TimeOfImpact, ADiscThatSpinsOverAPlateTakesFewQueries) {
  const ConvexPolyhedron plate = boxPolyhedron(Vector3(10, 10, 1));
  const ConvexPolyhedron disc = cylinderPolyhedron(0.5, 0.1, 32);
  const StepMotion motion = moving(Vector3(0, 0, 0.55 + 1e-6), Vector3(1, 0, 0), Vector3(0, 0, 3));
  const TimeOfImpact impact = timeOfImpact(plate, StepMotion(), disc, motion, {1.0, 5e-7});
  EXPECT_EQ(impact.status, ImpactStatus::kNone);
  EXPECT_LT(impact.queries, 30);
}

}  // namespace
}  // namespace hovercraft
