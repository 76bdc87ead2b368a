#include "hovercraft_sim/ros/vehicle_interface.h"

#include <utility>

#include <ros/console.h>
#include <ros/transport_hints.h>

#include "hovercraft_sim/ros/conversions.h"
#include "hovercraft_sim/ros/steady_clock.h"

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

VehicleInterface::VehicleInterface(const ros::NodeHandle& handle, const LiveRun& run,
                                   std::size_t vehicle, const std::string& world_frame,
                                   CommandSink sink, bool latched)
    : run_(run),
      vehicle_(vehicle),
      sink_(std::move(sink)),
      messages_(run.simulation().scenario(), vehicle, world_frame) {
  ros::NodeHandle own(handle, messages_.name());
  pose_ = own.advertise<geometry_msgs::PoseStamped>(kPoseTopic, kStateQueue, latched);
  twist_ = own.advertise<geometry_msgs::TwistStamped>(kTwistTopic, kStateQueue, latched);
  odom_ = own.advertise<nav_msgs::Odometry>(kOdomTopic, kStateQueue, latched);
  engines_ = own.advertise<hovercraft_sim::EngineStatus>(kEnginesTopic, kStateQueue, latched);
  state_ = own.advertise<hovercraft_sim::State>(kStateTopic, kStateQueue, latched);
  commands_ = own.advertise<hovercraft_sim::AppliedCommand>(kCommandsTopic, kCommandQueue);
  subscribe(own);
}

void VehicleInterface::subscribe(ros::NodeHandle& handle) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  const std::string all = handle.resolveName(kThrustTopic);
  const boost::function<void(const hovercraft_sim::ThrustCommand&)> on_thrust =
      [this, all](const hovercraft_sim::ThrustCommand& message) {
        take(toCommand(message, vehicle_, run_.simulation().tick()), all, message.header.stamp);
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
          take(toCommand(message.data, engine, vehicle_, run_.simulation().tick()), topic,
               std::nullopt);
        };
    subscribers_.push_back(handle.subscribe<std_msgs::Float64>(relative, kThrustQueue, on_engine,
                                                               ros::VoidConstPtr(), hints));
  }
}

void VehicleInterface::take(const std::optional<hovercraft::Command>& command,
                            const std::string& topic, const std::optional<ros::Time>& stamp) {
  const char* refusal = command ? sink_(*command, stamp) : "a thrust must be finite";
  if (refusal != nullptr) {
    ++dropped_commands_;
    if (drop_warnings_.isDue(steadyNow())) {
      ROS_WARN("%s: dropped a command: %s (%lu dropped so far)", topic.c_str(), refusal,
               static_cast<unsigned long>(dropped_commands_));
    }
    return;
  }
  const auto& craft = run_.simulation().scenario().vehicles[vehicle_];
  if (!exceedsLimits(*command, craft)) return;
  ++saturated_commands_;
  if (saturation_warnings_.isDue(steadyNow())) {
    ROS_WARN("%s: a thrust beyond the engine's limits is saturated (%lu so far)", topic.c_str(),
             static_cast<unsigned long>(saturated_commands_));
  }
}

void VehicleInterface::publish() {
  messages_.fill(run_.simulation(), run_.place());
  pose_.publish(messages_.pose());
  twist_.publish(messages_.twist());
  odom_.publish(messages_.odom());
  engines_.publish(messages_.engines());
  state_.publish(messages_.state());
}

void VehicleInterface::publishApplied(const hovercraft::Command& command) {
  commands_.publish(messages_.appliedCommand(command, run_.place()));
}

}  // namespace hovercraft_ros
