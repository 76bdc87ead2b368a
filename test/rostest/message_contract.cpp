#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tf2_msgs/TFMessage.h>
#include <vector>

#include <gtest/gtest.h>

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <hovercraft_sim/EngineStatus.h>
#include <hovercraft_sim/State.h>
#include <nav_msgs/Odometry.h>

#include "hovercraft_sim/messages/conversions.h"

#include "../support/core_run.h"
#include "../support/pilot.h"
#include "../support/recorded_flight.h"

namespace hovercraft_ros::testing {
namespace {

using hovercraft::Matrix3;
using hovercraft::Vector3;

constexpr std::uint64_t kStepNs = 2000000;      // of message_contract.yaml
constexpr std::uint64_t kTicksPerMessage = 10;  // 500 Hz of steps, 50 Hz of messages
const Vector3 kCenterOfMass = {0.05, -0.03, 0.08};

// Roundings of a few operations on numbers below 4.
constexpr double kTolerance = 1e-14;

/// Everything about one craft at one stamp.
struct Moment {
  geometry_msgs::PoseStamped pose;
  geometry_msgs::TwistStamped twist;
  nav_msgs::Odometry odom;
  geometry_msgs::TransformStamped transform;
  hovercraft_sim::EngineStatus engines;
  hovercraft_sim::State state;
};

/// One flight for all tests below; the bag is read by each.
class MessageContract : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    Pilot pilot("tumbler");
    flight = std::make_unique<RecordedFlight>(outputTopics({"tumbler"}));
    pilot.flyFor(500, {3.0, 0.5, 1.0});
    flown = std::make_unique<const Recording>(flight->finish());
  }
  static void TearDownTestSuite() {
    flown.reset();
    flight.reset();
  }

  void SetUp() override { ASSERT_NE(flown, nullptr) << "the flight failed"; }

  static const Recording& recording() { return *flown; }

  template <class Message>
  static std::vector<Message> messages(const std::string& name) {
    return flown->messages<Message>("/tumbler/" + name);
  }

  static std::vector<geometry_msgs::TransformStamped> transforms() {
    std::vector<geometry_msgs::TransformStamped> result;
    for (const auto& message : flown->messages<tf2_msgs::TFMessage>("/tf")) {
      result.insert(result.end(), message.transforms.begin(), message.transforms.end());
    }
    return result;
  }

  template <class Message>
  static void expectStampsOnTheGrid(const std::vector<Message>& messages,
                                    const std::string& topic) {
    SCOPED_TRACE(topic);
    ASSERT_GE(messages.size(), 20U);
    const std::uint64_t epoch = epochNs();
    for (std::size_t i = 0; i < messages.size(); ++i) {
      const std::uint64_t since = messages[i].header.stamp.toNSec() - epoch;
      ASSERT_EQ(since % (kStepNs * kTicksPerMessage), 0U) << "message " << i;
      ASSERT_GT(since, 0U);
      if (i == 0) continue;
      ASSERT_EQ((messages[i].header.stamp - messages[i - 1].header.stamp).toNSec(),
                static_cast<std::int64_t>(kStepNs * kTicksPerMessage))
          << "message " << i;
    }
  }

  static std::uint64_t epochNs() {
    const auto states = messages<hovercraft_sim::State>("state");
    return states.at(0).header.stamp.toNSec() - states[0].tick * kStepNs;
  }

  /// The moments of which every topic tells.
  static std::vector<Moment> moments() {
    std::map<ros::Time, Moment> all;
    std::map<ros::Time, int> parts;
    const auto collect = [&](const auto& messages, auto Moment::*part) {
      for (const auto& message : messages) {
        all[message.header.stamp].*part = message;
        ++parts[message.header.stamp];
      }
    };
    collect(messages<geometry_msgs::PoseStamped>("pose"), &Moment::pose);
    collect(messages<geometry_msgs::TwistStamped>("twist"), &Moment::twist);
    collect(messages<nav_msgs::Odometry>("odom"), &Moment::odom);
    collect(transforms(), &Moment::transform);
    collect(messages<hovercraft_sim::EngineStatus>("engines"), &Moment::engines);
    collect(messages<hovercraft_sim::State>("state"), &Moment::state);
    std::vector<Moment> result;
    for (const auto& [stamp, moment] : all) {
      if (parts[stamp] == 6) result.push_back(moment);
    }
    return result;
  }

 private:
  static std::unique_ptr<RecordedFlight> flight;
  static std::unique_ptr<const Recording> flown;
};
std::unique_ptr<RecordedFlight> MessageContract::flight;
std::unique_ptr<const Recording> MessageContract::flown;

void expectNear(const Vector3& a, const Vector3& b) {
  for (int i = 0; i < 3; ++i) ASSERT_NEAR(a[i], b[i], kTolerance) << "component " << i;
}

