#include "hovercraft_sim/live/vehicle_interface.h"

#include <utility>

#include <ros/console.h>
#include <ros/transport_hints.h>
#include <std_msgs/Float32.h>
#include <std_msgs/Float64.h>

#include "hovercraft_sim/io/steady_clock.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/scenario/actuator_topics.h"

namespace hovercraft_ros {
namespace {

constexpr std::uint32_t kThrustQueue = 10;     // a burst between two steps; the newest counts
constexpr std::uint32_t kStateQueue = 100;     // one second at 100 Hz for a subscriber that stalls
constexpr std::uint32_t kCommandQueue = 1000;  // every accepted command belongs in a recording

bool exceedsLimits(const hovercraft::Command& command, const hovercraft::VehicleScenario& craft) {
  for (std::size_t i = 0; i < command.thrusts.size(); ++i) {
    const hovercraft::EngineParameters& limits =
        i < hovercraft::kFirstActuator ? craft.engines[i]
                                       : craft.actuators[i - hovercraft::kFirstActuator].motion;
    const bool addressed = (command.engines & hovercraft::maskOf(i)) != 0;
    if (addressed &&
        limits.command.exceeds(command.thrusts[i], limits.min_thrust, limits.max_thrust)) {
      return true;
    }
  }
  return false;
}

}  // namespace

VehicleInterface::VehicleInterface(const ros::NodeHandle& handle, const LiveRun& run,
                                   std::size_t vehicle, const TfFrames& frames, Owner owner,
                                   bool latched)
    : run_(run),
      vehicle_(vehicle),
      owner_(std::move(owner)),
      messages_(run.simulation().scenario(), vehicle, frames) {
  ros::NodeHandle own(handle, messages_.name());
  pose_ = advertise(own, kPoseTopic, &VehicleMessages::pose, latched);
  twist_ = advertise(own, kTwistTopic, &VehicleMessages::twist, latched);
  odom_ = advertise(own, owner_.truth_odom.c_str(), &VehicleMessages::odom, latched);
  engines_ = advertise(own, kEnginesTopic, &VehicleMessages::engines, latched);
  state_ = advertise(own, kStateTopic, &VehicleMessages::state, latched);
  wind_ = advertise(own, kWindTopic, &VehicleMessages::wind, latched);
  if (messages_.hasCushion()) {
    cushion_ = advertise(own, kCushionTopic, &VehicleMessages::cushion, latched);
  }
  commands_ = own.advertise<hovercraft_sim::AppliedCommand>(kCommandsTopic, kCommandQueue);
  if (messages_.hasActuators()) {
    actuators_ = advertise(own, kActuatorsTopic, &VehicleMessages::actuators, latched);
  }
  subscribe(own);
  subscribeActuators(own);
}

template <class Message>
NewcomerPublisher<Message> VehicleInterface::advertise(ros::NodeHandle& handle, const char* topic,
                                                       const Message& (VehicleMessages::*message)()
                                                           const,
                                                       bool latched) {
  const auto present = [this, message]() -> const Message* {
    if (!owner_.stands()) return nullptr;
    refresh(MessageParts::all());
    return &(messages_.*message)();
  };
  return {handle, topic, kStateQueue, present, latched};
}

void VehicleInterface::subscribe(ros::NodeHandle& handle) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  const hovercraft::VehicleScenario& craft = run_.simulation().scenario().vehicles[vehicle_];
  const std::string all = handle.resolveName(kThrustTopic);
  const boost::function<void(const hovercraft_sim::ThrustCommand&)> on_thrust =
      [this, all](const hovercraft_sim::ThrustCommand& message) {
        receive(toCommand(message, vehicle_), all, message.header.stamp);
      };
  subscribers_.push_back(handle.subscribe<hovercraft_sim::ThrustCommand>(
      kThrustTopic, kThrustQueue, on_thrust, ros::VoidConstPtr(), hints));
  for (std::size_t id = 0; id < hovercraft::kEngineNames.size(); ++id) {
    if (craft.has_engine[id]) subscribeLevel(handle, id, "a thrust must be finite");
  }
}

