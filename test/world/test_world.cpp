#include "../support/test_world.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/math/contact_tolerances.h"
#include "hovercraft_sim/sim/state_hash.h"

#include "../support/share.h"

namespace hovercraft {
namespace {

using testing::atRest;
using testing::TestWorld;

constexpr double kEpsilon = 1e-6;  // m, the default tolerance
const Vector3 kGravity(0.0, 0.0, -9.81);

int countOf(const TestWorld& world, ContactKind kind) {
  return static_cast<int>(
      std::count_if(world.records.begin(), world.records.end(),
                    [kind](const ContactRecord& record) { return record.kind == kind; }));
}

/// Of all bodies about the origin of the world, kg m²/s.
Vector3 angularMomentumOf(const TestWorld& world) {
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 0; i < world.states.size(); ++i) {
    sum +=
        cross(world.state(i).p_WB, world.state(i).momentum_W) + world.state(i).angular_momentum_W;
  }
  return sum;
}

/// A floor whose upper side is z = 0, and gravity.
void addFloor(TestWorld& world) {
  world.gravity = kGravity;
  world.addWall(Vector3(20.0, 20.0, 1.0), Vector3(0.0, 0.0, -0.5));
}

TEST(World, ABoxBouncesAtTheTimeAndWithTheSpeedOfTheClosedForm) {
  TestWorld world;
  world.material() = {0.5, 0.0, false};
  addFloor(world);
  world.addBox(2.0, Vector3(0.2, 0.3, 0.4), Vector3(0.0, 0.0, 1.2), atRest());
  world.step(500);
  ASSERT_EQ(world.records.size(), 1U);
  // Falls 1 m: t = sqrt(2 / g), v = sqrt(2 g); the impact is found up to a µm before the floor.
  const double v = std::sqrt(2.0 * 9.81);
  const double after = 0.5 - v / 9.81;  // s since the impact
  EXPECT_NEAR(world.records[0].impulse_B_W.z(), -2.0 * 1.5 * v, 1e-5);
  EXPECT_NEAR(norm(world.records[0].nhat_AB_W - Vector3(0.0, 0.0, -1.0)), 0.0, 1e-14);
  EXPECT_NEAR(world.twist(0).v_WB.z(), 0.5 * v - 9.81 * after, 1e-5);
  EXPECT_GT(world.least_gap, 0.0);
}

TEST(World, TenStackedBoxesStandForAMinute) {
  TestWorld world;
  world.config.step = 0.004;
  world.material() = {0.0, 0.5, false};
  addFloor(world);
  for (int i = 0; i < 10; ++i) {
    world.addBox(1.0, Vector3::Constant(0.2), Vector3(0.0, 0.0, 0.1 + 0.2 * i), atRest());
  }
  world.watch = false;
  world.world();
  const std::vector<BodyState> start = world.states;
  double farthest = 0.0;
  for (int second = 0; second < testing::shareOf(60); ++second) {
    world.step(250);
    EXPECT_GT(world.world().leastGap(world.states), -kEpsilon);
    for (std::size_t i = 0; i < start.size(); ++i) {
      const Vector3 from = std::get<RigidBodyState<Quaternion>>(start[i]).p_WB;
      farthest = std::max(farthest, norm(world.state(i).p_WB - from));
    }
  }
  EXPECT_LT(farthest, 1e-3);
  EXPECT_EQ(world.world().stalls(), 0);
}

// A millimetre-exact tower has nothing to sway by; one whose boxes lie 2 cm off each other does.
TEST(World, TwentyBoxesOffEachOtherStandStill) {
  TestWorld world;
  world.material() = {0.0, 0.5, false};
  addFloor(world);
  for (int i = 0; i < 20; ++i) {
    const double x = i % 2 == 0 ? -0.01 : 0.01;
    const double y = i / 2 % 2 == 0 ? -0.01 : 0.01;
    world.addBox(1.0, Vector3::Constant(0.2), Vector3(x, y, 0.1 + 0.2 * i), atRest());
  }
  world.watch = false;
  double fastest = 0.0;
  for (int i = 0; i < 500; ++i) {
    world.step(1);
    if (i < 100) continue;
    for (std::size_t k = 0; k < 20; ++k) {
      fastest = std::max(fastest, norm(world.twist(k).v_WB));
    }
  }
  EXPECT_LT(fastest, 1e-6);
  EXPECT_GT(world.world().leastGap(world.states), -kEpsilon);
  EXPECT_EQ(world.world().stalls(), 0);
}

TEST(World, ABallComesToRestAfterABoundedNumberOfImpacts) {
  TestWorld world;
  world.material() = {0.5, 0.5, false};
  addFloor(world);
  const ConvexPolyhedron ball = cylinderPolyhedron(0.1, 0.2, 12);
  world.addBody(sphereMassProperties(1.0, 0.1), ball, Vector3(0.0, 0.0, 0.6), atRest(),
                Vector3(0.3, 0.2, 0.0));
  world.step(4000);
  EXPECT_LT(world.records.size(), 200U);
  EXPECT_GE(countOf(world, ContactKind::kRest), 1);
  EXPECT_LT(norm(world.twist(0).v_WB), 1e-3);
  EXPECT_LT(norm(world.twist(0).w_WB), 1e-2);
  EXPECT_GT(world.least_gap, 0.0);
  EXPECT_EQ(world.world().stalls(), 0);
}

TEST(World, ElasticBouncesInAPenKeepTheEnergy) {
  TestWorld world;
  world.config.step = 0.0005;
  world.material() = {1.0, 0.0, false};
  world.addPen(Vector3(1.0, 1.2, 1.4));
  world.addBox(1.0, Vector3(0.2, 0.3, 0.4), Vector3::Zero(),
               {Vector3(0.9, 0.7, 0.5), Vector3(1.0, 2.0, 3.0)});
  world.watch = false;
  const double before = world.energy(0);
  while (world.records.size() < 200U) world.step(100);
  EXPECT_NEAR(world.energy(0) / before, 1.0, 1e-9);
}

// The largest ratio of masses that a scenario may have: the heavy box comes to rest on the light
// one, and no step is cut off.
TEST(World, ABoxFallsOnOneOfATenThousandthOfItsMass) {
  TestWorld world;
  world.gravity = Vector3(0.0, 0.0, -9.81);
  world.config.integrator = Integrator::kHeun;
  world.material() = {0.5, 0.5, false};
  world.addWall(Vector3(20.0, 20.0, 1.0), Vector3(0.0, 0.0, -0.5));
  world.addBox(1.0 / kMostMassRatio, Vector3::Constant(0.2), Vector3(0.0, 0.0, 0.102), atRest());
  world.addBox(1.0, Vector3::Constant(0.2), Vector3(0.0, 0.0, 0.304), atRest());
  world.step(200);
  EXPECT_EQ(world.world().stalls(), 0);
  EXPECT_GT(world.least_gap, 0.0);
  EXPECT_NEAR(world.state(1).p_WB.z(), 0.3, 1e-5);
  EXPECT_LT(norm(world.twist(1).v_WB), 1e-3);
}

TEST(World, TheLastBoxOfACradleLeavesWithTheSpeedOfTheFirst) {
  TestWorld world;
  world.planar = true;
  world.material() = {1.0, 0.0, false};
  world.addBox(1.0, Vector3::Constant(0.2), Vector3(-0.5, 0.0, 0.0),
               {Vector3(1.0, 0.0, 0.0), Vector3::Zero()});
  for (int i = 0; i < 4; ++i) {
    world.addBox(1.0, Vector3::Constant(0.2), Vector3(0.201 * i, 0.0, 0.0), atRest());
  }
  world.step(400);
  EXPECT_EQ(world.records.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(norm(world.twist(i).v_WB), 1e-12);
  EXPECT_NEAR(world.twist(4).v_WB.x(), 1.0, 1e-12);
}

// A round foot of more corners than a face is followed with.
TEST(World, ACanOfManySidesStands) {
  TestWorld world;
  world.material() = {0.0, 0.5, false};
  addFloor(world);
  world.addBody(cylinderMassProperties(1.0, 0.1, 0.3), cylinderPolyhedron(0.1, 0.3, 128),
                Vector3(0.0, 0.0, 0.15), atRest());
  world.step(3000);
  EXPECT_NEAR(world.state(0).p_WB.z(), 0.15, 2.0 * kEpsilon);
  EXPECT_LT(norm(world.twist(0).w_WB), 1e-3);
  EXPECT_LT(norm(orientationOf(world.states[0]).v), 1e-5);
  EXPECT_GT(world.least_gap, 0.0);
}

/// A craft of 5 kg that a load of 2 N drives into a wall.
struct AtTheWall : TestWorld {
  AtTheWall() {
    planar = true;
    material() = {0.0, 0.2, false};
    addWall(Vector3(0.2, 20.0, 1.0), Vector3(1.1, 0.0, 0.0));
    addBox(5.0, Vector3(0.6, 0.4, 0.12), Vector3(0.5, 0.0, 0.0),
           {Vector3(0.3, 0.0, 0.0), Vector3::Zero()});
    world();
  }
  void push(const Vector3& force) {
    inputs[0].load.in_world.force = force;
    inputs[0].is_loaded = true;
  }
};

TEST(World, ACraftDrivenIntoAWallStaysThere) {
  AtTheWall world;
  world.push(Vector3(2.0, 0.0, 0.0));
  world.step(3000);
  EXPECT_LT(norm(world.twist(0).v_WB), 1e-6);
  EXPECT_NEAR(world.state(0).p_WB.x(), 0.7, 2.0 * kEpsilon);
  EXPECT_EQ(countOf(world, ContactKind::kRest), 1);
  EXPECT_GT(world.least_gap, 0.0);
}

TEST(World, ACraftSlidesAlongAWallAgainstFriction) {
  AtTheWall world;
  world.push(Vector3(2.0, 0.0, 0.0));
  world.step(2000);
  const double y = world.state(0).p_WB.y();
  world.push(Vector3(2.0, 0.3, 0.0));  // friction holds up to 0.4 N
  world.step(1000);
  EXPECT_NEAR(world.state(0).p_WB.y(), y, 1e-6);
  world.push(Vector3(2.0, 1.0, 0.0));  // 0.6 N are left: 0.12 m/s²
  world.step(1000);
  EXPECT_NEAR(world.twist(0).v_WB.y(), 0.12, 1e-6);
  EXPECT_NEAR(world.state(0).p_WB.y() - y, 0.06, 1e-4);
  EXPECT_NEAR(world.state(0).p_WB.x(), 0.7, 2.0 * kEpsilon);
}

TEST(World, ACraftLeavesTheWallWhenItsEngineTurns) {
  AtTheWall world;
  world.push(Vector3(2.0, 0.0, 0.0));
  world.step(2000);
  world.push(Vector3(-2.0, 0.0, 0.0));
  world.step(1000);
  EXPECT_NEAR(world.twist(0).v_WB.x(), -0.4, 1e-5);
  EXPECT_NEAR(world.state(0).p_WB.x(), 0.5, 1e-4);
}

TEST(World, ABoxSticksOrSlidesOnAnInclineAsItsFrictionSays) {
  const double slope = std::atan(0.5);  // slides if mu < 0.5
  for (const double mu : {0.3, 0.6}) {
    TestWorld world;
    world.gravity = Vector3(9.81 * std::sin(slope), 0.0, -9.81 * std::cos(slope));
    world.addWall(Vector3(20.0, 20.0, 1.0), Vector3(0.0, 0.0, -0.5));
    world.material() = {0.0, mu, false};
    world.addBox(1.0, Vector3(0.4, 0.4, 0.1), Vector3(0.0, 0.0, 0.05), atRest());
    world.step(1000);
    const double expected = mu > 0.5 ? 0.0 : 9.81 * (std::sin(slope) - mu * std::cos(slope));
    EXPECT_NEAR(world.twist(0).v_WB.x(), expected, 1e-3) << "mu " << mu;
    EXPECT_GT(world.least_gap, 0.0);
  }
}

TEST(World, NothingOverlapsInAFallingHeap) {
  for (const double e : {0.0, 0.4}) {
    TestWorld world;
    world.config.integrator = Integrator::kHeun;
    world.gravity = kGravity;
    world.material() = {e, 0.5, false};
    world.addPen(Vector3(0.7, 0.7, 3.0));
    std::mt19937 random(21);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (int i = 0; i < 8; ++i) {
      const Vector3 p(0.1 * uniform(random), 0.1 * uniform(random), -1.2 + 0.36 * i);
      world.addBox(1.0, Vector3::Constant(0.2), p, atRest(),
                   Vector3(uniform(random), uniform(random), uniform(random)));
    }
    world.step(1200);
    EXPECT_GT(world.least_gap, -kEpsilon) << "seed 21, e " << e;
    EXPECT_EQ(world.world().stalls(), 0);
    EXPECT_GT(world.records.size(), 8U);
  }
}

TEST(World, ABodyFarFromAllOthersMovesAsWithoutAWorld) {
  TestWorld alone;
  TestWorld beside;
  for (TestWorld* world : {&alone, &beside}) {
    world->gravity = kGravity;
    world->addBox(1.0, Vector3(0.2, 0.3, 0.4), Vector3(0.0, 0.0, 5.0),
                  {Vector3(1.0, 0.0, 0.0), Vector3(1.0, 2.0, 3.0)});
  }
  beside.addWall(Vector3(1.0, 1.0, 1.0), Vector3(0.0, 0.0, -40.0));
  beside.addBox(1.0, Vector3::Constant(0.2), Vector3(0.0, 0.0, -39.4), atRest());
  alone.step(300);
  beside.step(300);
  StateHash a;
  StateHash b;
  a.add(alone.states[0]);
  b.add(beside.states[0]);
  EXPECT_EQ(a.value(), b.value());
}

TEST(World, StickIsPlasticAndKeepsTheMomentum) {
  TestWorld world;
  world.material() = {1.0, 0.0, true};
  world.addBox(1.0, Vector3::Constant(0.2), Vector3(-0.5, 0.02, 0.03),
               {Vector3(1.0, 0.0, 0.0), Vector3::Zero()});
  world.addBox(3.0, Vector3::Constant(0.2), Vector3::Zero(), atRest());
  while (world.records.empty()) world.step();
  EXPECT_EQ(world.records[0].kind, ContactKind::kStick);
  const Vector3 P = world.state(0).momentum_W + world.state(1).momentum_W;
  EXPECT_LT(norm(P - Vector3(1.0, 0.0, 0.0)), 1e-13);
  const Vector3 p_WC = world.records[0].p_WC;
  const Vector3 v = velocityOfPoint(world.twist(0), p_WC, world.state(0).p_WB) -
                    velocityOfPoint(world.twist(1), p_WC, world.state(1).p_WB);
  EXPECT_LT(norm(v), 1e-7);  // they turned on until the end of the step
}

TEST(World, APairThatSticksFliesOnAsOne) {
  TestWorld world;
  world.material() = {1.0, 0.0, true};
  world.addBox(1.0, Vector3::Constant(0.2), Vector3(-0.5, 0.0, 0.0),
               {Vector3(1.0, 0.0, 0.0), Vector3::Zero()});
  world.addBox(3.0, Vector3::Constant(0.2), Vector3::Zero(), atRest());
  world.step(2000);
  EXPECT_EQ(world.records.size(), 1U);
  EXPECT_EQ(countOf(world, ContactKind::kStick), 1);
  EXPECT_NEAR(world.twist(0).v_WB.x(), 0.25, 1e-12);
  EXPECT_NEAR(world.twist(1).v_WB.x(), 0.25, 1e-12);
  EXPECT_NEAR(world.state(1).p_WB.x() - world.state(0).p_WB.x(), 0.2, kEpsilon);
  EXPECT_GT(world.least_gap, 0.0);
}

TEST(World, AFreePairThatMeetsKeepsMomentumAndAngularMomentum) {
  for (const double e : {0.0, 0.5, 1.0}) {
    TestWorld world;
    world.material() = {e, 0.3, false};
    world.addBox(1.0, Vector3::Constant(0.2), Vector3(-0.5, 0.03, 0.05),
                 {Vector3(1.0, 0.1, -0.2), Vector3(0.5, -1.0, 2.0)});
    world.addBox(3.0, Vector3(0.2, 0.3, 0.4), Vector3::Zero(),
                 {Vector3::Zero(), Vector3(1.0, 0.2, 0.3)});
    const Vector3 P = world.state(0).momentum_W + world.state(1).momentum_W;
    const Vector3 L = angularMomentumOf(world);
    while (world.records.empty()) world.step();
    EXPECT_LT(norm(world.state(0).momentum_W + world.state(1).momentum_W - P), 1e-13) << e;
    EXPECT_LT(norm(angularMomentumOf(world) - L), 1e-13) << e;
  }
}

}  // namespace
}  // namespace hovercraft
