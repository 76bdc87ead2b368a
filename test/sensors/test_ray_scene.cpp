#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/sensors/laser_model.h"
#include "hovercraft_sim/sensors/ray_scene.h"

namespace hovercraft {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

BeamFan fanOf(int beams, double from, double to) {
  BeamFan fan;
  for (int i = 0; i < beams; ++i) {
    const double angle = from + (to - from) * i / std::max(1, beams - 1);
    fan.cosines.push_back(std::cos(angle));
    fan.sines.push_back(std::sin(angle));
  }
  return fan;
}

std::vector<double> cast(const BeamFan& fan, const Pose& X_WS, const std::vector<RayTarget>& scene,
                         double farthest = 1e6) {
  std::vector<double> ranges(fan.cosines.size(), kFar);
  std::vector<HalfSpace> scratch(1000);
  for (const RayTarget& target : scene) {
    castBeams(fan, X_WS, target, target.X_WT, farthest, scratch, ranges.data());
  }
  return ranges;
}

Pose poseAt(const Vector3& p, const Vector3& rpy = Vector3::Zero()) {
  return {rotationFromRpy(rpy), p};
}

RayTarget box(const Vector3& size, const Pose& pose) {
  return {boxPolyhedron(size), RayTarget::kFixed, pose};
}

// A pen whose inner corners are a polygon: a beam from inside hits the side that it crosses, at the
// distance that two straight lines give.
TEST(RayScene, AScanInAPolygonalPenIsTheClosedForm) {
  const std::vector<Eigen::Vector2d> corners = {{4.0, -2.0}, {5.0, 1.5},   {1.0, 4.0},
                                                {-3.0, 2.5}, {-4.0, -1.0}, {0.0, -3.5}};
  std::vector<RayTarget> walls;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& a = corners[i];
    const Eigen::Vector2d& b = corners[(i + 1) % corners.size()];
    const Eigen::Vector2d out = Eigen::Vector2d(b.y() - a.y(), a.x() - b.x()).normalized() * 0.3;
    std::vector<Vector3> points;
    for (const Eigen::Vector2d& p : {a, b, Eigen::Vector2d(b + out), Eigen::Vector2d(a + out)}) {
      points.emplace_back(p.x(), p.y(), -0.5);
      points.emplace_back(p.x(), p.y(), 0.5);
    }
    walls.emplace_back(convexHull(points, "wall"), RayTarget::kFixed);
  }
  const Eigen::Vector2d eye(0.7, 0.4);
  const double yaw = 0.3;
  const BeamFan fan = fanOf(721, -kPi, kPi);
  const auto ranges = cast(fan, poseAt({eye.x(), eye.y(), 0.1}, {0.0, 0.0, yaw}), walls);
  for (int beam = 0; beam < 721; ++beam) {
    const double angle = yaw - kPi + 2.0 * kPi * beam / 720.0;
    const Eigen::Vector2d d(std::cos(angle), std::sin(angle));
    double wanted = kFar;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Eigen::Vector2d side = corners[(i + 1) % corners.size()] - corners[i];
      const Eigen::Vector2d to = corners[i] - eye;
      const double det = d.x() * side.y() - d.y() * side.x();
      const double t = (to.x() * side.y() - to.y() * side.x()) / det;
      const double s = (to.x() * d.y() - to.y() * d.x()) / det;
      if (t > 0.0 && s >= -1e-12 && s <= 1.0 + 1e-12) wanted = std::min(wanted, t);
    }
    EXPECT_NEAR(ranges[static_cast<std::size_t>(beam)], wanted, 1e-9) << beam;
  }
}

