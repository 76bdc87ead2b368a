#pragma once

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/AppliedCommandFormat1.h>
#include <hovercraft_sim/RunEvent.h>
#include <hovercraft_sim/RunEventFormat1.h>
#include <hovercraft_sim/State.h>
#include <hovercraft_sim/StateFormat1.h>

namespace hovercraft_ros {

/// What a message was in earlier versions, by a frozen copy of its definition
/// (msg/NAMEFormatN.msg), and how it becomes one of today. ROS tells definitions apart by their MD5
/// sums, which do not hold the name. The same for rosbag and its tools: migration/format_1.bmr.
template <class Message>
struct OlderFormat {
  static constexpr bool kExists = false;
};

template <>
struct OlderFormat<hovercraft_sim::AppliedCommand> {
  static constexpr bool kExists = true;
  using Message = hovercraft_sim::AppliedCommandFormat1;

  /// It is for no actuator but the engines.
  static hovercraft_sim::AppliedCommand upgraded(const Message& old) {
    hovercraft_sim::AppliedCommand message;
    message.header = old.header;
    message.tick = old.tick;
    message.episode = old.episode;
    message.number = old.number;
    message.engines = old.engines;
    message.rear = old.rear;
    message.left = old.left;
    message.right = old.right;
    return message;
  }
};

template <>
struct OlderFormat<hovercraft_sim::RunEvent> {
  static constexpr bool kExists = true;
  using Message = hovercraft_sim::RunEventFormat1;

  static hovercraft_sim::RunEvent upgraded(const Message& old) {
    hovercraft_sim::RunEvent message;
    message.header = old.header;
    message.number = old.number;
    message.kind = old.kind;
    message.tick = old.tick;
    message.episode = old.episode;
    message.vehicle = old.vehicle;
    message.pose = old.pose;
    message.twist = old.twist;
    message.wrench = old.wrench;
    message.in_body_axes = old.in_body_axes;
    message.end_tick = old.end_tick;
    message.seed = old.seed;
    message.snapshot = old.snapshot;
    return message;
  }
};

template <>
struct OlderFormat<hovercraft_sim::State> {
  static constexpr bool kExists = true;
  using Message = hovercraft_sim::StateFormat1;

  /// A craft with neither other actuators, nor further states, nor sensors.
  static hovercraft_sim::State upgraded(const Message& old) {
    hovercraft_sim::State message;
    message.header = old.header;
    message.tick = old.tick;
    message.episode = old.episode;
    message.pose = old.pose;
    message.velocity = old.velocity;
    message.angular_velocity = old.angular_velocity;
    message.momentum = old.momentum;
    message.angular_momentum = old.angular_momentum;
    message.thrust = old.thrust;
    message.energy = old.energy;
    message.commands = old.commands;
    message.events = old.events;
    message.hash = old.hash;
    return message;
  }
};

}  // namespace hovercraft_ros
