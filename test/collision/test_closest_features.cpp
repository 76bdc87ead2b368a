#include <limits>

#include <gtest/gtest.h>

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/collision/closest_polygon_features.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/math/constants.h"

#include "../support/allocation_counter.h"
#include "../support/share.h"
#include "check_query.h"
#include "random_bodies.h"

namespace hovercraft {
namespace {

ConvexPolyhedron randomBody(RandomBodies& random, int most, double size) {
  const double n = std::exp(random.uniform(std::log(4.0), std::log(most + 1.0)));
  return random.ellipsoidHull(
      static_cast<int>(n),
      Vector3(size * Vector3(1.0, random.uniform(0.05, 1.0), random.uniform(0.05, 1.0))));
}

/// Moves B along the normal to the gap wanted.
void setGap(const ConvexPolyhedron& A, const Pose& X_WA, const ConvexPolyhedron& B, Pose& X_WB,
            double gap) {
  FeaturePair fresh;
  const ClosestFeatures c = closestFeatures(A, X_WA, B, X_WB, fresh);
  X_WB.p_AB -= (c.distance - gap) * c.nhat_AB_W;
}

// 10^4 random queries of 4 to 200 vertices, half of them between 1e-9 and 1 from touching, some
// overlapping; every other one starts from the pair of the query before.
TEST(ClosestFeatures, AgreeWithBruteForceOverAllPairsOfFeatures) {
  RandomBodies random(2024);
  for (int pair = 0; pair < testing::shareOf(100); ++pair) {
    const double size = std::pow(10.0, random.uniform(-1.0, 1.0));
    const ConvexPolyhedron A = randomBody(random, 200, 1.0);
    const ConvexPolyhedron B = randomBody(random, pair % 10 == 0 ? 200 : 30, size);
    FeaturePair last;
    for (int query = 0; query < 100; ++query) {
      const Pose X_WA = random.pose(1.0);
      Pose X_WB = random.pose(random.uniform(query % 20 == 0 ? 0.0 : 1.0, 3.0) * (1.0 + size));
      if (query % 2 == 1) {
        const double gap = std::pow(10.0, random.uniform(-9.0, 0.0));
        setGap(A, X_WA, B, X_WB, query % 50 == 1 ? -0.1 * gap : gap);
        last = FeaturePair{};
      }
      const ClosestFeatures c = closestFeatures(A, X_WA, B, X_WB, last);
      checkAgainstBruteForce(A, X_WA, B, X_WB, c);
      ASSERT_FALSE(HasFailure()) << "seed 2024, pair " << pair << ", query " << query;
    }
  }
}

/// The points of a grid of `cells` on the faces of the unit cube.
std::vector<Vector3> gridOnCube(int cells) {
  std::vector<Vector3> points;
  const int side = cells + 1;
  const auto is_outer = [cells](int i) { return i == 0 || i == cells; };
  for (int i = 0; i < side * side * side; ++i) {
    const int x = i % side;
    const int y = i / side % side;
    const int z = i / (side * side);
    if (is_outer(x) || is_outer(y) || is_outer(z)) points.emplace_back(Vector3(x, y, z) / cells);
  }
  return points;
}

/// A box in a skew frame, given by a grid of points on its faces, as single precision keeps them
/// where the grid has inner points: slivers along its edges.
ConvexPolyhedron turnedBox(const Vector3& size, int cells) {
  const Matrix3 R = rotationMatrix(normalized(Quaternion{0.9, {0.1, -0.3, 0.2}}));
  std::vector<Vector3> points = gridOnCube(cells);
  for (Vector3& p : points) {
    p = times(R, size.cwiseProduct(p));
    if (cells > 1) p = p.cast<float>().cast<double>();
  }
  return convexHull(points, "turned box");
}

std::vector<ConvexPolyhedron> degenerateBodies() {
  std::vector<ConvexPolyhedron> bodies;
  bodies.push_back(boxPolyhedron(Vector3(1, 1, 1)));
  bodies.push_back(boxPolyhedron(Vector3(1, 1e-6, 1e-6)));  // a needle
  bodies.push_back(boxPolyhedron(Vector3(1, 1, 1e-6)));     // a sheet
  bodies.push_back(boxPolyhedron(Vector3(1e6, 1e6, 1)));
  bodies.push_back(boxPolyhedron(Vector3(1e-6, 1e-6, 1e-6)));
  bodies.push_back(cylinderPolyhedron(1, 2, 6));
  bodies.push_back(cylinderPolyhedron(1, 2, 40));  // its caps are long loops
  bodies.push_back(convexHull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, "tetrahedron"));
  std::vector<Vector3> pyramid{{0, 0, 1}};  // its apex has many edges
  for (int i = 0; i < 24; ++i) {
    pyramid.emplace_back(std::cos(kPi * i / 12), std::sin(kPi * i / 12), 0.0);
  }
  bodies.push_back(convexHull(pyramid, "pyramid"));
  bodies.push_back(turnedBox(Vector3(1, 1e-6, 1e-6), 1));  // corners that rounding has moved
  bodies.push_back(turnedBox(Vector3(1, 1, 1e-6), 1));
  bodies.push_back(turnedBox(Vector3(1, 1, 1), 4));
  return bodies;
}

/// Two bodies, the second one turned, apart in some directions by some gaps. @param cases counted.
void checkDegeneratePair(const ConvexPolyhedron& A, const ConvexPolyhedron& B,
                         const Quaternion& turn, int& cases) {
  const double reach = A.data().radius + B.data().radius;
  const std::vector<Vector3> directions = {{1, 0, 0}, {0, 0, 1}, {1, 1, 0}, {1, 1, 1}, {0.5, 0, 1}};
  for (const Vector3& direction : directions) {
    for (const double gap : {1.0, 1e-3, 1e-9, 0.0, -1e-6}) {
      if (cases++ % testing::kShare != 0) continue;
      SCOPED_TRACE(::testing::Message()
                   << "gap " << gap << ", direction " << direction.transpose());
      const Pose X_WA;
      Pose X_WB{rotationMatrix(normalized(turn)), Vector3(1.25 * reach * direction)};
      setGap(A, X_WA, B, X_WB, gap * reach);
      FeaturePair last;
      checkAgainstBruteForce(A, X_WA, B, X_WB, closestFeatures(A, X_WA, B, X_WB, last));
    }
  }
}

// Parallel faces and edges, vertices over shared boundaries, corners on corners, tilts that
// rounding hides, needles, sheets, 1e-6 to 1e6 in size.
TEST(ClosestFeatures, DegenerateCasesEndAndAgreeWithBruteForce) {
  const std::vector<ConvexPolyhedron> bodies = degenerateBodies();
  const std::vector<Quaternion> turns = {Quaternion::identity(),
                                         quaternionFromAxisAngle(Vector3::UnitX(), kPi / 2),
                                         quaternionFromAxisAngle(Vector3::UnitZ(), kPi / 4),
                                         quaternionFromAxisAngle(Vector3::UnitY(), 1e-9),
                                         quaternionFromAxisAngle(Vector3(0.6, 0.8, 0.0), 1e-7),
                                         quaternionFromAxisAngle(Vector3::UnitX(), 1e-15)};
  int cases = 0;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    for (std::size_t k = i; k < bodies.size(); ++k) {
      for (std::size_t turn = 0; turn < turns.size(); ++turn) {
        checkDegeneratePair(bodies[i], bodies[k], turns[turn], cases);
        ASSERT_FALSE(HasFailure()) << "bodies " << i << ", " << k << ", turn " << turn;
      }
    }
  }
}