// A wall 1 mm thick and 4 m wide at 30 m: the beams within atan(2/30) of the axis meet it.
TEST(RayScene, AThinWallIsSeenByEveryBeamThatMeetsIt) {
  const std::vector<RayTarget> wall = {box({0.001, 4.0, 1.0}, poseAt({30.0005, 0.0, 0.0}))};
  const BeamFan fan = fanOf(20001, -0.1, 0.1);
  const auto ranges = cast(fan, Pose(), wall);
  int seen = 0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double tangent = std::abs(fan.sines[i] / fan.cosines[i]);
    if (tangent * 30.0 < 2.0 - 1e-9) {
      EXPECT_NEAR(ranges[i], 30.0 / fan.cosines[i], 1e-12) << i;
      ++seen;
    } else if (tangent * 30.001 > 2.0 + 1e-9) {
      EXPECT_EQ(ranges[i], kFar) << i;
    }
  }
  EXPECT_GT(seen, 13000);
}

// Against a long way round: the first point of a fine march along the beam that lies within.
TEST(RayScene, AgreesWithAMarchAlongTheBeam) {
  std::mt19937 random(20261127);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const auto point = [&](double r) {
    Vector3 p;
    for (Eigen::Index i = 0; i < 3; ++i) p[i] = r * unit(random);
    return p;
  };
  int hits = 0;
  for (int scene = 0; scene < 100; ++scene) {
    std::vector<Vector3> cloud(12);
    for (Vector3& corner : cloud) corner = point(1.0);
    const ConvexPolyhedron hull = convexHull(cloud, "cloud");
    const Pose X_WT = poseAt(point(3.0), point(3.0));
    const Pose X_WS = poseAt(point(1.0), point(3.0));
    const BeamFan fan = fanOf(36, -kPi, kPi);
    const auto ranges = cast(fan, X_WS, {{hull, RayTarget::kFixed, X_WT}});
    const auto is_inside = [&](const Vector3& p_W, double slack) {
      const Vector3 p = inverseTransform(X_WT, p_W);
      return std::all_of(hull.data().faces.begin(), hull.data().faces.end(), [&](const auto& face) {
        return dot(face.normal, p) <= face.offset + slack;
      });
    };
    for (std::size_t beam = 0; beam < ranges.size(); ++beam) {
      const Vector3 d = times(X_WS.R_AB, {fan.cosines[beam], fan.sines[beam], 0.0});
      if (ranges[beam] < kFar) {
        ++hits;
        EXPECT_TRUE(is_inside(X_WS.p_AB + ranges[beam] * d, 1e-12));
      }
      const double end = std::min(ranges[beam], 8.0);
      for (double t = 0.0; t < end - 1e-9; t += 0.01) {
        ASSERT_FALSE(is_inside(X_WS.p_AB + t * d, -1e-9)) << scene << " " << beam << " " << t;
      }
    }
  }
  EXPECT_GT(hits, 50);
}

TEST(RayScene, FromWithinTheRangeIsZeroAndBehindNothingIsSeen) {
  const BeamFan fan = fanOf(8, -kPi, kPi * 0.75);
  for (const double range : cast(fan, Pose(), {box({1.0, 1.0, 1.0}, Pose())})) {
    EXPECT_EQ(range, 0.0);
  }
  const auto ahead =
      cast(fanOf(1, 0.0, 0.0), Pose(), {box({1.0, 1.0, 1.0}, poseAt({-3.0, 0.0, 0.0}))});
  EXPECT_EQ(ahead[0], kFar);
}

TEST(RayScene, ABeamAlongAFaceOutsideMisses) {
  const auto over = cast(fanOf(1, 0.0, 0.0), poseAt({0.0, 0.0, 0.5 + 1e-9}),
                         {box({1.0, 1.0, 1.0}, poseAt({3.0, 0.0, 0.0}))});
  EXPECT_EQ(over[0], kFar);
  const auto under = cast(fanOf(1, 0.0, 0.0), poseAt({0.0, 0.0, 0.5 - 1e-9}),
                          {box({1.0, 1.0, 1.0}, poseAt({3.0, 0.0, 0.0}))});
  EXPECT_EQ(under[0], 2.5);
}

/// The craft of the laser, and another body, at rest.
BodyStates standingBodies(const Vector3& other = Vector3::Zero()) {
  RigidBodyState<Quaternion> state;
  state.p_WB = other;
  return {RigidBodyState<Quaternion>(), state};
}

struct Scan {
  std::vector<double> ranges;
  std::vector<double> memory;
};

