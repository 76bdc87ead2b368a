#include <gtest/gtest.h>

#include "hovercraft_sim/collision/broad_phase.h"

#include "random_bodies.h"

namespace hovercraft {
namespace {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

AxisAlignedBox randomBox(RandomBodies& random, const Vector3& world) {
  const Vector3 middle =
      Vector3(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)).cwiseProduct(world);
  const Vector3 half(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
  return {middle - half, middle + half};
}

Pairs allPairs(const std::vector<AxisAlignedBox>& boxes) {
  Pairs pairs;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t k = i + 1; k < boxes.size(); ++k) {
      if (boxes[i].overlaps(boxes[k])) {
        pairs.emplace_back(static_cast<std::int32_t>(i), static_cast<std::int32_t>(k));
      }
    }
  }
  return pairs;
}

TEST(BroadPhase, FindsExactlyThePairsThatOverlapWhileBoxesMove) {
  RandomBodies random(31);
  for (const Vector3& world : {Vector3(30, 3, 3), Vector3(3, 30, 3), Vector3(5, 5, 5)}) {
    BroadPhase broad_phase;
    std::vector<AxisAlignedBox> boxes;
    for (int i = 0; i < 120; ++i) {
      boxes.push_back(randomBox(random, world));
      EXPECT_EQ(broad_phase.add(boxes.back()), i);
    }
    for (int step = 0; step < 30; ++step) {
      EXPECT_EQ(broad_phase.pairs(), allPairs(boxes)) << "step " << step;
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const Vector3 move = 0.3 * random.unitVector();
        boxes[i] = step % 10 == 9 ? randomBox(random, Vector3(world.z(), world.x(), world.y()))
                                  : AxisAlignedBox{boxes[i].low + move, boxes[i].high + move};
        broad_phase.update(static_cast<int>(i), boxes[i]);
      }
    }
    EXPECT_FALSE(broad_phase.pairs().empty());
  }
}

// What the boxes have been before does not show in the list.
TEST(BroadPhase, OrderDoesNotDependOnTheHistory) {
  RandomBodies random(32);
  std::vector<AxisAlignedBox> boxes;
  BroadPhase moved;
  for (int i = 0; i < 60; ++i) {
    boxes.push_back(randomBox(random, Vector3(6, 4, 2)));
    moved.add(randomBox(random, Vector3(2, 4, 6)));
  }
  moved.pairs();
  BroadPhase fresh;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    moved.update(static_cast<int>(i), boxes[i]);
    fresh.add(boxes[i]);
  }
  EXPECT_EQ(moved.pairs(), fresh.pairs());
}

TEST(BroadPhase, EmptyHasNoPairsAndUnknownBoxesAreABug) {
  BroadPhase broad_phase;
  EXPECT_TRUE(broad_phase.pairs().empty());
  EXPECT_THROW(broad_phase.update(0, AxisAlignedBox()), std::logic_error);
}

}  // namespace
}  // namespace hovercraft