// One corner over another, the faces parallel but for 1e-8 rad: the features that decide differ
// from the corners by less than the rounding of one difference of points.
TEST(ClosestFeatures, CornerOverCornerWithAHiddenTiltFindsTheLowerCorner) {
  const ConvexPolyhedron box = boxPolyhedron(Vector3(1, 1, 1));
  for (const double tilt : {1e-8, 3e-9, -1e-8, 1e-10}) {
    const Pose X_WA;
    Pose X_WB{rotationMatrix(normalized(Quaternion{1.0, {0.0, 0.5 * tilt, 0.0}})),
              Vector3(0.0, 0.0, 1.0 + 2e-8)};
    FeaturePair last;
    last.known = true;  // start at the corner pair (0.5, 0.5, 0.5)
    for (int v = 0; v < 8; ++v) {
      if (box.vertex(v) == Vector3(0.5, 0.5, 0.5)) last.a = {FeatureKind::kVertex, v};
      if (box.vertex(v) == Vector3(0.5, 0.5, -0.5)) last.b = {FeatureKind::kVertex, v};
    }
    const ClosestFeatures c = closestFeatures(box, X_WA, box, X_WB, last);
    EXPECT_NEAR(c.distance, 2e-8 - 0.5 * std::abs(tilt), 1e-15);
  }
}

