#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <hovercraft_sim/State.h>
#include <hovercraft_sim/States.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/analysis/compare.h"
#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/bags/trajectory_file.h"

#include "../support/files.h"
#include "../support/numbers.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Vector3;
using hovercraft::testing::kRounding;
using hovercraft::testing::messageOf;
using hovercraft::testing::TestFolder;

constexpr std::int64_t kEpochNs = 1700000000123456789;
constexpr std::int64_t kSampleStepNs = 2000000;

ros::Time stampOfTick(std::int64_t tick) {
  ros::Time stamp;
  stamp.fromNSec(static_cast<std::uint64_t>(kEpochNs + tick * kSampleStepNs));
  return stamp;
}

/// At (1, 2, 3), the bow to the left (yaw 90°).
geometry_msgs::Pose somePose() {
  geometry_msgs::Pose pose;
  pose.position.x = 1.0;
  pose.position.y = 2.0;
  pose.position.z = 3.0;
  pose.orientation.z = std::sqrt(0.5);
  pose.orientation.w = std::sqrt(0.5);
  return pose;
}

hovercraft_sim::State stateAt(std::int64_t tick) {
  hovercraft_sim::State state;
  state.header.stamp = stampOfTick(tick);
  state.tick = static_cast<std::uint64_t>(tick);
  state.pose = somePose();
  state.velocity.x = 4.0;
  state.angular_velocity.z = 5.0;
  return state;
}

/// Forward at 4 m/s, turning at 5 rad/s about the craft's x axis.
geometry_msgs::Twist someTwist() {
  geometry_msgs::Twist twist;
  twist.linear.x = 4.0;
  twist.angular.x = 5.0;
  return twist;
}

nav_msgs::Odometry odomAt(std::int64_t tick) {
  nav_msgs::Odometry odom;
  odom.header.stamp = stampOfTick(tick);
  odom.pose.pose = somePose();
  odom.twist.twist = someTwist();
  return odom;
}

geometry_msgs::PoseStamped poseAt(std::int64_t tick) {
  geometry_msgs::PoseStamped pose;
  pose.header.stamp = stampOfTick(tick);
  pose.pose = somePose();
  return pose;
}

geometry_msgs::TwistStamped twistAt(std::int64_t tick) {
  geometry_msgs::TwistStamped twist;
  twist.header.stamp = stampOfTick(tick);
  twist.twist = someTwist();
  return twist;
}

class TrajectoryFile : public ::testing::Test {
 protected:
  void write(const std::function<void(rosbag::Bag&)>& fill) const {
    rosbag::Bag bag(path_, rosbag::bagmode::Write);
    bag.write("/chatter", stampOfTick(0), std_msgs::String());
    fill(bag);
  }

  std::string errorOf() const {
    const std::string message = messageOf([&] { readTrajectories(path_); });
    return message.rfind(path_, 0) == 0 ? "run.bag" + message.substr(path_.size()) : message;
  }

  TestFolder folder_;
  std::string path_ = folder_.file("run.bag");
};

// A recorder that comes to a run that stands is given the state of that tick; then came a reset.
TEST_F(TrajectoryFile, AStateAloneOfTheEpisodeBeforeIsLeftOut) {
  write([](rosbag::Bag& bag) {
    bag.write("/craft/state", stampOfTick(3), stateAt(17));
    for (const std::int64_t tick : {5, 10, 20}) {
      auto state = stateAt(tick);
      state.episode = 1;
      bag.write("/craft/state", stampOfTick(tick), state);
    }
  });
  const auto samples = readTrajectories(path_).front().samples;
  ASSERT_EQ(samples.size(), 3U);
  EXPECT_EQ(samples.front().time_ns, 5 * kSampleStepNs);
  EXPECT_EQ(samples.back().time_ns, 20 * kSampleStepNs);
}

// Where the stamp of tick 0 would be 0, which ROS takes for no time.
TEST_F(TrajectoryFile, TickZeroMayHaveTheStampOfTickOne) {
  for (const std::vector<std::int64_t>& ticks :
       {std::vector<std::int64_t>{0, 10}, std::vector<std::int64_t>{0, 5, 10, 20}}) {
    write([&](rosbag::Bag& bag) {
      for (const std::int64_t tick : ticks) {
        auto state = stateAt(tick);
        state.header.stamp.fromNSec(
            static_cast<std::uint64_t>(std::max<std::int64_t>(tick, 1) * kSampleStepNs));
        bag.write("/craft/state", state.header.stamp, state);
      }
    });
    const auto samples = readTrajectories(path_).front().samples;
    ASSERT_EQ(samples.size(), ticks.size());
    for (std::size_t i = 0; i < ticks.size(); ++i) {
      EXPECT_EQ(samples[i].time_ns, ticks[i] * kSampleStepNs);
    }
  }
}

