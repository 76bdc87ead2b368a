#include <cmath>
#include <limits>
#include <map>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/NavSatFix.h>
#include <set>
#include <sstream>
#include <string>
#include <tf2_msgs/TFMessage.h>
#include <vector>

#include <gtest/gtest.h>

#include <geometry_msgs/TwistWithCovarianceStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "hovercraft_sim/bags/replay.h"
#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/messages/sensor_messages.h"

#include "../support/files.h"
#include "../support/sensor_scenario.h"

namespace hovercraft_ros {
namespace {

using hovercraft::testing::TestFolder;

constexpr const char* kCraft = "/hovercraft/";

class SensorBag : public ::testing::Test {
 protected:
  SimulateRequest request(const std::string& output) const {
    SimulateRequest request;
    request.scenario = "config/senses.yaml";
    request.duration = "2";
    request.every = 10;
    request.output = folder_.file(output);
    return request;
  }
  std::string run(const SimulateRequest& asked) const {
    std::ostringstream messages;
    simulate(asked, messages);
    return asked.output;
  }

  template <class Message>
  static std::vector<std::pair<ros::Time, Message>> read(const std::string& path,
                                                         const std::string& topic) {
    rosbag::Bag bag(path, rosbag::bagmode::Read);
    rosbag::View view(bag, rosbag::TopicQuery(topic));
    std::vector<std::pair<ros::Time, Message>> messages;
    for (const rosbag::MessageInstance& instance : view) {
      messages.emplace_back(instance.getTime(), *instance.instantiate<Message>());
    }
    return messages;
  }

  /// A copy of the bag with every message that `change` returns false for left out.
  template <class Message, class Change>
  std::string changed(const std::string& path, const std::string& topic,
                      const Change& change) const {
    const std::string copy = folder_.file("changed.bag");
    rosbag::Bag in(path, rosbag::bagmode::Read);
    rosbag::Bag out(copy, rosbag::bagmode::Write);
    rosbag::View view(in);
    std::size_t index = 0;
    for (const rosbag::MessageInstance& instance : view) {
      if (instance.getTopic() != topic) {
        out.write(instance.getTopic(), instance.getTime(), instance);
        continue;
      }
      Message message = *instance.instantiate<Message>();
      if (change(index++, message)) out.write(topic, instance.getTime(), message);
    }
    return copy;
  }

  static std::pair<int, std::string> replayed(const std::string& path) {
    std::string verdict;
    const int status = replayBag({path, "", {}}, verdict);
    return {status, verdict};
  }

