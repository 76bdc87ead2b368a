#include <map>
#include <string>
#include <tf2_msgs/TFMessage.h>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/EngineStatus.h>
#include <hovercraft_sim/State.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/bags/bag_writer.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/run.h"

#include "../support/files.h"
#include "../support/scenarios.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Command;
using hovercraft::Vector3;
using hovercraft::testing::scenarioOf;
using hovercraft::testing::TestFolder;
using hovercraft::testing::twoCraftYaml;

/// A command for alpha at tick 0 and one for beta at tick 7.
class TwoCommands : public hovercraft::CommandSource {
 public:
  std::optional<Command> next() override {
    ++count_;
    if (count_ == 1) return Command{0, 0, hovercraft::kAllEngines, Vector3(1.0, 2.0, 3.0)};
    if (count_ == 2) return Command{7, 1, 5, Vector3(4.0, 0.0, 6.0)};
    return std::nullopt;
  }

 private:
  int count_ = 0;
};

class BagOfARun : public ::testing::Test {
 protected:
  void SetUp() override {
    hovercraft::Simulation simulation(scenario_);
    TwoCommands commands;
    BagWriter writer(folder_.file("run.bag"), scenario_);
    hovercraft::RunPlan plan;
    plan.last_tick = 20;
    plan.every = 5;
    hovercraft::run(simulation, commands, writer, plan);
    bag_.open(folder_.file("run.bag"), rosbag::bagmode::Read);
  }

  template <class Message>
  std::vector<Message> messagesOf(const std::string& topic) const {
    std::vector<Message> messages;
    rosbag::View view(bag_, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& instance : view) {
      messages.push_back(*instance.instantiate<Message>());
      received_[topic].push_back(instance.getTime());
    }
    return messages;
  }

  TestFolder folder_;
  hovercraft::Scenario scenario_ = scenarioOf(twoCraftYaml());
  rosbag::Bag bag_;
  mutable std::map<std::string, std::vector<ros::Time>> received_;
};

TEST_F(BagOfARun, HasTheTopicsOfTheNode) {
  rosbag::View view(bag_);
  std::map<std::string, std::string> types;
  for (const auto* connection : view.getConnections()) {
    types[connection->topic] = connection->datatype;
  }
  std::map<std::string, std::string> expected = {{"/tf", "tf2_msgs/TFMessage"},
                                                 {"/tf_static", "tf2_msgs/TFMessage"},
                                                 {"/hovercraft_sim/scenario", "std_msgs/String"}};
  for (const std::string craft : {"/alpha", "/beta"}) {
    expected[craft + "/pose"] = "geometry_msgs/PoseStamped";
    expected[craft + "/twist"] = "geometry_msgs/TwistStamped";
    expected[craft + "/odom"] = "nav_msgs/Odometry";
    expected[craft + "/engines"] = "hovercraft_sim/EngineStatus";
    expected[craft + "/state"] = "hovercraft_sim/State";
    expected[craft + "/wind"] = "hovercraft_sim/Wind";
    expected[craft + "/commands"] = "hovercraft_sim/AppliedCommand";
  }
  EXPECT_EQ(types, expected);
}

TEST_F(BagOfARun, StampsAreTicksTimesTheStepAndLeaveOutTimeZero) {
  const auto states = messagesOf<hovercraft_sim::State>("/beta/state");
  ASSERT_EQ(states.size(), 4U);
  for (std::size_t i = 0; i < states.size(); ++i) {
    EXPECT_EQ(states[i].tick, 5 * (i + 1));
    EXPECT_EQ(states[i].header.stamp.toNSec(), 50000000U * (i + 1));
    EXPECT_EQ(received_["/beta/state"][i], states[i].header.stamp);
    EXPECT_EQ(states[i].header.frame_id, "world");
  }
  const auto transforms = messagesOf<tf2_msgs::TFMessage>("/tf");
  ASSERT_EQ(transforms.size(), 4U);
  ASSERT_EQ(transforms[0].transforms.size(), 2U);
  EXPECT_EQ(transforms[0].transforms[1].child_frame_id, "beta/base_link");
}

TEST_F(BagOfARun, CommandsAreRecordedWhenTheyTakeEffectButNotBeforeTickOne) {
  const auto alpha = messagesOf<hovercraft_sim::AppliedCommand>("/alpha/commands");
  ASSERT_EQ(alpha.size(), 1U);
  EXPECT_EQ(alpha[0].tick, 0U);
  EXPECT_EQ(alpha[0].header.stamp.toNSec(), 10000000U);
  EXPECT_EQ(alpha[0].engines, 7);
  const auto beta = messagesOf<hovercraft_sim::AppliedCommand>("/beta/commands");
  ASSERT_EQ(beta.size(), 1U);
  EXPECT_EQ(beta[0].tick, 7U);
  EXPECT_EQ(beta[0].header.stamp.toNSec(), 70000000U);
  EXPECT_EQ(beta[0].engines, 5);
  EXPECT_EQ(beta[0].right, 6.0);
}

TEST_F(BagOfARun, ConstantsAreThereOnceAndLatched) {
  const auto scenarios = messagesOf<std_msgs::String>("/hovercraft_sim/scenario");
  ASSERT_EQ(scenarios.size(), 1U);
  EXPECT_EQ(scenarios[0].data, hovercraft::toYaml(scenario_));
  const auto frames = messagesOf<tf2_msgs::TFMessage>("/tf_static");
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].transforms.size(), 6U);
  rosbag::View view(bag_);
  int latched = 0;
  for (const auto* connection : view.getConnections()) {
    const auto latching = connection->header->find("latching");
    if (latching == connection->header->end() || latching->second != "1") continue;
    ++latched;
    EXPECT_TRUE(connection->topic == "/tf_static" ||
                connection->topic == "/hovercraft_sim/scenario")
        << connection->topic;
  }
  EXPECT_EQ(latched, 2);
}

TEST_F(BagOfARun, EnginesReportWhatActs) {
  const auto engines = messagesOf<hovercraft_sim::EngineStatus>("/beta/engines");
  ASSERT_EQ(engines.size(), 4U);
  EXPECT_EQ(engines[0].rear.applied, 0.0);
  EXPECT_EQ(engines[0].rear.age, -1.0);
  EXPECT_EQ(engines[1].rear.applied, 4.0);
  EXPECT_EQ(engines[1].left.age, -1.0);
  EXPECT_EQ(engines[1].right.applied, 6.0);
}

}  // namespace
}  // namespace hovercraft_ros
