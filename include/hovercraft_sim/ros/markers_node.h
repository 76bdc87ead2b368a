#pragma once

#include <memory>
#include <string>
#include <vector>
#include <visualization_msgs/Marker.h>

#include <geometry_msgs/PoseStamped.h>
#include <hovercraft_sim/Cushion.h>
#include <hovercraft_sim/EngineStatus.h>
#include <hovercraft_sim/State.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/ros/flown_path.h"
#include "hovercraft_sim/sim/scenario.h"

namespace hovercraft_ros {

/// Draws every craft of a running or replayed simulation: listens to the latched scenario, then to
/// pose, engines and state of each craft, and publishes one MarkerArray for all of them. A bag
/// without states is drawn as well. The frames are those of the messages: where the simulation has
/// a tf_prefix, `engines` tells it. The simulation knows nothing of it.
class HOVERCRAFT_PUBLIC MarkersNode {
 public:
  MarkersNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

 private:
  struct Craft {
    hovercraft::VehicleScenario description;
    std::string world_frame;
    hovercraft_sim::EngineStatus engines;
    hovercraft_sim::Cushion cushion;
    FlownPath path;
    std::vector<ros::Subscriber> subscribers;
  };

  void onScenario(const std_msgs::String& message);
  void watch(const hovercraft::VehicleScenario& description);
  void publish();
  void makeStill(const std::string& world_frame, const std::string& prefix);

  ros::NodeHandle handle_;
  ros::Publisher publisher_;
  ros::Subscriber scenario_subscriber_;
  ros::WallTimer timer_;
  std::vector<std::unique_ptr<Craft>> craft_;
  hovercraft::Scenario scenario_;
  std::vector<visualization_msgs::Marker> still_;
  std::string still_prefix_;  // that it was made with
};

}  // namespace hovercraft_ros