TEST_F(TrajectoryFile, PrefersStateAndCountsItsTimeFromTickZero) {
  write([](rosbag::Bag& bag) {
    for (const std::int64_t tick : {5, 10, 20}) {
      bag.write("/craft/odom", stampOfTick(tick), odomAt(tick));
      bag.write("/craft/state", stampOfTick(tick), stateAt(tick));
    }
  });
  const auto read = readTrajectories(path_);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].vehicle, "craft");
  EXPECT_EQ(read[0].source, path_ + ": /craft/state, centre of mass");
  EXPECT_FALSE(read[0].holds_time_zero);
  ASSERT_EQ(read[0].samples.size(), 3U);
  EXPECT_EQ(read[0].samples[0].time_ns, 5 * kSampleStepNs);
  EXPECT_EQ(read[0].samples[2].time_ns, 20 * kSampleStepNs);
  EXPECT_EQ(read[0].samples[0].p_WB, Vector3(1.0, 2.0, 3.0));
  EXPECT_EQ(read[0].samples[0].v_WB, Vector3(4.0, 0.0, 0.0));
  EXPECT_EQ(read[0].samples[0].w_WB, Vector3(0.0, 0.0, 5.0));
}

TEST_F(TrajectoryFile, TurnsTheTwistOfOdometryIntoWorldAxes) {
  write([](rosbag::Bag& bag) {
    bag.write("/craft/odom", stampOfTick(5), odomAt(5));
    bag.write("/craft/pose", stampOfTick(5), poseAt(5));
  });
  const auto read = readTrajectories(path_);
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].source, path_ + ": /craft/odom, base_link");
  EXPECT_EQ(read[0].samples[0].time_ns, kEpochNs + 5 * kSampleStepNs);
  EXPECT_LT((read[0].samples[0].v_WB - Vector3(0.0, 4.0, 0.0)).norm(), 4.0 * kRounding);
  EXPECT_LT((read[0].samples[0].w_WB - Vector3(0.0, 5.0, 0.0)).norm(), 5.0 * kRounding);
}

TEST_F(TrajectoryFile, TakesPoseWithTheTwistOfTheSameStamp) {
  write([](rosbag::Bag& bag) {
    for (const std::int64_t tick : {1, 2}) {
      bag.write("/craft/pose", stampOfTick(tick), poseAt(tick));
      bag.write("/craft/twist", stampOfTick(tick), twistAt(tick));
    }
  });
  const auto read = readTrajectories(path_);
  EXPECT_EQ(read[0].source, path_ + ": /craft/pose, base_link, with /craft/twist");
  EXPECT_TRUE(read[0].has_velocities);
  ASSERT_EQ(read[0].samples.size(), 2U);
  EXPECT_LT((read[0].samples[1].v_WB - Vector3(0.0, 4.0, 0.0)).norm(), 4.0 * kRounding);
}

TEST_F(TrajectoryFile, APoseWithoutItsTwistHasNoVelocities) {
  write([](rosbag::Bag& bag) {
    bag.write("/craft/twist", stampOfTick(1), twistAt(1));
    for (const std::int64_t tick : {1, 2}) {
      bag.write("/craft/pose", stampOfTick(tick), poseAt(tick));
    }
  });
  EXPECT_FALSE(readTrajectories(path_)[0].has_velocities);
}

