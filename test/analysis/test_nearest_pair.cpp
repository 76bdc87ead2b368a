#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "hovercraft_sim/analysis/nearest_pair.h"

#include "../support/scenarios.h"

namespace hovercraft {
namespace {

/// Two craft that are cubes of 1 m, and a wall whose face is at x = 10.
std::string cubesAndWall() {
  const std::string cube = "    hull: {box: {size: [1, 1, 1]}}\n";
  return "step_size: 0.01\nmodel: planar\nvehicles:\n" + testing::craftYaml("alpha") + cube +
         testing::craftYaml("beta") + cube +
         "    initial: {position: [3, 0, 0]}\n"
         "world:\n  obstacles:\n    wall: {box: {size: [1, 20, 4]}, position: [10.5, 0, 0]}\n";
}

Pose at(double x, double y) {
  Pose pose;
  pose.p_AB = {x, y, 0.0};
  return pose;
}

TEST(NearestPair, IsThatOfTheLeastDistance) {
  NearestPairFinder finder(testing::scenarioOf(cubesAndWall()));
  EXPECT_EQ(finder.moving(), (std::vector<std::string>{"alpha", "beta"}));
  const auto apart = finder.find({at(0.0, 0.0), at(3.0, 0.0)});
  ASSERT_TRUE(apart);
  EXPECT_EQ(apart->a, "alpha");
  EXPECT_EQ(apart->b, "beta");
  EXPECT_NEAR(apart->distance, 2.0, 1e-12);
  EXPECT_NEAR(apart->p_WCa.x(), 0.5, 1e-12);
  EXPECT_NEAR(apart->p_WCb.x(), 2.5, 1e-12);
  const auto wall = finder.find({at(0.0, 0.0), at(9.0, 3.0)});
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->a, "beta");
  EXPECT_EQ(wall->b, "wall");
  EXPECT_NEAR(wall->distance, 0.5, 1e-12);
  EXPECT_NEAR(wall->p_WCb.x(), 10.0, 1e-12);
}

TEST(NearestPair, ClearanceIsThatOfOneBodyToThoseThatAreNamed) {
  NearestPairFinder finder(testing::scenarioOf(cubesAndWall()));
  const std::vector<std::optional<Pose>> poses = {at(0.0, 0.0), at(3.0, 0.0)};
  EXPECT_NEAR(*finder.clearance(0, {}, poses), 2.0, 1e-12);
  EXPECT_NEAR(*finder.clearance(0, {"wall"}, poses), 9.5, 1e-12);
  EXPECT_NEAR(*finder.clearance(1, {}, poses), 2.0, 1e-12);
  EXPECT_NEAR(*finder.clearance(1, {"wall"}, poses), 6.5, 1e-12);
  EXPECT_FALSE(finder.clearance(0, {"alpha"}, poses));
  EXPECT_FALSE(finder.clearance(2, {}, poses));
}

TEST(NearestPair, LeavesOutWhatIsNotKnown) {
  NearestPairFinder finder(testing::scenarioOf(cubesAndWall()));
  const auto pair = finder.find({std::nullopt, at(3.0, 0.0)});
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->b, "wall");
  EXPECT_FALSE(finder.find({std::nullopt, std::nullopt}));
  EXPECT_FALSE(finder.find({}));
}

TEST(NearestPair, OfAScenarioWithoutAWorldThereIsNone) {
  NearestPairFinder finder(testing::scenarioOf(testing::twoCraftYaml()));
  EXPECT_TRUE(finder.moving().empty());
  EXPECT_FALSE(finder.find({at(0.0, 0.0), at(0.1, 0.0)}));
}

}  // namespace
}  // namespace hovercraft
