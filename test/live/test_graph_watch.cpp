#include <map>
#include <string>

#include <gtest/gtest.h>

#include "hovercraft_sim/live/graph_watch.h"

namespace hovercraft_ros {
namespace {

Claims claimsOf(bool clock) {
  return {{"/red/hovercraft/pose", "/red/hovercraft/state"},
          {"hovercraft/base_link", "hovercraft/engine_rear"},
          clock};
}

tf2_msgs::TFMessage transformOf(const std::string& parent, const std::string& child) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(2);
  message.transforms[0].child_frame_id = "camera";
  message.transforms[1].header.frame_id = parent;
  message.transforms[1].child_frame_id = child;
  return message;
}

TEST(GraphWatch, NobodyIsInConflictWithItselfOrOverOtherTopics) {
  const PublishersByTopic publishers = {{"/red/hovercraft/pose", {"/red/sim"}},
                                        {"/blue/hovercraft/pose", {"/blue/sim"}},
                                        {"/red/hovercraft/thrust", {"/pilot"}},
                                        {"/clock", {"/gazebo"}}};
  EXPECT_TRUE(conflictsOf(claimsOf(false), publishers, "/red/sim").empty());
}

TEST(GraphWatch, ASecondPublisherOfATopicOfACraftIsNamedWithTheTopic) {
  const PublishersByTopic publishers = {{"/red/hovercraft/state", {"/red/other", "/red/sim"}}};
  const auto conflicts = conflictsOf(claimsOf(false), publishers, "/red/sim");
  ASSERT_EQ(conflicts.size(), 1U);
  EXPECT_EQ(conflicts.begin()->first, "/red/other");
  EXPECT_EQ(conflicts.begin()->second.rfind("publishes /red/hovercraft/state as well", 0), 0U);
}

TEST(GraphWatch, ASecondClockMattersToWhoPublishesOne) {
  const PublishersByTopic publishers = {{"/clock", {"/gazebo", "/red/sim"}}};
  const auto conflicts = conflictsOf(claimsOf(true), publishers, "/red/sim");
  ASSERT_EQ(conflicts.size(), 1U);
  EXPECT_EQ(conflicts.begin()->first, "/gazebo");
  EXPECT_EQ(conflicts.begin()->second.rfind("publishes /clock as well", 0), 0U);
}

TEST(GraphWatch, AFrameOfThisCraftIsFoundAmongOthersWithOrWithoutASlash) {
  const Claims claims = claimsOf(false);
  const std::string rear = "hovercraft/engine_rear";
  EXPECT_EQ(claimedFrame(claims, transformOf("hovercraft/base_link", rear)), rear);
  EXPECT_EQ(claimedFrame(claims, transformOf("x", "/" + rear)), rear);
  // A child of a frame of this craft, such as a camera on it, takes nothing from it.
  EXPECT_EQ(claimedFrame(claims, transformOf("hovercraft/base_link", "lidar")), "");
  EXPECT_EQ(claimedFrame(claims, transformOf("blue/hovercraft/base_link", "blue/" + rear)), "");
}

}  // namespace
}  // namespace hovercraft_ros