TEST_F(TrajectoryFile, WhatHasNoStateCountsFromTickZeroOfThoseThatHaveOne) {
  const auto fill = [](rosbag::Bag& bag) {
    for (const std::int64_t tick : {5, 10, 20}) {
      bag.write("/craft/state", stampOfTick(tick), stateAt(tick));
      bag.write("/crate/pose", stampOfTick(tick), poseAt(tick));
      bag.write("/other/odom", stampOfTick(tick), odomAt(tick));
    }
  };
  write(fill);
  const auto read = readTrajectories(path_);
  ASSERT_EQ(read.size(), 3U);
  for (const auto& trajectory : read) {
    ASSERT_EQ(trajectory.samples.size(), 3U);
    EXPECT_EQ(trajectory.samples[0].time_ns, 5 * kSampleStepNs) << trajectory.vehicle;
    EXPECT_EQ(trajectory.samples[2].time_ns, 20 * kSampleStepNs) << trajectory.vehicle;
  }
  // Two runs with ticks of their own have no time in common but that of their stamps.
  write([&fill](rosbag::Bag& bag) {
    fill(bag);
    for (const std::int64_t tick : {5, 10}) {
      auto later = stateAt(tick);
      later.header.stamp += ros::Duration(1, 0);
      bag.write("/late/state", stampOfTick(tick), later);
    }
  });
  const auto of_two = readTrajectories(path_);
  ASSERT_EQ(of_two[1].vehicle, "crate");
  EXPECT_EQ(of_two[1].samples[0].time_ns, kEpochNs + 5 * kSampleStepNs);
}

/// A bag of `simulate` as if it had been recorded live: every stamp is later by one epoch.
void copyLater(const std::string& from, const std::string& to, std::int64_t epoch_ns) {
  const rosbag::Bag bag(from);
  rosbag::Bag later(to, rosbag::bagmode::Write);
  const auto shifted = [epoch_ns](const ros::Time& stamp) {
    return ros::Time().fromNSec(stamp.toNSec() + static_cast<std::uint64_t>(epoch_ns));
  };
  for (const rosbag::MessageInstance& instance : rosbag::View(bag)) {
    if (const auto state = instance.instantiate<hovercraft_sim::State>()) {
      state->header.stamp = shifted(state->header.stamp);
      later.write(instance.getTopic(), shifted(instance.getTime()), *state);
    } else if (const auto pose = instance.instantiate<geometry_msgs::PoseStamped>()) {
      pose->header.stamp = shifted(pose->header.stamp);
      later.write(instance.getTopic(), shifted(instance.getTime()), *pose);
    }
  }
}

TEST_F(TrajectoryFile, ALiveBagWithLooseBodiesIsComparedWithThatOfSimulate) {
  SimulateRequest request;
  request.scenario = "config/crates.yaml";
  request.duration = "2";
  request.every = 10;
  request.output = path_;
  std::ostringstream messages;
  simulate(request, messages);
  copyLater(path_, folder_.file("live.bag"), kEpochNs);
  const auto simulated = readTrajectories(path_);
  const auto live = readTrajectories(folder_.file("live.bag"));
  const auto pairs = hovercraft::pairByVehicle(simulated, live);
  ASSERT_EQ(pairs.size(), 3U);
  for (const auto& pair : pairs) {
    const auto comparison = hovercraft::compareTrajectories(*pair.a, *pair.b, {});
    EXPECT_TRUE(comparison.is_within) << pair.a->source << toText(comparison, {});
    EXPECT_EQ(comparison.errors.size(), 200U);
  }
}

TEST_F(TrajectoryFile, EachNamespaceIsATrajectory) {
  write([](rosbag::Bag& bag) {
    bag.write("/fleet/beta/odom", stampOfTick(1), odomAt(1));
    bag.write("/alpha/state", stampOfTick(1), stateAt(1));
    bag.write("/gamma/state", stampOfTick(1), poseAt(1));  // another type: no state
  });
  const auto read = readTrajectories(path_);
  ASSERT_EQ(read.size(), 2U);
  EXPECT_EQ(read[0].vehicle, "alpha");
  EXPECT_EQ(read[0].samples[0].time_ns,
            kEpochNs + kSampleStepNs);  // one state does not tell the step
  EXPECT_EQ(read[1].vehicle, "fleet/beta");
}

TEST_F(TrajectoryFile, ABagWithoutATrajectoryIsAnError) {
  write([](rosbag::Bag&) {});
  EXPECT_EQ(errorOf(),
            "run.bag: there is no trajectory in it: must have a topic that ends in /state, /odom "
            "or /pose, of its type, or one of hovercraft_sim/States");
}

