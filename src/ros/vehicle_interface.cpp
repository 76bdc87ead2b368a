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
  for (std::size_t i = 0; i < command.thrusts.size(); ++i) {
    const hovercraft::EngineParameters& limits =
        i < hovercraft::kFirstActuator ? craft.engines[i]
                                       : craft.actuators[i - hovercraft::kFirstActuator].motion;
    const bool addressed = (command.engines & hovercraft::maskOf(i)) != 0;
    if (addressed &&
        (command.thrusts[i] < limits.min_thrust || command.thrusts[i] > limits.max_thrust)) {
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
    refresh();
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
        take(toCommand(message, vehicle_, run_.simulation().tick()), all, message.header.stamp);
      };
  subscribers_.push_back(handle.subscribe<hovercraft_sim::ThrustCommand>(
      kThrustTopic, kThrustQueue, on_thrust, ros::VoidConstPtr(), hints));
  for (int i = 0; i < hovercraft::kEngineCount; ++i) {
    if (!craft.has_engine[static_cast<std::size_t>(i)]) continue;
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

void VehicleInterface::subscribeActuators(ros::NodeHandle& handle) {
  const hovercraft::VehicleScenario& craft = run_.simulation().scenario().vehicles[vehicle_];
  if (craft.actuators.empty()) return;
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  const std::string all = handle.resolveName(kActuatorCommandTopic);
  const boost::function<void(const hovercraft_sim::ActuatorCommand&)> on_all =
      [this, &craft, all](const hovercraft_sim::ActuatorCommand& message) {
        take(toCommand(message, craft, vehicle_, run_.simulation().tick()), all,
             message.header.stamp, "names and values must be of actuators, each once and finite");
      };
  subscribers_.push_back(handle.subscribe<hovercraft_sim::ActuatorCommand>(
      kActuatorCommandTopic, kThrustQueue, on_all, ros::VoidConstPtr(), hints));
  for (std::size_t i = 0; i < craft.actuators.size(); ++i) {
    const std::size_t id = hovercraft::kFirstActuator + i;
    const std::string relative = std::string(kActuatorsTopic) + "/" + craft.actuators[i].name;
    const std::string topic = handle.resolveName(relative);
    const boost::function<void(const std_msgs::Float64&)> on_value =
        [this, id, topic](const std_msgs::Float64& message) {
          take(toCommand(message.data, id, vehicle_, run_.simulation().tick()), topic, std::nullopt,
               "a value must be finite");
        };
    subscribers_.push_back(handle.subscribe<std_msgs::Float64>(relative, kThrustQueue, on_value,
                                                               ros::VoidConstPtr(), hints));
  }
}

void VehicleInterface::take(const std::optional<hovercraft::Command>& command,
                            const std::string& topic, const std::optional<ros::Time>& stamp,
                            const char* rule) {
  const char* refusal = command ? owner_.take(*command, stamp) : rule;
  if (refusal != nullptr) {
    ++dropped_commands_;
    if (drop_warnings_.isDue(steadyNow())) {
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
  if (saturation_warnings_.isDue(steadyNow())) {
    ROS_WARN("%s: a thrust beyond the engine's limits is saturated (%lu so far)", source.c_str(),
             static_cast<unsigned long>(saturated_commands_));
  }
}

std::vector<std::string> VehicleInterface::topics() const {
  std::vector<std::string> names = {pose_.topic(),       twist_.topic(), odom_.topic(),
                                    engines_.topic(),    state_.topic(), wind_.topic(),
                                    commands_.getTopic()};
  if (messages_.hasActuators()) names.push_back(actuators_.topic());
  if (messages_.hasCushion()) names.push_back(cushion_.topic());
  return names;
}

void VehicleInterface::publish() {
  pose_.publish(messages_.pose());
  twist_.publish(messages_.twist());
  odom_.publish(messages_.odom());
  engines_.publish(messages_.engines());
  if (messages_.hasActuators()) actuators_.publish(messages_.actuators());
  state_.publish(messages_.state());
  wind_.publish(messages_.wind());
  if (messages_.hasCushion()) cushion_.publish(messages_.cushion());
}

void VehicleInterface::publishApplied(const hovercraft::Command& command) {
  commands_.publish(messages_.appliedCommand(command, run_.place()));
}

}  // namespace hovercraft_ros
