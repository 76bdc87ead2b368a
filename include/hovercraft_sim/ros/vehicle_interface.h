#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <hovercraft_sim/ThrustCommand.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <std_msgs/Float64.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/ros/live_run.h"
#include "hovercraft_sim/ros/vehicle_messages.h"
#include "hovercraft_sim/ros/warning_limiter.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros {

/// The topics of one craft: thrusts in, messages out. A bad thrust is dropped whole and counted.
class HOVERCRAFT_PUBLIC VehicleInterface {
 public:
  /// Receives a command, whose tick the receiver sets, and the stamp of its header if it has one;
  /// returns null, or why it was not taken. Called from the node's callback queue only.
  using CommandSink =
      std::function<const char*(const hovercraft::Command&, const std::optional<ros::Time>& stamp)>;

  /// @param handle of the namespace that the craft's own namespace lies in.
  /// @param latched who subscribes late gets the last messages: in lockstep a controller that
  /// starts after the simulation could not answer them otherwise.
  VehicleInterface(const ros::NodeHandle& handle, const LiveRun& run, std::size_t vehicle,
                   const std::string& world_frame, CommandSink sink, bool latched = false);
  VehicleInterface(const VehicleInterface&) = delete;
  VehicleInterface& operator=(const VehicleInterface&) = delete;

  /// Publishes every message but the transform, which the node sends for all craft at once.
  void publish();
  void publishApplied(const hovercraft::Command& command);

  const VehicleMessages& messages() const { return messages_; }
  std::uint64_t droppedCommands() const { return dropped_commands_; }
  std::uint64_t saturatedCommands() const { return saturated_commands_; }

 private:
  void subscribe(ros::NodeHandle& handle);
  /// Hands a command on and counts what becomes of it; no command: it was not finite.
  void take(const std::optional<hovercraft::Command>& command, const std::string& topic,
            const std::optional<ros::Time>& stamp);

  const LiveRun& run_;
  std::size_t vehicle_;
  CommandSink sink_;
  VehicleMessages messages_;
  WarningLimiter drop_warnings_;
  WarningLimiter saturation_warnings_;
  std::uint64_t dropped_commands_ = 0;
  std::uint64_t saturated_commands_ = 0;
  ros::Publisher pose_, twist_, odom_, engines_, state_, commands_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace hovercraft_ros
