#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <hovercraft_sim/ThrustCommand.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include "hovercraft_sim/live/live_run.h"
#include "hovercraft_sim/live/newcomer_publisher.h"
#include "hovercraft_sim/live/topic_publisher.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/pacing/warning_limiter.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros {

/// The topics of one craft: thrusts in, messages out. A bad thrust is dropped whole and counted.
class HOVERCRAFT_PUBLIC VehicleInterface {
 public:
  /// Receives a command, whose tick the receiver sets, and the stamp of its header if it has one;
  /// returns null, or why it was not accepted. Called from the node's callback queue only.
  using CommandSink =
      std::function<const char*(const hovercraft::Command&, const std::optional<ros::Time>& stamp)>;

  /// The node that the craft flies in.
  struct Owner {
    CommandSink accept;
    /// The run stands, and publishes nothing by itself: who subscribes then is given the present
    /// state, he alone.
    std::function<bool()> stands;
    /// The topic of the true odometry.
    std::string truth_odom = kOdomTopic;
  };

  /// @param handle of the namespace that the craft's own namespace lies in.
  /// @param latched who subscribes late gets the last messages: in lockstep a controller that
  /// starts after the simulation could not answer them otherwise.
  VehicleInterface(const ros::NodeHandle& handle, const LiveRun& run, std::size_t vehicle,
                   const TfFrames& frames, Owner owner, bool latched = false);
  VehicleInterface(const VehicleInterface&) = delete;
  VehicleInterface& operator=(const VehicleInterface&) = delete;

  /// Fills messages from the run as it stands.
  void refresh(const MessageParts& parts) {
    messages_.fill(run_.simulation(), run_.place(), parts);
  }
  /// Fills and publishes those that someone hears. @param others that are filled all the same: what
  /// the node sends for all craft at once.
  void publish(MessageParts others);
  void publishApplied(const hovercraft::Command& command);
  /// Counts a command that was accepted, and warns if it is beyond the engines' limits.
  /// @param source where it came from.
  void noteSaturation(const hovercraft::Command& command, const std::string& source);
  /// Full names of the topics that nobody else may publish.
  std::vector<std::string> topics() const;

  const VehicleMessages& messages() const { return messages_; }
  std::uint64_t droppedCommands() const { return dropped_commands_; }
  std::uint64_t saturatedCommands() const { return saturated_commands_; }

 private:
  template <class Message>
  HOVERCRAFT_HIDDEN NewcomerPublisher<Message> advertise(
      ros::NodeHandle& handle, const char* topic,
      const Message& (VehicleMessages::*message)() const, bool latched);
  void subscribe(ros::NodeHandle& handle);
  void subscribeLevel(ros::NodeHandle& handle, std::size_t id, const char* rule);
  void subscribeActuators(ros::NodeHandle& handle);
  /// Hands a command on and counts what becomes of it; no command: it was not finite.
  /// @param rule that a message without a command breaks.
  void receive(const std::optional<hovercraft::Command>& command, const std::string& topic,
               const std::optional<ros::Time>& stamp, const char* rule = "a thrust must be finite");

  const LiveRun& run_;
  std::size_t vehicle_;
  Owner owner_;
  VehicleMessages messages_;
  hovercraft::WarningLimiter drop_warnings_;
  hovercraft::WarningLimiter saturation_warnings_;
  std::uint64_t dropped_commands_ = 0;
  std::uint64_t saturated_commands_ = 0;
  NewcomerPublisher<geometry_msgs::PoseStamped> pose_;
  NewcomerPublisher<geometry_msgs::TwistStamped> twist_;
  NewcomerPublisher<nav_msgs::Odometry> odom_;
  NewcomerPublisher<hovercraft_sim::EngineStatus> engines_;
  NewcomerPublisher<hovercraft_sim::ActuatorStatusArray> actuators_;
  NewcomerPublisher<hovercraft_sim::State> state_;
  NewcomerPublisher<hovercraft_sim::Wind> wind_;
  NewcomerPublisher<hovercraft_sim::Cushion> cushion_;  // of a craft that has one
  TopicPublisher commands_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace hovercraft_ros
