#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <geometry_msgs/Twist.h>
#include <hovercraft_sim/ActuatorCommand.h>
#include <hovercraft_sim/ThrustCommand.h>
#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include "hovercraft_sim/control/velocity_law.h"
#include "hovercraft_sim/hovercraft/command_map.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/pacing/warning_limiter.h"
#include "hovercraft_sim/scenario/config_node.h"

namespace hovercraft_ros {

struct VelocityNodeConfig {
  hovercraft::VelocityPlant plant;
  hovercraft::VelocityGains gains;
  std::vector<hovercraft::CommandMap> commands;  // of each actuator of the plant
  double timeout = 0.5;  // s of the odometry's time since the last cmd_vel; then thrusts are 0
};

/// @param parameters the node's private namespace: `parameters`, the text of a file of
/// velocity_gains, and `timeout`. @param node_name begins every error.
/// @throws std::invalid_argument that names the parameter, its value and the rule.
HOVERCRAFT_PUBLIC VelocityNodeConfig
parseVelocityNodeConfig(const hovercraft::ConfigNode& parameters, const std::string& node_name);

/// From `cmd_vel` (geometry_msgs/Twist: m/s, rad/s) and `odom` (nav_msgs/Odometry, twist of
/// base_link in its own axes) to `thrust`: each odometry is answered by one ThrustCommand with its
/// stamp, so that it works in lockstep; of a craft with other actuators than the three engines by
/// one ActuatorCommand on `actuator_command`. Time is that of the stamps. No command for `timeout`
/// of it: thrusts 0, and likewise where that time goes back. A message with a number that is not
/// finite, or beyond what any craft does (1,000 m/s or rad/s), is dropped and warned about.
class HOVERCRAFT_PUBLIC VelocityNode {
 public:
  VelocityNode(ros::NodeHandle& handle, const VelocityNodeConfig& config);
  VelocityNode(const VelocityNode&) = delete;
  VelocityNode& operator=(const VelocityNode&) = delete;

 private:
  void take(const geometry_msgs::Twist& command);
  void answer(const nav_msgs::Odometry& odometry);
  void answer(const ros::Time& stamp, const hovercraft::Thrusts& levels);
  bool hasEnginesOnly() const;
  bool isDead(std::int64_t now_ns) const;

  VelocityNodeConfig config_;
  hovercraft::VelocityLaw law_;
  hovercraft::PlanarVelocity command_;
  std::optional<std::int64_t> last_ns_;       // stamp of the last odometry
  std::optional<std::int64_t> commanded_ns_;  // of that after which the last command came
  bool has_new_command_ = false;
  hovercraft_sim::ThrustCommand thrusts_;   // the last answer, of a craft with engines only
  hovercraft_sim::ActuatorCommand levels_;  // of all others
  hovercraft::WarningLimiter warnings_;
  ros::Publisher answers_;
  ros::Subscriber commands_;
  ros::Subscriber odometry_;
};

}  // namespace hovercraft_ros
