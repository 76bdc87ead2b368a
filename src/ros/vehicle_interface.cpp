#include "hovercraft_sim/ros/vehicle_interface.h"

#include <fmt/format.h>
#include <utility>

#include <ros/console.h>
#include <ros/transport_hints.h>

#include "hovercraft_sim/ros/conversions.h"

namespace hovercraft_ros {
namespace {

constexpr std::uint32_t kThrustQueue = 10;     // a burst between two steps; the newest counts
constexpr std::uint32_t kStateQueue = 100;     // one second at 100 Hz for a subscriber that stalls
constexpr std::uint32_t kCommandQueue = 1000;  // every accepted command belongs in a recording

using hovercraft::kEngineNames;

bool exceedsLimits(const hovercraft::Command& command, const hovercraft::VehicleScenario& craft) {
  for (int i = 0; i < hovercraft::kEngineCount; ++i) {
    const auto& limits = craft.engines[static_cast<std::size_t>(i)];
    const bool addressed =
        (command.engines & hovercraft::maskOf(static_cast<hovercraft::EngineId>(i))) != 0;
    if (addressed &&
        (command.thrusts[i] < limits.min_thrust || command.thrusts[i] > limits.max_thrust)) {
      return true;
    }
  }
  return false;
}

}  // namespace

VehicleInterface::VehicleInterface(const ros::NodeHandle& handle,
                                   const hovercraft::Simulation& simulation, std::size_t vehicle,
                                   const std::string& world_frame, CommandSink sink)
    : simulation_(simulation),
      vehicle_(vehicle),
      messages_(simulation.scenario(), vehicle, world_frame) {
  const hovercraft::VehicleScenario& craft = simulation.scenario().vehicles[vehicle];
  sink_ = [this, &craft, sink = std::move(sink)](const hovercraft::Command& command) {
    if (exceedsLimits(command, craft)) {
      ++saturated_commands_;
      ROS_WARN_THROTTLE(1.0, "%s: a thrust beyond the engine's limits is saturated (%lu so far)",
                        craft.name.c_str(), static_cast<unsigned long>(saturated_commands_));
    }
    sink(command);
  };
  ros::NodeHandle own(handle, craft.name);
  pose_ = own.advertise<geometry_msgs::PoseStamped>(kPoseTopic, kStateQueue);
  twist_ = own.advertise<geometry_msgs::TwistStamped>(kTwistTopic, kStateQueue);
  odom_ = own.advertise<nav_msgs::Odometry>(kOdomTopic, kStateQueue);
  engines_ = own.advertise<hovercraft_sim::EngineStatus>(kEnginesTopic, kStateQueue);
  state_ = own.advertise<hovercraft_sim::State>(kStateTopic, kStateQueue);
  commands_ = own.advertise<hovercraft_sim::AppliedCommand>(kCommandsTopic, kCommandQueue);
  subscribe(own);
}

void VehicleInterface::subscribe(ros::NodeHandle& handle) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  const std::string all = handle.resolveName(kThrustTopic);
  const boost::function<void(const hovercraft_sim::ThrustCommand&)> on_thrust =
      [this, all](const hovercraft_sim::ThrustCommand& message) {
        const auto command = toCommand(message, vehicle_, simulation_.tick());
        if (command) return sink_(*command);
        drop(all,
             fmt::format("rear {}, left {}, right {}", message.rear, message.left, message.right));
      };
  subscribers_.push_back(handle.subscribe<hovercraft_sim::ThrustCommand>(
      kThrustTopic, kThrustQueue, on_thrust, ros::VoidConstPtr(), hints));
  for (int i = 0; i < hovercraft::kEngineCount; ++i) {
    const auto engine = static_cast<hovercraft::EngineId>(i);
    const std::string relative =
        std::string(kThrustTopic) + "/" + kEngineNames[static_cast<std::size_t>(i)];
    const std::string topic = handle.resolveName(relative);
    const boost::function<void(const std_msgs::Float64&)> on_engine =
        [this, engine, topic](const std_msgs::Float64& message) {
          const auto command = toCommand(message.data, engine, vehicle_, simulation_.tick());
          if (command) return sink_(*command);
          drop(topic, fmt::format("{}", message.data));
        };
    subscribers_.push_back(handle.subscribe<std_msgs::Float64>(relative, kThrustQueue, on_engine,
                                                               ros::VoidConstPtr(), hints));
  }
}

void VehicleInterface::drop(const std::string& topic, const std::string& what) {
  ++dropped_commands_;
  ROS_WARN_THROTTLE(1.0, "%s: dropped a command that is not finite: %s (%lu so far)", topic.c_str(),
                    what.c_str(), static_cast<unsigned long>(dropped_commands_));
}

void VehicleInterface::publish(const ros::Time& stamp) {
  messages_.fill(simulation_, stamp);
  pose_.publish(messages_.pose());
  twist_.publish(messages_.twist());
  odom_.publish(messages_.odom());
  engines_.publish(messages_.engines());
  state_.publish(messages_.state());
}

void VehicleInterface::publishApplied(const hovercraft::Command& command, const ros::Time& stamp) {
  commands_.publish(messages_.appliedCommand(command, stamp));
}

}  // namespace hovercraft_ros