  TestFolder folder_;
};

TEST_F(SensorBag, HasTheSamplesAlsoBesideTheOtherFiles) {
  SimulateRequest asked = request("hover.bag");
  asked.scenario = "config/rc5.yaml";
  asked.sets = {"vehicles.rc5.sensors={imu: {kind: imu, rate: 100}}"};
  asked.contacts = folder_.file("contacts.csv");
  asked.cushion = folder_.file("cells.csv");
  asked.sensors = folder_.file("samples");
  EXPECT_EQ(read<sensor_msgs::Imu>(run(asked), "/rc5/imu/data").size(), 200U);
}

TEST_F(SensorBag, HoldsEachSampleAtTheTimeOfItsDelivery) {
  const std::string bag = run(request("run.bag"));
  const auto imus = read<sensor_msgs::Imu>(bag, std::string(kCraft) + "imu/data");
  ASSERT_EQ(imus.size(), 399U);  // 2 s at 200 Hz, the last one still on its way
  for (std::size_t i = 0; i < imus.size(); ++i) {
    EXPECT_EQ(imus[i].second.header.stamp.toNSec(), (i + 1) * 5000000U);
    EXPECT_EQ((imus[i].first - imus[i].second.header.stamp).toNSec(), 2000000);
  }
  const auto fixes = read<sensor_msgs::NavSatFix>(bag, std::string(kCraft) + "fix");
  ASSERT_EQ(fixes.size(), 9U);
  EXPECT_EQ((fixes[0].first - fixes[0].second.header.stamp).toNSec(), 100000000);
  EXPECT_EQ(
      read<geometry_msgs::TwistWithCovarianceStamped>(bag, std::string(kCraft) + "fix_velocity")
          .size(),
      9U);
  EXPECT_EQ(read<sensor_msgs::LaserScan>(bag, std::string(kCraft) + "scan").size(), 19U);
}

// As the node does with the parameter truth_odom.
TEST_F(SensorBag, HasTheTruthOnAnotherTopicAndTheNoisyOdometryOnOdom) {
  SimulateRequest asked = request("run.bag");
  asked.truth_odom = "truth/odom";
  const std::string bag = run(asked);
  const auto truth = read<nav_msgs::Odometry>(bag, std::string(kCraft) + "truth/odom");
  const auto noisy = read<nav_msgs::Odometry>(bag, std::string(kCraft) + "odom");
  ASSERT_EQ(truth.size(), 200U);
  ASSERT_EQ(noisy.size(), 100U);
  EXPECT_EQ(truth.back().second.header.frame_id, "world");
  EXPECT_EQ(noisy.back().second.header.frame_id, "hovercraft/odom");
  EXPECT_TRUE(read<nav_msgs::Odometry>(bag, std::string(kCraft) + "odometry").empty());
  const auto [status, verdict] = replayed(bag);
  EXPECT_EQ(status, 0) << verdict;
  // 399 of the IMU, 2 x 9 fixes, 100 of odometry, 100 of the compass, 19 scans.
  EXPECT_NE(verdict.find("and 636 messages of sensors"), std::string::npos) << verdict;
}

TEST_F(SensorBag, RefusesATopicOfTheTruthThatIsNoneOfTheCraft) {
  for (const char* topic : {"", "/odom", "truth odom", "truth//odom", "odom/", "odometry",
                            "imu/data", "second/odometry", "state"}) {
    SimulateRequest asked = request("run.bag");
    asked.truth_odom = topic;
    EXPECT_EQ(
        hovercraft::testing::messageOf([&] { run(asked); }),
        "--truth-odom = " + std::string(topic) +
            ": must be a topic below the craft's namespace, such as truth/odom, and not that of "
            "something else");
  }
  SimulateRequest asked = request("run.csv");
  asked.truth_odom = "truth/odom";
  EXPECT_EQ(hovercraft::testing::messageOf([&] { run(asked); }),
            "--truth-odom: has a meaning with an --output that is a bag only");
}

// /hovercraft/hovercraft/imu/data ends as /hovercraft/imu/data does: it is of the sensor
// "hovercraft".
TEST_F(SensorBag, TellsASensorOfTheCraftsNameFromTheFirstOne) {
  SimulateRequest asked = request("run.bag");
  asked.scenario = "config/hovercraft.yaml";
  asked.sets = {
      "vehicles.hovercraft.sensors={aft: {kind: imu, rate: 100, gyroscope_noise_density: 1e-3}, "
      "hovercraft: {kind: imu, rate: 100, gyroscope_noise_density: 1e-3}}"};
  const std::string bag = run(asked);
  EXPECT_EQ(read<sensor_msgs::Imu>(bag, std::string(kCraft) + "hovercraft/imu/data").size(), 200U);
  const auto [status, verdict] = replayed(bag);
  EXPECT_EQ(status, 0) << verdict;
  EXPECT_NE(verdict.find("and 400 messages of sensors"), std::string::npos) << verdict;
}

TEST_F(SensorBag, HasOneParentOfEachFrame) {
  const std::string bag = run(request("run.bag"));
  std::map<std::string, std::set<std::string>> parents;
  for (const char* topic : {"/tf", "/tf_static"}) {
    for (const auto& [time, message] : read<tf2_msgs::TFMessage>(bag, topic)) {
      for (const auto& transform : message.transforms) {
        parents[transform.child_frame_id].insert(transform.header.frame_id);
      }
    }
  }
  EXPECT_EQ(parents["hovercraft/base_link"], std::set<std::string>{"hovercraft/odom"});
  EXPECT_EQ(parents["hovercraft/lidar"], std::set<std::string>{"hovercraft/base_link"});
  EXPECT_EQ(parents.size(), 8U);  // base_link, three engines, four sensors
}

TEST_F(SensorBag, ReplaysBitForBit) {
  const auto [status, verdict] = replayed(run(request("run.bag")));
  EXPECT_EQ(status, 0);
  // 399 + 9 + 9 + 100 + 100 + 19
  EXPECT_NE(verdict.find("identical: 2000 ticks, 200 states and 636 messages of sensors compared"),
            std::string::npos)
      << verdict;
}

TEST_F(SensorBag, AChangedBitOfASampleIsFound) {
  const std::string bag = run(request("run.bag"));
  const auto [status, verdict] = replayed(changed<sensor_msgs::LaserScan>(
      bag, std::string(kCraft) + "scan", [](std::size_t index, sensor_msgs::LaserScan& scan) {
        if (index == 5) scan.ranges[17] = std::nextafter(scan.ranges[17], 100.0F);
        return true;
      }));
  EXPECT_EQ(status, 1);
  EXPECT_NE(verdict.find("hovercraft: scan = "), std::string::npos) << verdict;
  EXPECT_NE(verdict.find("different: episode 0, tick "), std::string::npos) << verdict;
}

TEST_F(SensorBag, ASampleThatTheRunDoesNotMakeIsFound) {
  const std::string bag = run(request("run.bag"));
  const auto [status, verdict] = replayed(changed<sensor_msgs::Imu>(
      bag, std::string(kCraft) + "imu/data", [](std::size_t index, sensor_msgs::Imu& imu) {
        if (index == 100) imu.header.stamp.fromNSec(imu.header.stamp.toNSec() + 1000000U);
        return true;
      }));
  EXPECT_EQ(status, 1);
  EXPECT_NE(verdict.find("different: episode 0, tick 506, hovercraft: imu/data"), std::string::npos)
      << verdict;
  EXPECT_NE(verdict.find("nothing replayed"), std::string::npos) << verdict;
}

TEST_F(SensorBag, ALostSampleIsOneLessToCompare) {
  const std::string bag = run(request("run.bag"));
  const auto [status, verdict] = replayed(changed<sensor_msgs::Imu>(
      bag, std::string(kCraft) + "imu/data",
      [](std::size_t index, sensor_msgs::Imu& /*imu*/) { return index != 100; }));
  EXPECT_EQ(status, 0) << verdict;
  EXPECT_NE(verdict.find("635 messages of sensors"), std::string::npos) << verdict;
}

TEST_F(SensorBag, TheCsvFilesHoldTheSameNumbers) {
  SimulateRequest asked = request("run.bag");
  asked.sensors = folder_.file("made/samples");
  const std::string bag = run(asked);
  std::istringstream rows(
      hovercraft::testing::contentOf(folder_.file("made/samples/hovercraft.imu.csv")));
  std::string row;
  std::getline(rows, row);
  EXPECT_EQ(row, "time,delivered,wx,wy,wz,ax,ay,az");
  const auto imus = read<sensor_msgs::Imu>(bag, std::string(kCraft) + "imu/data");
  std::size_t count = 0;
  for (; std::getline(rows, row); ++count) {
    std::vector<double> numbers;
    std::istringstream fields(row);
    for (std::string field; std::getline(fields, field, ',');) numbers.push_back(std::stod(field));
    ASSERT_EQ(numbers.size(), 8U);
    EXPECT_EQ(numbers[4], imus[count].second.angular_velocity.z);
    EXPECT_EQ(numbers[5], imus[count].second.linear_acceleration.x);
  }
  EXPECT_EQ(count, imus.size());
  for (const char* name : {"gps", "odometry", "compass", "lidar"}) {
    const std::string path = folder_.file(std::string("made/samples/hovercraft.") + name + ".csv");
    EXPECT_GT(hovercraft::testing::contentOf(path).size(), 100U) << name;
  }
}

TEST_F(SensorBag, BadFoldersAreRefused) {
  const auto complaint = [&](const std::string& scenario, const std::string& sensors) {
    SimulateRequest asked = request("run.csv");
    asked.scenario = scenario;
    asked.sensors = sensors;
    return hovercraft::testing::messageOf([&] { run(asked); });
  };
  const std::string file = folder_.write("file", "x");
  EXPECT_EQ(complaint("config/senses.yaml", file),
            "--sensors = " + file + ": must be a folder, or a name where one can be made");
  EXPECT_EQ(complaint("config/hovercraft.yaml", folder_.file("samples")),
            "--sensors = " + folder_.file("samples") + ": no vehicle of the scenario has any");
}

TEST(SensorMessages, ASecondSensorOfAKindHasItsNameInTheTopic) {
  const hovercraft::Scenario scenario =
      hovercraft::testing::scenarioOf(hovercraft::testing::sensedCraftYaml(
          "    sensors: {a: {kind: imu, rate: 100}, b: {kind: imu, rate: 100}, g: {kind: gnss, "
          "rate: "
          "1, latitude_deg: 0, longitude_deg: 0}, h: {kind: gnss, rate: 1, latitude_deg: 0, "
          "longitude_deg: 0}}\n"));
  const SensorMessages messages(scenario, 0, TfFrames{"world", "left"});
  EXPECT_EQ(messages.messages()[0].topic, "imu/data");
  EXPECT_EQ(messages.messages()[1].topic, "b/imu/data");
  EXPECT_EQ(messages.messages()[2].velocity_topic, "fix_velocity");
  EXPECT_EQ(messages.messages()[3].velocity_topic, "h/fix_velocity");
  const auto frames = messages.sensorFrames(ros::Time(1));
  EXPECT_EQ(frames[1].child_frame_id, "left/craft/b");
  EXPECT_EQ(frames[1].header.frame_id, "left/craft/base_link");
}

TEST(SensorMessages, RangesAreThoseOfRep117) {
  const hovercraft::Scenario scenario =
      hovercraft::testing::scenarioOf(hovercraft::testing::sensedCraftYaml(
          "    sensors: {laser: {kind: laser, rate: 100, angle_min: 0, angle_max: 1, beams: 4, "
          "range_min: 0.5, range_max: 10}}\n"));
  SensorMessages messages(scenario, 0, TfFrames());
  const std::vector<double> ranges = {0.4, 0.5, -1.0, 10.5};
  const auto& scan = std::get<sensor_msgs::LaserScan>(
      messages.fill({0, 0, 10, 10, ranges.data(), ranges.size()}, ros::Time(1)).message);
  const float infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(scan.ranges, (std::vector<float>{-infinity, 0.5F, infinity, infinity}));
  EXPECT_FLOAT_EQ(scan.angle_increment, 1.0F / 3.0F);
}

}  // namespace
}  // namespace hovercraft_ros