TEST_F(TrajectoryFile, EveryBadMessageIsNamedByTopicTimeAndRule) {
  const auto check = [&](const std::function<void(rosbag::Bag&)>& fill, const std::string& error) {
    write(fill);
    EXPECT_EQ(errorOf(), "run.bag: " + error);
  };
  check(
      [](rosbag::Bag& bag) {
        auto state = stateAt(1);
        state.velocity.y = NAN;
        bag.write("/craft/state", stampOfTick(1), state);
      },
      "/craft/state at 1700000000.125456789: every number must be finite");
  check(
      [](rosbag::Bag& bag) {
        auto pose = poseAt(1);
        pose.pose.orientation = geometry_msgs::Quaternion();
        bag.write("/craft/pose", stampOfTick(1), pose);
      },
      "/craft/pose at 1700000000.125456789: the quaternion must not be 0");
  check(
      [](rosbag::Bag& bag) {
        bag.write("/craft/odom", stampOfTick(1), odomAt(1));
        bag.write("/craft/odom", stampOfTick(2), odomAt(1));
      },
      "/craft/odom at 1700000000.127456789: its time must be later than that of the message "
      "before it");
  check(
      [](rosbag::Bag& bag) {
        bag.write("/craft/state", stampOfTick(0), stateAt(0));
        bag.write("/craft/state", stampOfTick(1), stateAt(1));
        auto state = stateAt(2);
        state.episode = 1;
        bag.write("/craft/state", stampOfTick(2), state);
      },
      "/craft/state at 1700000000.127456789: episode 1: must be episode 0 as before; a trajectory "
      "has no reset");
  check(
      [](rosbag::Bag& bag) {
        bag.write("/craft/state", stampOfTick(1), stateAt(1));
        auto late = stateAt(2);
        late.header.stamp += ros::Duration(0, 1);
        bag.write("/craft/state", stampOfTick(2), late);
        bag.write("/craft/state", stampOfTick(3), stateAt(3));
      },
      "/craft/state: stamps must be a whole number of steps of one length from tick to tick");
}

/// The states of two craft in one message; b is a metre further on.
hovercraft_sim::States statesAt(std::int64_t tick) {
  hovercraft_sim::States states;
  states.header.stamp = stampOfTick(tick);
  states.names = {"a", "b"};
  states.states = {stateAt(tick), stateAt(tick)};
  states.states[1].pose.position.x += 1.0;
  return states;
}

TEST_F(TrajectoryFile, CraftOfAFleetHaveTheirStatesInOneTopic) {
  rosbag::Bag bag(path_, rosbag::bagmode::Write);
  for (const std::int64_t tick : {5, 15}) {
    bag.write("/hovercraft_sim/states", stampOfTick(tick), statesAt(tick));
  }
  bag.close();
  const auto trajectories = readTrajectories(path_);
  ASSERT_EQ(trajectories.size(), 2U);
  EXPECT_EQ(trajectories[1].vehicle, "b");
  EXPECT_EQ(trajectories[1].source, path_ + ": /hovercraft_sim/states, centre of mass");
  ASSERT_EQ(trajectories[1].samples.size(), 2U);
  EXPECT_EQ(trajectories[1].samples[1].p_WB.x(), 2.0);
  EXPECT_EQ(trajectories[1].samples[1].time_ns, 15 * kSampleStepNs);
}

TEST_F(TrajectoryFile, ATopicOfACraftsOwnComesBeforeThatOfTheFleet) {
  rosbag::Bag bag(path_, rosbag::bagmode::Write);
  for (const std::int64_t tick : {5, 15}) {
    bag.write("/hovercraft_sim/states", stampOfTick(tick), statesAt(tick));
    bag.write("/a/state", stampOfTick(tick), stateAt(tick));
  }
  bag.close();
  const auto trajectories = readTrajectories(path_);
  ASSERT_EQ(trajectories.size(), 2U);
  EXPECT_EQ(trajectories[0].source, path_ + ": /a/state, centre of mass");
}

TEST_F(TrajectoryFile, ACraftInTwoFleetsIsRefused) {
  rosbag::Bag bag(path_, rosbag::bagmode::Write);
  bag.write("/hovercraft_sim/states", stampOfTick(5), statesAt(5));
  bag.write("/other/states", stampOfTick(6), statesAt(6));
  bag.close();
  const std::string message = messageOf([this] { readTrajectories(path_); });
  EXPECT_NE(message.find("a is in /hovercraft_sim/states too: must be in one"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace hovercraft_ros