// The answer is that of the relative pose: far from the origin of W only the poses' own rounding
// counts.
TEST(ClosestFeatures, DoNotDependOnThePlaceInTheWorld) {
  RandomBodies random(5);
  const ConvexPolyhedron A = randomBody(random, 50, 1.0);
  const ConvexPolyhedron B = randomBody(random, 50, 1.0);
  Pose X_WA = random.pose(0.0);
  Pose X_WB = random.pose(3.0);
  X_WB.p_AB = Vector3(3.0, 0.25, 0.5);
  FeaturePair near_pair;
  const ClosestFeatures near_origin = closestFeatures(A, X_WA, B, X_WB, near_pair);
  const Vector3 far(1048576.0, -2097152.0, 524288.0);
  X_WA.p_AB = far;
  X_WB.p_AB += far;
  FeaturePair far_pair;
  const ClosestFeatures far_away = closestFeatures(A, X_WA, B, X_WB, far_pair);
  EXPECT_NEAR(far_away.distance, near_origin.distance, 1e-15);
  EXPECT_EQ(far_away.feature_a, near_origin.feature_a);
  EXPECT_EQ(far_away.feature_b, near_origin.feature_b);
}

// Turning half a degree and moving a little between queries, from 8 to 10^4 vertices.
TEST(ClosestFeatures, CoherentStepsDoNotGrowWithTheNumberOfVertices) {
  for (const int n : {8, 100, 1000, 10000}) {
    RandomBodies random(static_cast<unsigned>(n));
    const ConvexPolyhedron A = random.ellipsoidHull(n, {1.0, 0.7, 0.4});
    const ConvexPolyhedron B = random.ellipsoidHull(n, {1.0, 0.7, 0.4});
    Quaternion q = random.orientation();
    const Quaternion turn = quaternionFromAxisAngle(random.unitVector(), kPi / 360);
    FeaturePair last;
    long steps = 0;
    const int queries = 500;
    for (int i = 0; i < queries; ++i) {
      q = normalized(turn * q);
      const Pose X_WB{rotationMatrix(q), Vector3(2.3, 0.1 + 1e-3 * i, -0.3)};
      const ClosestFeatures c = closestFeatures(A, Pose(), B, X_WB, last);
      ASSERT_EQ(c.status, Proximity::kSeparated);
      if (i > 0) steps += c.steps;
    }
    EXPECT_LT(static_cast<double>(steps) / queries, 6.0) << n << " vertices";
  }
}

// A face of 4096 edges is not looked at edge by edge, nor is an apex of as many: one query from a
// right start takes one step, and one from a far start a few.
TEST(ClosestFeatures, LongFacesAndVerticesAreCheap) {
  const ConvexPolyhedron disk = cylinderPolyhedron(1.0, 0.1, 4096);
  const ConvexPolyhedron box = boxPolyhedron(Vector3(0.1, 0.1, 0.1));
  for (const double angle : {0.0, 1.0, 2.5, 4.0}) {
    const Pose X_WB{rotationMatrix(quaternionFromRpy({0.3, 0.4, 0.0})),
                    Vector3(0.8 * std::cos(angle), 0.8 * std::sin(angle), 0.3)};
    FeaturePair last;
    const ClosestFeatures first = closestFeatures(disk, Pose(), box, X_WB, last);
    EXPECT_EQ(first.feature_a.kind, FeatureKind::kFace);
    EXPECT_LT(first.steps, 40);
    EXPECT_EQ(closestFeatures(disk, Pose(), box, X_WB, last).steps, 1);
  }
}

/// A prism of a regular polygon with `between` more vertices in line on each of its sides.
ConvexPolyhedron prismWithSidesInLine(int corners, int between) {
  const int count = corners * (between + 1);
  std::vector<Vector3> vertices;
  std::vector<std::vector<std::int32_t>> rings(2);
  for (const double z : {-0.5, 0.5}) {
    for (int i = 0; i < count; ++i) {
      const int corner = i / (between + 1);
      const double share = static_cast<double>(i % (between + 1)) / (between + 1);
      const double from = 2.0 * kPi * corner / corners;
      const double to = 2.0 * kPi * (corner + 1) / corners;
      vertices.emplace_back((1.0 - share) * std::cos(from) + share * std::cos(to),
                            (1.0 - share) * std::sin(from) + share * std::sin(to), z);
    }
  }
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    rings[0].push_back(count - 1 - i);
    rings[1].push_back(count + i);
    rings.push_back({i, next, count + next, count + i});
  }
  return ConvexPolyhedron(vertices, rings);
}