TEST_F(MessageContract, StampsIncreaseByOnePeriodOnTheGridOfTicks) {
  expectStampsOnTheGrid(messages<geometry_msgs::PoseStamped>("pose"), "pose");
  expectStampsOnTheGrid(messages<geometry_msgs::TwistStamped>("twist"), "twist");
  expectStampsOnTheGrid(messages<nav_msgs::Odometry>("odom"), "odom");
  expectStampsOnTheGrid(messages<hovercraft_sim::EngineStatus>("engines"), "engines");
  expectStampsOnTheGrid(messages<hovercraft_sim::State>("state"), "state");
  expectStampsOnTheGrid(transforms(), "tf");  // so none is sent twice
  const std::uint64_t epoch = epochNs();
  for (const auto& state : messages<hovercraft_sim::State>("state")) {
    ASSERT_EQ(state.header.stamp.toNSec(), epoch + state.tick * kStepNs);
  }
}

TEST_F(MessageContract, EveryTopicTellsOfEveryMoment) {
  const std::vector<Moment> all = moments();
  ASSERT_GE(all.size(), 20U);
  for (std::size_t i = 1; i < all.size(); ++i) {
    ASSERT_EQ(all[i].state.tick, all[i - 1].state.tick + kTicksPerMessage);
  }
}

TEST_F(MessageContract, FramesAreNamedAsPromised) {
  for (const Moment& moment : moments()) {
    ASSERT_EQ(moment.pose.header.frame_id, "map");
    ASSERT_EQ(moment.twist.header.frame_id, "tumbler/base_link");
    ASSERT_EQ(moment.odom.header.frame_id, "map");
    ASSERT_EQ(moment.odom.child_frame_id, "tumbler/base_link");
    ASSERT_EQ(moment.transform.header.frame_id, "map");
    ASSERT_EQ(moment.transform.child_frame_id, "tumbler/base_link");
    ASSERT_EQ(moment.engines.header.frame_id, "tumbler/base_link");
    ASSERT_EQ(moment.state.header.frame_id, "map");
  }
}

TEST_F(MessageContract, PoseOdomAndTfAreOnePose) {
  for (const Moment& moment : moments()) {
    const auto& pose = moment.pose.pose;
    ASSERT_EQ(moment.odom.pose.pose, pose);
    ASSERT_EQ(fromMessage(moment.transform.transform.translation), fromMessage(pose.position));
    ASSERT_EQ(moment.transform.transform.rotation, pose.orientation);
  }
}

TEST_F(MessageContract, ThePoseIsThatOfBaseLinkAndTheStateThatOfTheCentreOfMass) {
  for (const Moment& moment : moments()) {
    if (HasFatalFailure()) return;
    ASSERT_EQ(moment.pose.pose.orientation, moment.state.pose.orientation);
    const Matrix3 R_WH = hovercraft::rotationMatrix(fromMessage(moment.pose.pose.orientation));
    expectNear(fromMessage(moment.pose.pose.position) + hovercraft::times(R_WH, kCenterOfMass),
               fromMessage(moment.state.pose.position));
  }
}

TEST_F(MessageContract, TwistAndOdomGiveTheVelocityOfBaseLinkInItsOwnAxes) {
  for (const Moment& moment : moments()) {
    if (HasFatalFailure()) return;
    ASSERT_EQ(moment.odom.twist.twist, moment.twist.twist);
    const Matrix3 R_WH = hovercraft::rotationMatrix(fromMessage(moment.pose.pose.orientation));
    const Vector3 w_WB = fromMessage(moment.state.angular_velocity);
    const Vector3 from_center = hovercraft::times(R_WH, Vector3(-kCenterOfMass));
    expectNear(hovercraft::times(R_WH, fromMessage(moment.twist.twist.linear)),
               fromMessage(moment.state.velocity) + hovercraft::cross(w_WB, from_center));
    expectNear(hovercraft::times(R_WH, fromMessage(moment.twist.twist.angular)), w_WB);
  }
}

TEST_F(MessageContract, EachEngineHasAStaticFrameWhoseXAxisIsItsThrust) {
  const auto batches = recording().messages<tf2_msgs::TFMessage>("/tf_static");
  ASSERT_EQ(batches.size(), 1U);
  const auto& frames = batches[0].transforms;
  ASSERT_EQ(frames.size(), 3U);
  const std::vector<std::string> names = {"tumbler/engine_rear", "tumbler/engine_left",
                                          "tumbler/engine_right"};
  const std::vector<Vector3> positions = {{-0.25, 0, 0.05}, {0.2, 0.15, 0.05}, {0.2, -0.15, 0.05}};
  const std::vector<Vector3> directions = {{1, 0, 0}, {0, -1, 0}, {-1, 0, 0}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    const geometry_msgs::TransformStamped& frame = frames[i];
    EXPECT_EQ(frame.header.frame_id, "tumbler/base_link");
    EXPECT_EQ(frame.child_frame_id, names[i]);
    EXPECT_EQ(fromMessage(frame.transform.translation), positions[i]);
    const Matrix3 R_HE = hovercraft::rotationMatrix(fromMessage(frame.transform.rotation));
    expectNear(hovercraft::times(R_HE, Vector3::UnitX()), directions[i]);
  }
}

TEST_F(MessageContract, TheSpatialFlightIsThatOfTheCore) {
  expectEqualsCoreRun(recording());
}

}  // namespace
}  // namespace hovercraft_ros::testing
