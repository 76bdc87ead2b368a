#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "hovercraft_sim/contact/entry_normal.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/math/rotation.h"

namespace hovercraft {
namespace {

const Twist kStill{Vector3::Zero(), Vector3::Zero()};

/// The manifold of two boxes of edge 1: A in the origin, B at a place, moving.
ContactManifold turned(const Vector3& p_WB, const Vector3& v_WB) {
  const ConvexPolyhedron box = boxPolyhedron(Vector3::Ones());
  const Pose X_WA;
  const Pose X_WB{Matrix3::Identity(), p_WB};
  FeaturePair features;
  const ClosestFeatures closest = closestFeatures(box, X_WA, box, X_WB, features);
  ContactManifold manifold = contactManifold(box, X_WA, box, X_WB, closest, 1e-6);
  turnToEntry({box, X_WA, kStill}, {box, X_WB, {v_WB, Vector3::Zero()}}, closest, manifold);
  return manifold;
}

// Edge beside edge, 0.3 µm across and 0.4 µm above: which side is entered is the motion's choice.
TEST(EntryNormal, IsOfTheSideThatTheMotionReachesLast) {
  const Vector3 beside(1.0 + 0.3e-6, 0.0, 1.0 + 0.4e-6);
  const Vector3 up(0.0, 0.0, 1.0);
  const Vector3 across(1.0, 0.0, 0.0);
  const struct {
    Vector3 v, normal;
    double gap;
  } cases[] = {
      {{-1.0, 0.0, 0.0}, up, 0.4e-6},        // flush: passes over
      {{0.0, 0.0, -1.0}, across, 0.3e-6},    // passes beside
      {{-1.0, 0.0, -0.1}, up, 0.4e-6},       // across after 0.3 µs, on top after 4 µs
      {{-0.1, 0.0, -1.0}, across, 0.3e-6},   // the other way round
      {{-1.0, 0.0, -1.34}, across, 0.3e-6},  // 0.300 µs against 0.299 µs
      {{-1.0, 0.0, -1.32}, up, 0.4e-6},      // 0.300 µs against 0.303 µs
  };
  for (const auto& one : cases) {
    const ContactManifold manifold = turned(beside, one.v);
    EXPECT_GE(manifold.count, 1);
    EXPECT_LT(norm(manifold.nhat_AB_W - one.normal), 1e-12) << one.v.transpose();
    for (int i = 0; i < manifold.count; ++i) {
      EXPECT_NEAR(manifold.points[static_cast<std::size_t>(i)].gap, one.gap, 1e-15);
    }
  }
}

// The same along each of the twelve edges, somewhere in its middle: the side whose gap the motion
// straight at the other one does not close.
TEST(EntryNormal, IsFoundAtEveryEdge) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double one : {-1.0, 1.0}) {
      for (const double two : {-1.0, 1.0}) {
        const Vector3 u = one * Vector3::Unit(axis);
        const Vector3 v = two * Vector3::Unit((axis + 1) % 3);
        const Vector3 along = 0.25 * Vector3::Unit((axis + 2) % 3);
        const Vector3 beside = (1.0 + 0.3e-6) * u + (1.0 + 0.4e-6) * v + along;
        const ContactManifold over = turned(beside, -u);
        EXPECT_LT(norm(over.nhat_AB_W - v), 1e-12) << beside.transpose();
        EXPECT_NEAR(over.points[0].gap, 0.4e-6, 1e-15);
        const ContactManifold past = turned(beside, -v);
        EXPECT_LT(norm(past.nhat_AB_W - u), 1e-12) << beside.transpose();
        EXPECT_NEAR(past.points[0].gap, 0.3e-6, 1e-15);
      }
    }
  }
}

// Where nothing closes there is no side to enter: the line of the closest points stays.
TEST(EntryNormal, StaysWhereNothingCloses) {
  const Vector3 beside(1.0 + 0.3e-6, 0.0, 1.0 + 0.4e-6);
  for (const Vector3& v : {Vector3(0.0, 0.0, 0.0), Vector3(1.0, 0.0, 1.0)}) {
    EXPECT_LT(norm(turned(beside, v).nhat_AB_W - Vector3(0.6, 0.0, 0.8)), 1e-9);
  }
}

