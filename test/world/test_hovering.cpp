#include <gtest/gtest.h>

#include "../support/test_world.h"

/// A body near an obstacle that it does not meet costs no query, and is found
/// where it does.

namespace hovercraft {
namespace {

using testing::atRest;
using testing::TestWorld;

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
        EXPECT_TRUE(world.memory.empty()) << planar << " " << speed;
      }
      EXPECT_NEAR(world.state(0).p_WB.x(), 0.1 * speed, 1e-12);
    }
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
