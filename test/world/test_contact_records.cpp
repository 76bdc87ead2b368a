#include <gtest/gtest.h>

#include "../support/test_world.h"

/// What is written down of a contact, by numbers that are known.

namespace hovercraft {
namespace {

using testing::atRest;
using testing::TestWorld;

/// A block of 2 kg over a floor whose upper side is z = 0.
TestWorld blockOverFloor(double height, const Twist& twist,
                         const Vector3& gravity = Vector3::Zero()) {
  TestWorld world;
  world.gravity = gravity;
  world.addWall(Vector3(20.0, 20.0, 1.0), Vector3(0.0, 0.0, -0.5));
  world.addBox(2.0, Vector3(0.6, 0.4, 0.2), Vector3(0.3, -0.2, 0.1 + height), twist);
  return world;
}

TEST(ContactRecords, ABounceSaysWhenWhereAndHowHard) {
  for (const double restitution : {0.5, 0.0}) {
    TestWorld world = blockOverFloor(0.0015, {Vector3(0.0, 0.0, -3.0), Vector3::Zero()});
    world.material() = {restitution, 0.0, false};
    world.step();
    ASSERT_EQ(world.records.size(), 1U);
    const ContactRecord& record = world.records[0];
    EXPECT_EQ(record.kind, restitution > 0.0 ? ContactKind::kBounce : ContactKind::kStick);
    EXPECT_EQ(record.a, 0);
    EXPECT_EQ(record.b, 1);
    EXPECT_NEAR(record.time, 0.0005, 1e-6);  // the tolerance is some of the way
    EXPECT_NEAR(norm(record.p_WC - Vector3(0.3, -0.2, 0.0)), 0.0, 1e-6);
    EXPECT_EQ(record.nhat_AB_W, Vector3(0.0, 0.0, -1.0));
    const Vector3 impulse(0.0, 0.0, -2.0 * 3.0 * (1.0 + restitution));
    EXPECT_NEAR(norm(record.impulse_B_W - impulse), 0.0, 1e-12);
  }
}

TEST(ContactRecords, ARestSaysWhereAndWithHowMuchItPresses) {
  TestWorld world = blockOverFloor(0.0, atRest(), Vector3(0.0, 0.0, -9.81));
  world.step();
  ASSERT_EQ(world.records.size(), 1U);
  const ContactRecord& record = world.records[0];
  EXPECT_EQ(record.kind, ContactKind::kRest);
  EXPECT_EQ(record.a, 0);
  EXPECT_EQ(record.b, 1);
  EXPECT_EQ(record.time, 0.0);
  EXPECT_NEAR(norm(record.p_WC - Vector3(0.3, -0.2, 0.0)), 0.0, 2e-5);
  EXPECT_EQ(record.nhat_AB_W, Vector3(0.0, 0.0, -1.0));
  const double weight = 2.0 * 9.81;  // N
  EXPECT_NEAR(norm(record.impulse_B_W - Vector3(0.0, 0.0, -weight * 0.001)), 0.0, 2e-6);
}

}  // namespace
}  // namespace hovercraft