// The search over a long face must not stop at sides that are level with each other.
TEST(ClosestFeatures, SidesInLineOfALongFaceAreNoEndOfTheSearch) {
  const ConvexPolyhedron prism = prismWithSidesInLine(24, 3);
  const ConvexPolyhedron box = boxPolyhedron(Vector3(0.1, 0.1, 0.1));
  for (int place = 0; place < 20; ++place) {
    const double angle = 0.3 + 0.61 * place;
    const double reach = place % 2 == 0 ? 1.6 : 1.05;
    const Pose X_WB{rotationMatrix(quaternionFromRpy({0.3, 0.4, 0.1 * place})),
                    Vector3(reach * std::cos(angle), reach * std::sin(angle), 0.8)};
    const auto expected = static_cast<double>(
        brute_force::distance(brute_force::place(prism, Pose(), Vector3(0, 0, 0)),
                              brute_force::place(box, X_WB, Vector3(0, 0, 0))));
    const int lowest = box.supportVertex(transposeTimes(X_WB.R_AB, Vector3(0, 0, -1)));
    for (int hint = 0; hint < 96; ++hint) {
      FeaturePair last{true, {FeatureKind::kFace, 1}, {FeatureKind::kVertex, lowest}, {hint, 0}};
      const ClosestFeatures c = closestFeatures(prism, Pose(), box, X_WB, last);
      ASSERT_EQ(c.status, Proximity::kSeparated);
      ASSERT_NEAR(c.distance, expected, 1e-13) << "place " << place << ", hint " << hint;
    }
  }
}

// Fresh starts: the climb from the map of support vertices is counted with the walk.
TEST(ClosestFeatures, StepsFromAFreshStartHardlyGrowWithTheNumberOfVertices) {
  for (const int n : {100, 1000, 10000}) {
    RandomBodies random(static_cast<unsigned>(n));
    const ConvexPolyhedron A = random.ellipsoidHull(n, {1.0, 0.7, 0.4});
    const ConvexPolyhedron B = random.ellipsoidHull(n, {1.0, 0.7, 0.4});
    long steps = 0;
    const int queries = 300;
    for (int i = 0; i < queries; ++i) {
      FeaturePair fresh;
      const Pose X_WA = random.pose(0.0);
      const Pose X_WB = random.pose(random.uniform(2.1, 4.0));
      const ClosestFeatures c = closestFeatures(A, X_WA, B, X_WB, fresh);
      steps += c.climbs + c.steps;
    }
    EXPECT_LT(static_cast<double>(steps) / queries, 5.0 + 0.2 * std::sqrt(n)) << n << " vertices";
  }
}

TEST(ClosestFeatures, APoseThatIsNotFiniteIsRefused) {
  RandomBodies random(11);
  const ConvexPolyhedron body = random.ellipsoidHull(1000, {1.0, 0.7, 0.4});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Pose far;
  far.p_AB = Vector3(3, 0, 0);
  FeaturePair last;
  closestFeatures(body, Pose(), body, far, last);
  for (int entry = 0; entry < 12; ++entry) {
    Pose broken = far;
    (entry < 9 ? broken.R_AB(entry / 3, entry % 3) : broken.p_AB[entry - 9]) = nan;
    FeaturePair warm = last;
    EXPECT_THROW(closestFeatures(body, Pose(), body, broken, warm), std::logic_error) << entry;
    FeaturePair fresh;
    EXPECT_THROW(closestFeatures(body, Pose(), body, broken, fresh), std::logic_error) << entry;
  }
}

TEST(ClosestFeatures, QueriesDoNotAllocate) {
  RandomBodies random(9);
  const ConvexPolyhedron A = randomBody(random, 100, 1.0);
  const ConvexPolyhedron B = randomBody(random, 100, 1.0);
  std::vector<Pose> poses;
  poses.reserve(300);
  for (int i = 0; i < 300; ++i) poses.push_back(random.pose(0.01 * i));
  FeaturePair last;
  int penetrating = 0;
  int unanswered = 0;
  const long before = testing::allocations;
  for (const Pose& X_WB : poses) {
    FeaturePair fresh;
    if (closestFeatures(A, Pose(), B, X_WB, last).status == Proximity::kPenetrating) ++penetrating;
    if (closestFeatures(A, Pose(), B, X_WB, fresh).status == Proximity::kStepLimit) ++unanswered;
  }
  EXPECT_EQ(testing::allocations, before);
  EXPECT_GT(penetrating, 10);
  EXPECT_EQ(unanswered, 0);
  EXPECT_GT(before, 300);  // the counter counts
}

TEST(ClosestFeatures, QueriesOfPolygonsDoNotAllocate) {
  const ConvexPolygon square({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  const long before = testing::allocations;
  int penetrating = 0;
  for (int i = 0; i < 300; ++i) {
    FeaturePair fresh;
    const PlanarPose X_WB{0.6, 0.8, {0.01 * i, 0.0}};
    const ClosestPolygonFeatures c = closestFeatures(square, PlanarPose(), square, X_WB, fresh);
    if (c.status == Proximity::kPenetrating) ++penetrating;
  }
  EXPECT_EQ(testing::allocations, before);
  EXPECT_GT(penetrating, 10);
  EXPECT_LT(penetrating, 290);
}

}  // namespace
}  // namespace hovercraft
