#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "../support/test_world.h"

/// Who may meet whom, in which groups, and what is set right between those that touch.

namespace hovercraft {
namespace {

using testing::atRest;
using testing::TestWorld;

bool isSame(const BodyState& a, const BodyState& b) {
  const auto& x = std::get<RigidBodyState<Quaternion>>(a);
  const auto& y = std::get<RigidBodyState<Quaternion>>(b);
  return x.p_WB == y.p_WB && x.momentum_W == y.momentum_W &&
         x.angular_momentum_W == y.angular_momentum_W && x.orientation.s == y.orientation.s &&
         x.orientation.v == y.orientation.v;
}

/// Three boxes in a pen, moved by `shift`.
void addPenWithBoxes(TestWorld& world, const Vector3& shift) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double side : {-1.0, 1.0}) {
      Vector3 size = Vector3::Constant(4.0);
      size[axis] = 1.0;
      Vector3 center = shift;
      center[axis] += side * 1.5;
      world.addWall(size, center);
    }
  }
  for (int i = 0; i < 3; ++i) {
    const double a = 0.3 * i;
    world.addBox(1.0 + i, Vector3(0.2, 0.3, 0.4), shift + Vector3(-0.5 + 0.5 * i, a - 0.3, 0.0),
                 {Vector3(1.5 - i, 2.0 * a + 0.4, 0.7), Vector3(a, 1.0, -0.5)});
  }
}

// A list of neighbours is kept from step to step; worlds that have none yet give the same bits.
TEST(Neighbours, OfEarlierStepsChangeNothing) {
  TestWorld world;
  world.material() = {0.7, 0.2, false};
  addPenWithBoxes(world, Vector3::Zero());
  world.watch = false;
  world.world();
  const TestWorld unused = world;
  for (int step = 0; step < 1500; ++step) {
    TestWorld fresh = unused;
    fresh.states = world.states;
    fresh.contacts = world.contacts;
    world.step();
    fresh.step();
    for (std::size_t i = 0; i < 3; ++i) ASSERT_TRUE(isSame(fresh.states[i], world.states[i]));
  }
  EXPECT_GT(world.records.size(), 10U);
}

// Two pens 100 m from each other are two groups: each moves as if it were alone.
TEST(Groups, ThatAreFarFromEachOtherDoNotKnowOfEachOther) {
  TestWorld both;
  TestWorld alone;
  for (TestWorld* world : {&both, &alone}) {
    world->material() = {0.7, 0.2, false};
    world->watch = false;
    addPenWithBoxes(*world, Vector3::Zero());
  }
  addPenWithBoxes(both, Vector3(128.0, 0.0, 0.0));
  both.step(1500);
  alone.step(1500);
  EXPECT_GT(alone.records.size(), 10U);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(isSame(both.states[i], alone.states[i])) << i;
}

// A chain is one group: what is hit at one end leaves at the other, in the same step.
TEST(Groups, HoldWhatIsNearThroughOthers) {
  TestWorld world;
  world.material() = {1.0, 0.0, false};
  world.addBox(1.0, Vector3::Constant(0.2), Vector3(-0.2005, 0.0, 0.0),
               {Vector3(5.0, 0.0, 0.0), Vector3::Zero()});
  for (int i = 0; i < 4; ++i) {
    world.addBox(1.0, Vector3::Constant(0.2), Vector3(0.2001 * i, 0.0, 0.0), atRest());
  }
  world.step();
  EXPECT_NEAR(world.twist(4).v_WB.x(), 5.0, 1e-9);
  EXPECT_NEAR(world.twist(0).v_WB.x(), 0.0, 1e-9);
}

// 5 % of the tolerance are left between boxes of 1 kg and 3 kg: they are set apart to half of it,
// the light one by three quarters.
TEST(Repair, SetsApartInProportionToMobility) {
  TestWorld world;
  world.addBox(1.0, Vector3::Constant(0.2), Vector3::Zero(), atRest());
  world.addBox(3.0, Vector3::Constant(0.2), Vector3(0.2 + 0.05e-6, 0.0, 0.0), atRest());
  TestWorld placed = world;
  placed.world();
  for (std::size_t i = 0; i < 2; ++i) placed.states[i] = world.states[i];
  placed.step();
  const double light = placed.state(0).p_WB.x();
  const double heavy = placed.state(1).p_WB.x() - (0.2 + 0.05e-6);
  EXPECT_NEAR(heavy - light, 0.45e-6, 1e-12);
  EXPECT_NEAR(light, -0.75 * 0.45e-6, 1e-12);
  EXPECT_LT(norm(placed.twist(0).v_WB), 1e-15);
}

TEST(Repair, LeavesAloneWhatHasAGap) {
  TestWorld world;
  world.addBox(1.0, Vector3::Constant(0.2), Vector3::Zero(), atRest());
  world.addBox(3.0, Vector3::Constant(0.2), Vector3(0.2 + 0.2e-6, 0.0, 0.0), atRest());
  TestWorld placed = world;
  placed.world();
  for (std::size_t i = 0; i < 2; ++i) placed.states[i] = world.states[i];
  placed.step();
  EXPECT_EQ(placed.state(0).p_WB.x(), 0.0);
  EXPECT_EQ(placed.state(1).p_WB.x(), 0.2 + 0.2e-6);
}

}  // namespace
}  // namespace hovercraft