/// An engine or another actuator by itself, on the topic and by the message that its scenario says.
void VehicleInterface::subscribeLevel(ros::NodeHandle& handle, std::size_t id, const char* rule) {
  const hovercraft::VehicleScenario& craft = run_.simulation().scenario().vehicles[vehicle_];
  const std::string relative = hovercraft::commandTopicOf(craft, id);
  const auto take_value = [this, id, rule, topic = handle.resolveName(relative)](double value) {
    receive(toCommand(value, id, vehicle_), topic, std::nullopt, rule);
  };
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  if (hovercraft::isFloat32(craft, id)) {
    const boost::function<void(const std_msgs::Float32&)> on_value =
        [take_value](const std_msgs::Float32& message) {
          take_value(static_cast<double>(message.data));
        };
    subscribers_.push_back(handle.subscribe<std_msgs::Float32>(relative, kThrustQueue, on_value,
                                                               ros::VoidConstPtr(), hints));
    return;
  }
  const boost::function<void(const std_msgs::Float64&)> on_value =
      [take_value](const std_msgs::Float64& message) { take_value(message.data); };
  subscribers_.push_back(handle.subscribe<std_msgs::Float64>(relative, kThrustQueue, on_value,
                                                             ros::VoidConstPtr(), hints));
}

void VehicleInterface::subscribeActuators(ros::NodeHandle& handle) {
  const hovercraft::VehicleScenario& craft = run_.simulation().scenario().vehicles[vehicle_];
  if (craft.actuators.empty()) return;
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  const std::string all = handle.resolveName(kActuatorCommandTopic);
  const boost::function<void(const hovercraft_sim::ActuatorCommand&)> on_all =
      [this, &craft, all](const hovercraft_sim::ActuatorCommand& message) {
        receive(toCommand(message, craft, vehicle_), all, message.header.stamp,
                "names and values must be of actuators, each once and finite");
      };
  subscribers_.push_back(handle.subscribe<hovercraft_sim::ActuatorCommand>(
      kActuatorCommandTopic, kThrustQueue, on_all, ros::VoidConstPtr(), hints));
  for (std::size_t i = 0; i < craft.actuators.size(); ++i) {
    subscribeLevel(handle, hovercraft::kFirstActuator + i, "a value must be finite");
  }
}

void VehicleInterface::receive(const std::optional<hovercraft::Command>& command,
                               const std::string& topic, const std::optional<ros::Time>& stamp,
                               const char* rule) {
  const char* refusal = command ? owner_.accept(*command, stamp) : rule;
  if (refusal != nullptr) {
    ++dropped_commands_;
    if (drop_warnings_.isDue(hovercraft::steadyNow())) {
      ROS_WARN("%s: dropped a command: %s (%lu dropped so far)", topic.c_str(), refusal,
               static_cast<unsigned long>(dropped_commands_));
    }
    return;
  }
  noteSaturation(*command, topic);
}

void VehicleInterface::noteSaturation(const hovercraft::Command& command,
                                      const std::string& source) {
  const auto& craft = run_.simulation().scenario().vehicles[vehicle_];
  if (!exceedsLimits(command, craft)) return;
  ++saturated_commands_;
  if (saturation_warnings_.isDue(hovercraft::steadyNow())) {
    ROS_WARN("%s: a thrust beyond the engine's limits is saturated (%lu so far)", source.c_str(),
             static_cast<unsigned long>(saturated_commands_));
  }
}

std::vector<std::string> VehicleInterface::topics() const {
  std::vector<std::string> names = {pose_.topic(),    twist_.topic(), odom_.topic(),
                                    engines_.topic(), state_.topic(), wind_.topic(),
                                    commands_.topic()};
  if (messages_.hasActuators()) names.push_back(actuators_.topic());
  if (messages_.hasCushion()) names.push_back(cushion_.topic());
  return names;
}

void VehicleInterface::publish(MessageParts others) {
  // Asked once: who comes in between hears of the next tick, not of what was not filled.
  const bool pose = pose_.isHeard();
  const bool twist = twist_.isHeard();
  const bool odom = odom_.isHeard();
  const bool actuators = messages_.hasActuators() && actuators_.isHeard();
  const bool cushion = messages_.hasCushion() && cushion_.isHeard();
  MessageParts heard;
  heard.engines = engines_.isHeard();
  heard.state = state_.isHeard();
  heard.wind = wind_.isHeard();
  refresh({others.frames || pose || twist || odom, heard.engines, actuators,
           others.state || heard.state, heard.wind, cushion});
  pose_.publishIf(pose, messages_.pose());
  twist_.publishIf(twist, messages_.twist());
  odom_.publishIf(odom, messages_.odom());
  engines_.publishIf(heard.engines, messages_.engines());
  if (messages_.hasActuators()) actuators_.publishIf(actuators, messages_.actuators());
  state_.publishIf(heard.state, messages_.state());
  wind_.publishIf(heard.wind, messages_.wind());
  if (messages_.hasCushion()) cushion_.publishIf(cushion, messages_.cushion());
}

void VehicleInterface::publishApplied(const hovercraft::Command& command) {
  commands_.publish(messages_.appliedCommand(command, run_.place()));
}

}  // namespace hovercraft_ros
