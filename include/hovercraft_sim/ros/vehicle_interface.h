#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <hovercraft_sim/ThrustCommand.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <std_msgs/Float64.h>

#include "hovercraft_sim/ros/vehicle_messages.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros {

/// The topics of one craft: thrusts in, messages out. A bad thrust is dropped whole and counted.
class VehicleInterface {
 public:
  /// Receives a command for the current tick; called from the node's callback queue only.
  using CommandSink = std::function<void(const hovercraft::Command&)>;

  /// @param handle of the namespace that the craft's own namespace lies in.
  VehicleInterface(const ros::NodeHandle& handle, const hovercraft::Simulation& simulation,
                   std::size_t vehicle, const std::string& world_frame, CommandSink sink);
  VehicleInterface(const VehicleInterface&) = delete;
  VehicleInterface& operator=(const VehicleInterface&) = delete;

  /// Publishes every message but the transform, which the node sends for all craft at once.
  void publish(const ros::Time& stamp);
  void publishApplied(const hovercraft::Command& command, const ros::Time& stamp);

  const VehicleMessages& messages() const { return messages_; }
  std::uint64_t droppedCommands() const { return dropped_commands_; }
  std::uint64_t saturatedCommands() const { return saturated_commands_; }

 private:
  void subscribe(ros::NodeHandle& handle);
  void drop(const std::string& topic, const std::string& what);

  const hovercraft::Simulation& simulation_;
  std::size_t vehicle_;
  CommandSink sink_;
  VehicleMessages messages_;
  std::uint64_t dropped_commands_ = 0;
  std::uint64_t saturated_commands_ = 0;
  ros::Publisher pose_, twist_, odom_, engines_, state_, commands_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace hovercraft_ros
