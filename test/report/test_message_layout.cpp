#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <geometry_msgs/PoseStamped.h>
#include <hovercraft_sim/EngineStatus.h>
#include <hovercraft_sim/State.h>
#include <nav_msgs/Odometry.h>
#include <ros/serialization.h>

#include "hovercraft_sim/report/message_layout.h"

#include "../support/files.h"

namespace hovercraft_ros {
namespace {

using hovercraft::testing::messageOf;

template <class Message>
std::vector<std::uint8_t> bytesOf(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <class Message>
MessageLayout layoutOf() {
  return {ros::message_traits::DataType<Message>::value(),
          ros::message_traits::Definition<Message>::value()};
}

/// A message that was read.
struct Read {
  MessageLayout layout;
  std::vector<std::uint8_t> bytes;
  std::vector<LeafValue> values;
  bool isWhole() { return layout.read(bytes.data(), bytes.size(), values); }
  const LeafValue& at(const std::string& path) const { return values.at(*layout.find(path)); }
};

TEST(MessageLayout, WhatHoldsNoNumbersIsNotGoneThrough) {
  // 31 levels of which each holds the next one twice, or 16 times: 2^31 paths to no number.
  for (const std::string& array : {std::string(), std::string("[16]")}) {
    std::string definition;
    for (int level = 1; level <= 31; ++level) {
      const std::string next = "p/L" + std::to_string(level) + array;
      definition.append(next).append(" a\n").append(next).append(" b\n");
      definition += std::string(80, '=') + "\nMSG: p/L" + std::to_string(level) + "\n";
    }
    const MessageLayout layout("p/L0", definition);
    EXPECT_TRUE(layout.leaves().empty());
    std::vector<LeafValue> values;
    EXPECT_TRUE(layout.read(nullptr, 0, values));
  }
}

TEST(MessageLayout, ReadsWhatRosWrote) {
  hovercraft_sim::State state;
  state.header.stamp.fromNSec(1'600'000'000'123'456'789);
  state.header.frame_id = "world";
  state.tick = 12345;
  state.episode = 7;
  state.pose.position.y = -2.5;
  state.pose.orientation.w = 1.0;
  state.angular_velocity.z = 0.125;
  state.thrust = {1.5, -2.5, 3.5};
  state.energy = 1e-300;
  state.hash = 0xfedcba9876543210U;
  Read read = {layoutOf<hovercraft_sim::State>(), bytesOf(state), {}};
  ASSERT_TRUE(read.isWhole());
  EXPECT_EQ(read.at("header.stamp").integer, 1'600'000'000'123'456'789);
  EXPECT_EQ(read.at("header.frame_id").text, "world");
  EXPECT_EQ(read.at("tick").number, 12345.0);
  EXPECT_EQ(read.at("episode").integer, 7);
  EXPECT_EQ(read.at("pose.position.y").number, -2.5);
  EXPECT_EQ(read.at("pose.orientation.w").number, 1.0);
  EXPECT_EQ(read.at("angular_velocity.z").number, 0.125);
  EXPECT_EQ(read.at("thrust[1]").number, -2.5);
  EXPECT_EQ(read.at("energy").number, 1e-300);
  EXPECT_EQ(static_cast<std::uint64_t>(read.at("hash").integer), 0xfedcba9876543210U);
}

TEST(MessageLayout, FlagsAndLongArrays) {
  hovercraft_sim::EngineStatus engines;
  engines.left.saturated = 1;
  engines.right.age = 0.25;
  Read read = {layoutOf<hovercraft_sim::EngineStatus>(), bytesOf(engines), {}};
  ASSERT_TRUE(read.isWhole());
  EXPECT_EQ(read.at("left.saturated").number, 1.0);
  EXPECT_EQ(read.at("rear.saturated").number, 0.0);
  EXPECT_EQ(read.at("right.age").number, 0.25);
  EXPECT_EQ(read.layout.leaves()[*read.layout.find("left.saturated")].kind, LeafKind::kFlag);

  // 36 numbers of a covariance have no leaves, and what comes behind them is read.
  nav_msgs::Odometry odom;
  odom.twist.twist.angular.z = 0.5;
  Read moved = {layoutOf<nav_msgs::Odometry>(), bytesOf(odom), {}};
  ASSERT_TRUE(moved.isWhole());
  EXPECT_EQ(moved.at("twist.twist.angular.z").number, 0.5);
  EXPECT_FALSE(moved.layout.find("pose.covariance[0]"));
}

/// Bytes by hand, as ROS lays them: lowest byte first, lengths of 32 bits.
void put(std::vector<std::uint8_t>& bytes, std::uint64_t value, unsigned count) {
  for (unsigned i = 0; i < count; ++i) {
    bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
  }
}

const char* const kList =
    "uint8 KIND=3 # a constant\nHeader header\nPart[] parts\nint16 last\n"
    "================================================================================\n"
    "MSG: std_msgs/Header\nuint32 seq\ntime stamp\nstring frame_id\n"
    "================================================================================\n"
    "MSG: other/Part\nstring name\nint8[] counts # any length\nfloat32 value\n";

TEST(MessageLayout, ListsOfAnyLength) {
  std::vector<std::uint8_t> bytes(16, 0);  // the header, with an empty frame
  put(bytes, 2, 4);
  for (const char name : {'a', 'b'}) {
    put(bytes, 1, 4);
    bytes.push_back(static_cast<std::uint8_t>(name));
    put(bytes, 3, 4);
    for (const int count : {-1, 2, -3}) put(bytes, static_cast<std::uint64_t>(count), 1);
    put(bytes, 0x40200000, 4);  // 2.5 in single precision
  }
  put(bytes, 0xfffe, 2);
  Read read = {MessageLayout("other/List", kList), bytes, {}};
  ASSERT_TRUE(read.isWhole());
  EXPECT_EQ(read.at("parts[1].name").text, "b");
  EXPECT_EQ(read.at("parts[1].counts[2]").number, -3.0);
  EXPECT_EQ(read.at("parts[0].value").number, 2.5);
  EXPECT_EQ(read.at("last").number, -2.0);
  EXPECT_TRUE(std::isnan(read.at("parts[2].value").number));  // there is no third one
}

TEST(MessageLayout, AMessageThatEndsTooEarlyIsSaidToBeSo) {
  hovercraft_sim::State state;
  state.header.frame_id = "world";
  Read read = {layoutOf<hovercraft_sim::State>(), bytesOf(state), {}};
  while (!read.bytes.empty()) {
    read.bytes.pop_back();
    EXPECT_FALSE(read.isWhole()) << read.bytes.size();
  }
  // Lengths that no message has: of a list, and of a text.
  std::vector<std::uint8_t> bytes(16, 0);
  put(bytes, 0xffffffff, 4);
  Read list = {MessageLayout("other/List", kList), bytes, {}};
  EXPECT_FALSE(list.isWhole());
}

TEST(MessageLayout, EmptyMessagesTakeNoTimeHoweverManyThereAre) {
  std::vector<std::uint8_t> bytes;
  put(bytes, 0xffffffff, 4);
  put(bytes, 7, 1);
  Read read = {MessageLayout("a/A",
                             "Nothing[] all\nuint8 last\n"
                             "========\nMSG: a/Nothing\n"),
               bytes,
               {}};
  ASSERT_TRUE(read.isWhole());
  EXPECT_EQ(read.at("last").number, 7.0);
}

TEST(MessageLayout, WhatIsNoDefinitionIsRefused) {
  const auto refused = [](const std::string& definition) {
    return messageOf([&] { MessageLayout("a/A", definition); });
  };
  EXPECT_EQ(refused("A again\n"),
            "the definition of the message: messages must not hold each other more than 32 deep");
  EXPECT_EQ(refused("b/B part\n"),
            "the definition of the message: 'b/B': is not among those that it holds");
  EXPECT_EQ(refused("float64\n"),
            "the definition of the message: 'float64': a field must have a name");
  EXPECT_EQ(refused("float64[9999999999] x\n"),
            "the definition of the message: 'float64[9999999999]': is no type");
  EXPECT_EQ(refused("float64[3 x\n"), "the definition of the message: 'float64[3': is no type");
}

TEST(MessageLayout, ListsWithinListsHaveABoundedNumberOfLeaves) {
  std::string definition = "B1[] b\n";
  for (int i = 1; i < 20; ++i) {
    definition += "========\nMSG: a/B" + std::to_string(i) + "\nB" + std::to_string(i + 1) +
                  "[1000] b\nfloat64 x\n";
  }
  definition += "========\nMSG: a/B20\nfloat64[16] x\n";
  const MessageLayout layout("a/A", definition);
  EXPECT_LE(layout.leaves().size(), MessageLayout::kMostLeaves);
}

}  // namespace
}  // namespace hovercraft_ros
