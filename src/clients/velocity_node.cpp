#include "hovercraft_sim/clients/velocity_node.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <ros/console.h>
#include <ros/single_subscriber_publisher.h>
#include <ros/transport_hints.h>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/io/steady_clock.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/scenario/velocity_parameters.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft_ros {
namespace {

constexpr double kFastest = 1e3;  // m/s, rad/s: beyond it a message is no motion of a craft
constexpr const char* kRule = "dropped: must be finite, and at most 1000 m/s or rad/s";

bool isMotion(const hovercraft::PlanarVelocity& velocity) {
  return std::abs(velocity.u) <= kFastest && std::abs(velocity.v) <= kFastest &&
         std::abs(velocity.r) <= kFastest;
}

}  // namespace

VelocityNodeConfig parseVelocityNodeConfig(const hovercraft::ConfigNode& parameters,
                                           const std::string& node_name) {
  const hovercraft::ConfigReader reader(parameters, node_name);
  reader.allowOnly({"parameters", "timeout"});
  const std::string source = node_name + "/parameters";
  const hovercraft::ConfigReader craft(hovercraft::treeOf(reader.text("parameters"), source),
                                       source);
  const hovercraft::VelocityParameters read = hovercraft::parseVelocityParameters(craft);
  VelocityNodeConfig config;
  config.plant = read.plant;
  config.gains = read.gains;
  config.commands = read.commands;
  config.timeout = reader.numberOr(config.timeout, "timeout", hovercraft::kPositive);
  return config;
}

VelocityNode::VelocityNode(ros::NodeHandle& handle, const VelocityNodeConfig& config)
    : config_(config), law_(config.plant, config.gains) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  // In lockstep the simulation waits for the first answer even if it came before its connection.
  const ros::SubscriberStatusCallback repeat = [this](const ros::SingleSubscriberPublisher& to) {
    if (thrusts_.header.stamp.isZero()) return;
    if (hasEnginesOnly()) {
      to.publish(thrusts_);
    } else {
      to.publish(levels_);
    }
  };
  for (const auto& actuator : config_.plant.actuators) levels_.names.push_back(actuator.name);
  levels_.values.resize(levels_.names.size());
  answers_ =
      hasEnginesOnly()
          ? handle.advertise<hovercraft_sim::ThrustCommand>(kThrustTopic, 10, repeat)
          : handle.advertise<hovercraft_sim::ActuatorCommand>(kActuatorCommandTopic, 10, repeat);
  const boost::function<void(const geometry_msgs::Twist&)> take =
      [this](const geometry_msgs::Twist& command) { this->take(command); };
  commands_ =
      handle.subscribe<geometry_msgs::Twist>("cmd_vel", 10, take, ros::VoidConstPtr(), hints);
  const boost::function<void(const nav_msgs::Odometry&)> answer =
      [this](const nav_msgs::Odometry& odometry) { this->answer(odometry); };
  odometry_ = handle.subscribe<nav_msgs::Odometry>("odom", 10, answer, ros::VoidConstPtr(), hints);
}

void VelocityNode::take(const geometry_msgs::Twist& command) {
  const hovercraft::PlanarVelocity wanted = {command.linear.x, command.linear.y, command.angular.z};
  if (!isMotion(wanted)) {
    if (warnings_.isDue(hovercraft::steadyNow())) ROS_WARN("cmd_vel: %s", kRule);
    return;
  }
  command_ = wanted;
  commanded_ns_ = last_ns_;
  has_new_command_ = true;
}

/// Time counts from the odometry that was there when the command came, or from the next one.
bool VelocityNode::isDead(std::int64_t now_ns) const {
  return !commanded_ns_ || 1e-9 * static_cast<double>(now_ns - *commanded_ns_) > config_.timeout;
}

void VelocityNode::answer(const nav_msgs::Odometry& odometry) {
  const auto now_ns = static_cast<std::int64_t>(odometry.header.stamp.toNSec());
  const auto& twist = odometry.twist.twist;
  const hovercraft::PlanarVelocity measured = {twist.linear.x, twist.linear.y, twist.angular.z};
  if (!isMotion(measured)) {
    if (warnings_.isDue(hovercraft::steadyNow())) ROS_WARN("odom: %s", kRule);
    return;
  }
  const double dt = last_ns_ ? 1e-9 * static_cast<double>(now_ns - *last_ns_) : 0.0;
  last_ns_ = now_ns;
  // Time began anew: what was asked for before it counts no more.
  if (dt < 0.0 && !has_new_command_) commanded_ns_.reset();
  if (has_new_command_ && (!commanded_ns_ || dt < 0.0)) commanded_ns_ = now_ns;
  has_new_command_ = false;
  hovercraft::Thrusts levels{};
  if (isDead(now_ns) || dt < 0.0) {
    law_.reset();
  } else {
    levels = law_.levels(command_, measured, dt);
  }
  answer(odometry.header.stamp, levels);
}

/// By one message whatever the actuators are: in lockstep one is taken.
void VelocityNode::answer(const ros::Time& stamp, const hovercraft::Thrusts& levels) {
  for (std::size_t i = 0; i < config_.plant.actuators.size(); ++i) {
    const hovercraft::PlantActuator& actuator = config_.plant.actuators[i];
    const double command =
        config_.commands[i].commandOf(levels[i], actuator.min_thrust, actuator.max_thrust);
    if (actuator.name == hovercraft::kEngineNames[0]) thrusts_.rear = command;
    if (actuator.name == hovercraft::kEngineNames[1]) thrusts_.left = command;
    if (actuator.name == hovercraft::kEngineNames[2]) thrusts_.right = command;
    levels_.values[i] = command;
  }
  thrusts_.header.stamp = levels_.header.stamp = stamp;
  if (hasEnginesOnly()) {
    answers_.publish(thrusts_);
  } else {
    answers_.publish(levels_);
  }
}

bool VelocityNode::hasEnginesOnly() const {
  return std::all_of(levels_.names.begin(), levels_.names.end(), [](const std::string& name) {
    const auto& engines = hovercraft::kEngineNames;
    return std::find(engines.begin(), engines.end(), name) != engines.end();
  });
}

}  // namespace hovercraft_ros
