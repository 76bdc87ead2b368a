#include <algorithm>

#include <gtest/gtest.h>

#include "../support/test_world.h"

/// A body near an obstacle that it does not meet costs no query, and is found
/// where it does.

namespace hovercraft {
namespace {

using testing::atRest;
using testing::TestWorld;

bool isSame(const ContactCache& x, const ContactCache& y) {
  return x.a == y.a && x.b == y.b && x.features.a.kind == y.features.a.kind &&
         x.features.a.index == y.features.a.index && x.features.b.kind == y.features.b.kind &&
         x.features.b.index == y.features.b.index && x.resting == y.resting && x.count == y.count;
}

/// Steps a world, and one that knows nothing of the steps before. @returns whether both did the
/// same, to the bit.
bool stepsAlike(TestWorld& world, const TestWorld& unused) {
  TestWorld fresh = unused;
  fresh.states = world.states;
  fresh.contacts = world.contacts;
  world.step();
  fresh.step();
  const auto& x = world.state(0);
  const auto& y = fresh.state(0);
  return x.p_WB == y.p_WB && x.momentum_W == y.momentum_W &&
         x.angular_momentum_W == y.angular_momentum_W && x.orientation.s == y.orientation.s &&
         x.orientation.v == y.orientation.v && world.contacts.size() == fresh.contacts.size() &&
         std::equal(world.contacts.begin(), world.contacts.end(), fresh.contacts.begin(), isSame);
}

/// A plate over a floor, with a wall far ahead. @param twist of it.
TestWorld plateOverFloor(bool planar, double height, const Twist& twist) {
  TestWorld world;
  world.planar = planar;
  world.watch = false;
  world.material() = {0.9, 0.1, false};
  world.gravity = planar ? Vector3::Zero() : Vector3(0.0, 0.0, -0.2);
  world.addWall(Vector3(20.0, 20.0, 1.0), Vector3(0.0, 0.0, -0.5));
  world.addWall(Vector3(1.0, 20.0, 4.0), Vector3(1.5, 0.0, 2.0));
  world.addBox(5.0, Vector3(0.6, 0.4, 0.12), Vector3(0.0, 0.0, 0.06 + height), twist);
  world.world();
  return world;
}

// 3 mm over a floor: no pair is near, and so nothing is remembered of one.
TEST(Hovering, OverAFloorNoPairIsNear) {
  for (const bool planar : {true, false}) {
    for (const double speed : {0.2, 2.0, 10.0}) {
      TestWorld world;
      world.planar = planar;
      world.watch = false;
      world.addWall(Vector3(200.0, 20.0, 1.0), Vector3(0.0, 0.0, -0.5));
      world.addBox(5.0, Vector3(0.6, 0.4, 0.12), Vector3(0.0, 0.0, 0.063),
                   {Vector3(speed, 0.0, 0.0), Vector3(0.0, 0.0, 0.5)});
      for (int i = 0; i < 100; ++i) {
        world.step();
        EXPECT_TRUE(world.contacts.empty()) << planar << " " << speed;
      }
      EXPECT_NEAR(world.state(0).p_WB.x(), 0.1 * speed, 1e-12);
    }
  }
}

// What is known of a craft that was near nothing is used as long as it holds: a plate that sinks,
// tilts down to one corner, turns or flies on to a wall meets what a world meets that knows
// nothing.
TEST(Hovering, WhatIsKnownOfEarlierStepsChangesNothing) {
  const Twist twists[] = {{Vector3(0.4, 0.1, 0.0), Vector3::Zero()},
                          {Vector3::Zero(), Vector3(0.05, 0.3, 0.0)},
                          {Vector3(0.3, 0.0, 0.2), Vector3(0.02, -0.01, 1.5)},
                          {Vector3(3.0, 0.2, 0.01), Vector3(0.0, 0.0, 0.2)}};
  std::size_t contacts = 0;
  for (const bool planar : {true, false}) {
    for (const double height : {0.003, 0.03}) {
      for (const Twist& twist : twists) {
        TestWorld world = plateOverFloor(planar, height, twist);
        const TestWorld unused = world;
        std::size_t alone = 0;
        for (int step = 0; step < 1500; ++step) {
          ASSERT_TRUE(stepsAlike(world, unused)) << planar << ' ' << height << ' ' << step;
          if (world.contacts.empty()) ++alone;
        }
        EXPECT_GT(alone, 100U);
        contacts += world.records.size();
      }
    }
  }
  EXPECT_GT(contacts, 10U);
}

// What was known of a slow body is forgotten when it is fast.
TEST(Hovering, WhatIsKnownOfASlowBodyIsNotOfAFastOne) {
  TestWorld world = plateOverFloor(false, 0.003, atRest());
  const TestWorld unused = world;
  const auto place = [&world](double height, double speed) {
    world.states[0] =
        world.mobility(0).stateOfMotion(Vector3(0.0, 0.0, 0.06 + height), Quaternion(),
                                        Twist{Vector3(0.0, 0.0, speed), Vector3::Zero()});
  };
  for (const double speed : {0.0, -2.0, 2.0, -2.0}) {
    for (const double height : {0.02, 0.0025, 0.02}) {
      place(height, speed);
      ASSERT_TRUE(stepsAlike(world, unused)) << speed << ' ' << height;
    }
  }
}

/// A body that flies 20 m along an axis and back again.
void expectTheWallIsMet(const Vector3& start, const Vector3& along) {
  TestWorld world;
  world.watch = false;
  world.material() = {1.0, 0.0, false};
  world.addWall(Vector3::Constant(4.0), start + 22.5 * along);
  world.addBox(1.0, Vector3::Ones(), start, {100.0 * along, Vector3::Zero()});
  world.step(400);
  EXPECT_EQ(world.records.size(), 1U) << along.transpose() << ' ' << start.transpose();
  EXPECT_NEAR(dot(Vector3(world.state(0).p_WB - start), along), 0.0, 1e-5);
}

// Far from everything little is looked at, on the way along whatever axis, wherever that is: the
// wall is met.
TEST(Hovering, WhatComesFromFarAwayMeetsTheWallInEachDirection) {
  for (int axis = 0; axis < 3; ++axis) {
    for (int other = 0; other < 3; ++other) {
      for (const double place : {-300.0, 300.0}) {
        const Vector3 start = place * Vector3::Unit(other);
        expectTheWallIsMet(start, Vector3::Unit(axis));
        expectTheWallIsMet(start, -Vector3::Unit(axis));
      }
    }
  }
}

// 3 mm over the floor, and 0.7 m before a wall: bodies may go twice as far as they do now.
TEST(Hovering, WhetherTheNextStepsAreClearIsSeenFromTheMotion) {
  const auto is_clear = [](const Vector3& v, double steps) {
    TestWorld world = plateOverFloor(false, 0.003, {v, Vector3::Zero()});
    return world.world().isClearAhead(world.states, steps);
  };
  EXPECT_TRUE(is_clear(Vector3(10.0, 0.0, 0.0), 34.0));
  EXPECT_FALSE(is_clear(Vector3(10.0, 0.0, 0.0), 36.0));
  EXPECT_TRUE(is_clear(Vector3(0.0, 0.0, -0.2), 7.0));
  EXPECT_FALSE(is_clear(Vector3(0.0, 0.0, -0.2), 8.0));
}

TEST(Hovering, StepsAreNotClearAheadWhereBodiesTouchOrAreMany) {
  TestWorld touching = plateOverFloor(false, 0.0, atRest());
  touching.step();
  EXPECT_FALSE(touching.world().isClearAhead(touching.states, 1.0));
  for (const int count : {15, 17}) {
    TestWorld many;
    for (int i = 0; i < count; ++i) {
      many.addBox(1.0, Vector3::Constant(0.2), Vector3(i, 0.0, 0.0),
                  {Vector3(1.0, 0.0, 0.0), Vector3::Zero()});
    }
    EXPECT_EQ(many.world().isClearAhead(many.states, 100.0), count == 15);
    EXPECT_FALSE(many.world().isClearAhead(many.states, 250.0));
  }
}

// What hovers over a floor at rest is hit from above at 50 m/s: within the step
// it would go 5 cm, and the floor was not looked at.
TEST(Hovering, ABodyThatIsStruckTowardsAFloorMeetsIt) {
  TestWorld world;
  world.material() = {0.5, 0.0, false};
  world.addWall(Vector3(20.0, 20.0, 1.0), Vector3(0.0, 0.0, -0.5));
  world.addBox(1.0, Vector3(0.6, 0.4, 0.12), Vector3(0.0, 0.0, 0.063), atRest());
  world.addBox(5.0, Vector3(0.6, 0.4, 0.12), Vector3(0.0, 0.0, 0.063 + 0.12 + 0.01),
               {Vector3(0.0, 0.0, -50.0), Vector3::Zero()});
  world.step(20);
  EXPECT_GT(world.least_gap, 0.0);
  EXPECT_GE(world.records.size(), 3U);
  EXPECT_GT(world.twist(0).v_WB.z(), 0.0);
}

}  // namespace
}  // namespace hovercraft