// The corner of one box beside the corner of another, from random sides: with the normal that comes
// out the bodies meet no earlier than along any other direction that parts them.
TEST(EntryNormal, OfACornerIsEnteredNoEarlierThanAnyOther) {
  std::mt19937 generator(7);  // NOLINT(cert-msc32-c,cert-msc51-cpp)
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Vector3 beside(1.0 + 0.3e-6, 1.0 + 0.5e-6, 1.0 + 0.4e-6);
  for (int trial = 0; trial < 200; ++trial) {
    const Vector3 v(uniform(generator), uniform(generator), uniform(generator));
    const ContactManifold manifold = turned(beside, v);
    ASSERT_EQ(manifold.count, 1);
    const double closing = -dot(manifold.nhat_AB_W, v);
    // The difference of the boxes is a box: its three sides at this corner.
    double last = 0.0;
    bool passes = false;
    for (int axis = 0; axis < 3; ++axis) {
      passes = passes || v[axis] >= 0.0;
      last = std::max(last, (beside[axis] - 1.0) / std::max(1e-300, -v[axis]));
    }
    if (passes) {
      EXPECT_LE(closing, 1e-12) << trial;
    } else {
      EXPECT_NEAR(manifold.points[0].gap / closing, last, 1e-9 * last) << trial;
    }
  }
}

TEST(EntryNormal, OfAFaceIsThatOfTheFace) {
  const ContactManifold manifold = turned(Vector3(0.5, 0.0, 1.0 + 0.4e-6), Vector3(-1.0, 0.0, 1.0));
  EXPECT_EQ(manifold.count, 4);
  EXPECT_LT(norm(manifold.nhat_AB_W - Vector3(0.0, 0.0, 1.0)), 1e-15);
}

// Two turned boxes corner to corner: no direction of many that parts them does so for longer than
// the normal that comes out, which may be that of a face of either or stand on an edge of each.
TEST(EntryNormal, OfTurnedBodiesPartsThemForLongest) {
  std::mt19937 generator(8);  // NOLINT(cert-msc32-c,cert-msc51-cpp)
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] {
    const double x = uniform(generator);
    const double y = uniform(generator);
    return Vector3(x, y, uniform(generator));
  };
  const ConvexPolyhedron box = boxPolyhedron(Vector3::Ones());
  const Pose X_WA;
  int compared = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Matrix3 R = rotationFromRpy(0.3 * vector());
    const Vector3 corner(0.5, 0.5, 0.5);
    const Vector3 apart = 1e-6 * (Vector3::Ones() + 0.9 * vector());
    const Pose X_WB{R, corner + apart - times(R, Vector3(-corner))};
    FeaturePair features;
    const ClosestFeatures closest = closestFeatures(box, X_WA, box, X_WB, features);
    ContactManifold manifold = contactManifold(box, X_WA, box, X_WB, closest, 1e-6);
    const auto is_corner = [](Feature feature) { return feature.kind == FeatureKind::kVertex; };
    if (!is_corner(closest.feature_a) || !is_corner(closest.feature_b)) continue;
    const Twist twist{-(Vector3::Ones() + vector()), Vector3::Zero()};
    turnToEntry({box, X_WA, kStill}, {box, X_WB, twist}, closest, manifold);
    const auto gap_along = [&](const Vector3& m) {
      double farthest_a = -1e300;
      double nearest_b = 1e300;
      for (int i = 0; i < box.vertexCount(); ++i) {
        farthest_a = std::max(farthest_a, dot(m, box.vertex(i)));
        nearest_b = std::min(nearest_b, dot(m, transform(X_WB, box.vertex(i))));
      }
      return nearest_b - farthest_a;
    };
    const Vector3 normal = manifold.nhat_AB_W;
    EXPECT_NEAR(norm(normal), 1.0, 1e-14) << trial;
    const double gap = manifold.points[0].gap;
    EXPECT_NEAR(gap_along(normal), gap, 1e-14) << trial;
    const double closing = -dot(normal, twist.v_WB);
    if (closing <= 0.0) continue;  // it passes
    for (int sample = 0; sample < 1000; ++sample) {
      Vector3 m = Vector3(0.6, 0.6, 0.6) + vector();
      m = m / norm(m);
      const double other = gap_along(m);
      if (!(other > 0.0)) continue;
      ++compared;
      // More than rounding later than what came out.
      EXPECT_LE(other * closing, gap * -dot(m, twist.v_WB) + 1e-14) << trial;
    }
  }
  EXPECT_GT(compared, 10000);
}

}  // namespace
}  // namespace hovercraft
