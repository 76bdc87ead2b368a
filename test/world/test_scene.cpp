#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/cushion/cushion.h"
#include "hovercraft_sim/cushion/ground.h"
#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/hovercraft/ground_forces.h"
#include "hovercraft_sim/math/rotation.h"

#include "../cushion/flown_craft.h"
#include "../support/test_world.h"

/// What a world says of its bodies and obstacles, and the bounds on how they move.

namespace hovercraft {
namespace {

using testing::atRest;
using testing::rc5Cushion;
using testing::TestWorld;

/// Each of its corners is extreme in some direction.
ConvexPolyhedron tetrahedron() {
  return convexHull({Vector3(2.0, 0.0, 0.3), Vector3(-1.0, 3.0, 0.2), Vector3(0.0, -0.5, 4.0),
                     Vector3(0.3, 0.2, -5.0)},
                    "tetrahedron");
}

Scene sceneOf(std::vector<WorldBody> bodies, std::vector<WorldObstacle> obstacles) {
  WorldConfig config;
  config.step = 0.001;
  return Scene(config, std::move(bodies), std::move(obstacles));
}

WorldBody bodyOf(const std::string& name, const MassProperties& mass,
                 const ConvexPolyhedron& hull) {
  const std::array<EngineParameters, kEngineCount> engines{};
  return {name,
          {Mobility::spatial(mass.mass, mass.I_BBo_B), EngineGeometry(engines, Vector3::Zero()),
           Drag(), Vector3::Zero()},
          hull,
          0};
}

TEST(Scene, IndicesAreOfTheBodiesAndThenOfTheObstacles) {
  const Vector3 size = Vector3::Ones();
  const ConvexPolyhedron box = boxPolyhedron(size);
  const Pose origin = {Matrix3::Identity(), Vector3::Zero()};
  std::vector<WorldObstacle> obstacles;
  for (const std::int32_t whole : {0, 0, -1}) {
    obstacles.push_back({"o" + std::to_string(obstacles.size()), box, origin, 0, whole});
  }
  const Scene scene = sceneOf({bodyOf("b0", boxMassProperties(1.0, size), box),
                               bodyOf("b1", boxMassProperties(2.0, size), box)},
                              obstacles);
  const char* names[] = {"b0", "b1", "o0", "o1", "o2"};
  const std::int32_t wholes[] = {0, 1, 2, 2, 4};
  for (std::int32_t i = 0; i < 5; ++i) {
    EXPECT_EQ(scene.nameOf(i), names[i]);
    EXPECT_EQ(scene.wholeOf(i), wholes[i]) << i;
    EXPECT_EQ(scene.isFixed(i), i >= 2);
  }
}

TEST(Scene, BoxOfAnObstacleHoldsEachOfItsCornersAndNoMore) {
  const Pose X_WO = {rotationFromRpy({0.2, -0.4, 1.0}), Vector3(5.0, -2.0, 1.0)};
  const Scene scene = sceneOf({}, {{"rock", tetrahedron(), X_WO, 0}});
  Vector3 low = Vector3::Constant(1e9);
  Vector3 high = -low;
  const ConvexPolyhedron hull = tetrahedron();
  for (int i = 0; i < hull.vertexCount(); ++i) {
    const Vector3 p = transform(X_WO, hull.vertex(i));
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EXPECT_EQ(scene.fixedBox(0).low, low);
  EXPECT_EQ(scene.fixedBox(0).high, high);
}

// Bodies with an easy axis each turn about it, and about others, while they fly: no corner goes
// farther along an axis of W than the bound says.
TEST(Scene, NoPointGoesFartherThanTheMotionBound) {
  const unsigned seed = 11;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto vector = [&] { return Vector3(normal(random), normal(random), normal(random)); };
  const Vector3 sizes[] = {{4.0, 0.1, 0.1}, {0.1, 4.0, 0.1}, {0.1, 0.1, 4.0}, {1.0, 2.0, 3.0}};
  double nearest = 0.0;
  for (const Vector3& size : sizes) {
    const ConvexPolyhedron box = boxPolyhedron(size);
    const Scene scene = sceneOf({bodyOf("body", boxMassProperties(1.5, size), box)}, {});
    for (int trial = 0; trial < 200; ++trial) {
      const Mobility& mobility = scene.mobilityOf(0);
      Vector3 spin = vector();
      spin[trial % 3] *= 20.0;
      const BodyState from = mobility.stateOfMotion(vector(), quaternionFromRpy(vector()),
                                                    Twist{0.1 * vector(), spin});
      std::vector<BodyState> to;
      scene.moveAll({from}, {StepInputs()}, to);
      const Vector3 bound = scene.motionBoundOf(0, from, to[0], 0.001);
      const Pose before = poseOf(from);
      const Pose after = poseOf(to[0]);
      for (int i = 0; i < box.vertexCount(); ++i) {
        const Vector3 way =
            (transform(after, box.vertex(i)) - transform(before, box.vertex(i))).cwiseAbs();
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          ASSERT_LE(way[axis], bound[axis]) << trial << ' ' << size.transpose();
          nearest = std::max(nearest, way[axis] / bound[axis]);
        }
      }
    }
  }
  EXPECT_GT(nearest, 0.5);  // nor much less
}

// Fans that slow down over a step: a piece of it has their speeds of then, as a step of its own has
// that goes so far.
TEST(Scene, APieceOfAStepHasTheFansSpeedsOfThen) {
  const double h = 0.001;
  const Vector3 size(0.6, 0.4, 0.12);
  const PlaneGround floor{GroundPlane()};
  WorldBody craft = bodyOf("craft", boxMassProperties(5.0, size), boxPolyhedron(size));
  craft.model.ground_forces =
      std::make_shared<GroundForces>(Cushion(rc5Cushion(), Vector3::Zero()), Pads(), std::nullopt);
  StepInputs whole;
  whole.environment.ground = &floor;
  StepInputs half = whole;
  const auto all_at = [](double speed) {
    FanSpeeds speeds;
    speeds.fill(speed);
    return speeds;
  };
  whole.fan_speeds = {all_at(1.0), all_at(0.75), all_at(0.5)};
  half.fan_speeds = {all_at(1.0), all_at(0.875), all_at(0.75)};
  const Scene scene = sceneOf({craft}, {});
  const BodyState start =
      scene.mobilityOf(0).stateOfMotion(Vector3(0.0, 0.0, 0.004), Quaternion(), atRest());
  WorldConfig config = scene.config();
  config.step = 0.5 * h;
  const Scene shorter(config, {craft}, {});
  const BodyState cut = scene.moved(0, start, whole, {0.0, 0.5 * h}, Wrench());
  const BodyState alone = shorter.moved(0, start, half, {0.0, 0.5 * h}, Wrench());
  const auto& x = std::get<RigidBodyState<Quaternion>>(cut);
  const auto& y = std::get<RigidBodyState<Quaternion>>(alone);
  EXPECT_EQ(x.momentum_W, y.momentum_W);
  EXPECT_EQ(x.p_WB, y.p_WB);
  EXPECT_GT(norm(x.momentum_W), 0.001);  // the cushion is no matter of rounding
}

TEST(World, SaysHowNearItsBodiesAreAndWhichOverlap) {
  TestWorld world;
  world.watch = false;
  for (const double x : {0.0, 1.3, 3.5}) {
    world.addBox(1.0, Vector3::Ones(), Vector3(x, 0.0, 0.0), atRest());
  }
  const World& asked = world.world();
  EXPECT_NEAR(asked.leastGap(world.states), 0.3, 1e-15);
  const double tolerance = world.config.tolerance;
  const auto put = [&](double gap) {
    world.states[1] =
        world.mobility(1).stateOfMotion(Vector3(1.0 + gap, 0.0, 0.0), Quaternion(), atRest());
  };
  put(0.2 * tolerance);
  EXPECT_FALSE(asked.tooClose(world.states).has_value());
  EXPECT_FALSE(asked.overlap(world.states).has_value());
  put(0.05 * tolerance);  // less than what resting bodies keep
  ASSERT_TRUE(asked.tooClose(world.states).has_value());
  EXPECT_EQ(asked.tooClose(world.states)->a, "body100");
  EXPECT_EQ(asked.tooClose(world.states)->b, "body101");
  EXPECT_FALSE(asked.overlap(world.states).has_value());
  put(-2.0 * tolerance);
  ASSERT_TRUE(asked.overlap(world.states).has_value());
  EXPECT_NEAR(asked.overlap(world.states)->depth, 2.0 * tolerance, 1e-15);
}

}  // namespace
}  // namespace hovercraft