Scan scanOf(const LaserParameters& laser, const std::vector<RayTarget>& targets,
            const BodyStates& bodies, Tick tick = 100) {
  SensorParameters parameters;
  parameters.name = "laser";
  parameters.period = 100;
  parameters.model = laser;
  const auto model = makeSensorModel(parameters, {"craft", 0, Vector3::Zero(), 0.001, &targets});
  const Pose X_WB = poseOf(bodies[0]);
  const SensedInstant instant = {1,         tick, X_WB.p_AB, orientationOf(bodies[0]),
                                 X_WB.R_AB, {},   &bodies};
  Scan scan = {std::vector<double>(model->sampleSize()), std::vector<double>(model->memorySize())};
  model->start(instant, scan.memory.data());
  model->measure(instant, scan.memory.data(), scan.ranges.data());
  return scan;
}

LaserParameters aheadTo(double range_max, int beams = 1) {
  LaserParameters laser;
  laser.beams = beams;
  laser.range_max = range_max;
  return laser;
}

TEST(Laser, SeesOthersWhereTheyAreAndNotItsOwnCraft) {
  const ConvexPolyhedron cube = boxPolyhedron({1.0, 1.0, 1.0});
  const std::vector<RayTarget> targets = {{cube, 0}, {cube, 1}};
  EXPECT_EQ(scanOf(aheadTo(10.0), targets, standingBodies({4.0, 0.0, 0.0})).ranges[0], 3.5);
  EXPECT_EQ(scanOf(aheadTo(10.0), targets, standingBodies({6.0, 0.0, 0.0})).ranges[0], 5.5);
}

TEST(Laser, BeyondItsRangeNothingReturns) {
  const std::vector<RayTarget> wall = {box({1.0, 1.0, 1.0}, poseAt({10.5, 0.0, 0.0}))};
  const BodyStates bodies = standingBodies();
  EXPECT_EQ(scanOf(aheadTo(10.0), wall, bodies).ranges[0], 10.0);
  EXPECT_EQ(scanOf(aheadTo(9.999), wall, bodies).ranges[0], kNoReturn);
  EXPECT_EQ(scanOf(aheadTo(10.0), {}, bodies).ranges[0], kNoReturn);
}

TEST(Laser, EachBeamHasANoiseOfItsOwn) {
  const std::vector<RayTarget> room = {box({100.0, 100.0, 1.0}, poseAt({60.0, 0.0, 0.0}))};
  LaserParameters laser = aheadTo(20.0, 2001);
  laser.angle_min = -0.1;
  laser.angle_max = 0.1;
  laser.range.gaussian_noise = 0.05;
  laser.range.offset = {0.3, 7.0, 7.0};
  const BodyStates bodies = standingBodies();
  const auto ranges = scanOf(laser, room, bodies).ranges;
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double error = ranges[i] - 10.0 / std::cos(-0.1 + 0.0001 * static_cast<double>(i));
    sum += error - 0.3;
    squares += (error - 0.3) * (error - 0.3);
  }
  // Five standard errors of 2001 draws.
  EXPECT_NEAR(sum / 2001.0, 0.0, 5.0 * 0.05 / std::sqrt(2001.0));
  EXPECT_NEAR(std::sqrt(squares / 2001.0) / 0.05, 1.0, 5.0 / std::sqrt(4002.0));
}

TEST(Laser, NoiseMakesNoNegativeRange) {
  const std::vector<RayTarget> wall = {box({1.0, 1.0, 1.0}, poseAt({0.51, 0.0, 0.0}))};
  LaserParameters laser = aheadTo(20.0);
  laser.range.gaussian_noise = 1.0;
  const BodyStates bodies = standingBodies();
  int zeros = 0;
  for (Tick tick = 100; tick < 10000; tick += 100) {
    const double range = scanOf(laser, wall, bodies, tick).ranges[0];
    EXPECT_GE(range, 0.0);
    if (range == 0.0) ++zeros;
  }
  EXPECT_GT(zeros, 20);
}

}  // namespace
}  // namespace hovercraft
