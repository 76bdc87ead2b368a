#pragma once

#include <vector>

#include <ros/node_handle.h>
#include <ros/service_server.h>

#include "hovercraft_sim/live/hovercraft_node.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// The services that steer a run: ~pause ~resume ~step ~reset ~set_state ~apply_wrench
/// ~set_wind ~set_actuator ~schedule ~save ~load.
/// A request that cannot be met is answered with success = false and the reason; it changes
/// nothing.
class HOVERCRAFT_PUBLIC NodeServices {
 public:
  /// @param node outlives this object.
  NodeServices(const ros::NodeHandle& private_handle, HovercraftNode& node);

 private:
  void serveTime(ros::NodeHandle& own);
  void serveEvents(ros::NodeHandle& own);
  void serveStates(ros::NodeHandle& own);

  HovercraftNode& node_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace hovercraft_ros
