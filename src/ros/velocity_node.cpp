#include "hovercraft_sim/ros/velocity_node.h"

#include <cmath>

#include <ros/console.h>
#include <ros/single_subscriber_publisher.h>
#include <ros/transport_hints.h>

#include "hovercraft_sim/ros/steady_clock.h"
#include "hovercraft_sim/sim/velocity_parameters.h"
#include "hovercraft_sim/sim/yaml_text.h"

namespace hovercraft_ros {

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
  config.timeout = reader.numberOr(config.timeout, "timeout", hovercraft::kPositive);
  return config;
}

VelocityNode::VelocityNode(ros::NodeHandle& handle, const VelocityNodeConfig& config)
    : config_(config), law_(config.plant, config.gains) {
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  // In lockstep the simulation waits for the first answer even if it came before its connection.
  const ros::SubscriberStatusCallback repeat = [this](const ros::SingleSubscriberPublisher& to) {
    if (!answer_.header.stamp.isZero()) to.publish(answer_);
  };
  thrust_ = handle.advertise<hovercraft_sim::ThrustCommand>("thrust", 10, repeat);
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
  if (!std::isfinite(wanted.u) || !std::isfinite(wanted.v) || !std::isfinite(wanted.r)) {
    if (warnings_.isDue(steadyNow())) ROS_WARN("cmd_vel: dropped: must be finite");
    return;
  }
  command_ = wanted;
  commanded_ = last_;
  has_new_command_ = true;
}

/// Time counts from the odometry that was there when the command came, or from the next one.
bool VelocityNode::isDead(const ros::Time& now) const {
  return !commanded_ || (now - *commanded_).toSec() > config_.timeout;
}

void VelocityNode::answer(const nav_msgs::Odometry& odometry) {
  const ros::Time& now = odometry.header.stamp;
  const auto& twist = odometry.twist.twist;
  if (!std::isfinite(twist.linear.x) || !std::isfinite(twist.linear.y) ||
      !std::isfinite(twist.angular.z)) {
    if (warnings_.isDue(steadyNow())) ROS_WARN("odom: dropped: must be finite");
    return;
  }
  const double dt = last_ ? (now - *last_).toSec() : 0.0;
  last_ = now;
  if (has_new_command_ && !commanded_) commanded_ = now;
  has_new_command_ = false;
  hovercraft_sim::ThrustCommand command;
  command.header.stamp = now;
  if (isDead(now) || dt < 0.0) {
    law_.reset();
  } else {
    const hovercraft::Thrusts f =
        law_.thrusts(command_, {twist.linear.x, twist.linear.y, twist.angular.z}, dt);
    command.rear = f[0];
    command.left = f[1];
    command.right = f[2];
  }
  answer_ = command;
  thrust_.publish(answer_);
}

}  // namespace hovercraft_ros
