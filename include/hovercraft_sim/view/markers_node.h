#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>
#include <visualization_msgs/Marker.h>

#include <geometry_msgs/PoseStamped.h>
#include <hovercraft_sim/ActuatorStatusArray.h>
#include <hovercraft_sim/Contact.h>
#include <hovercraft_sim/Cushion.h>
#include <hovercraft_sim/EngineStatus.h>
#include <hovercraft_sim/State.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/analysis/nearest_pair.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/view/craft_placer.h"
#include "hovercraft_sim/view/detail_markers.h"
#include "hovercraft_sim/view/flown_path.h"

namespace hovercraft_ros {

/// Draws every craft of a running or replayed simulation: listens to the latched scenario, then to
/// pose, engines and state of each craft, and publishes one MarkerArray for all of them. A bag
/// without states is drawn as well. On ~details it publishes what is shown only if it is asked for
/// (detail_markers.h), and on ~place it has handles by which craft are placed (CraftPlacer). The
/// frames are those of the messages: where the simulation has a tf_prefix, `engines` tells it. The
/// simulation knows nothing of it.
class HOVERCRAFT_PUBLIC MarkersNode {
 public:
  MarkersNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

 private:
  struct Craft {
    hovercraft::VehicleScenario description;
    std::string world_frame;
    hovercraft_sim::EngineStatus engines;
    hovercraft_sim::ActuatorStatusArray actuators;
    hovercraft_sim::Cushion cushion;
    FlownPath path;
    CraftMotion motion;
    geometry_msgs::PoseStamped pose;
    bool is_described = false;  // as robot_description
    std::vector<ros::Subscriber> subscribers;
  };

  void onScenario(const std_msgs::String& message);
  void watch(const hovercraft::VehicleScenario& description);
  void watchBodies();
  void hearContact(const hovercraft_sim::Contact& contact);
  void publish();
  void publishDetails();
  void showHandles();
  void describe(const Craft& craft, const std::string& prefix);
  void makeStill(const std::string& world_frame, const std::string& prefix);

  ros::NodeHandle handle_;
  ros::NodeHandle own_;
  ros::Publisher publisher_;
  ros::Publisher details_;
  ros::Subscriber scenario_subscriber_;
  ros::WallTimer timer_;
  std::vector<std::unique_ptr<Craft>> craft_;
  hovercraft::Scenario scenario_;
  std::vector<visualization_msgs::Marker> still_;
  std::string still_prefix_;  // that it was made with
  std::optional<hovercraft::NearestPairFinder> nearest_;
  std::map<std::string, geometry_msgs::Pose> bodies_;  // loose ones that were heard of
  std::vector<ros::Subscriber> world_subscribers_;
  std::vector<visualization_msgs::Marker> contacts_;  // that were not sent yet
  int contact_count_ = 0;
  std::unique_ptr<CraftPlacer> placer_;
  std::size_t ticks_ = 0;  // of the timer
};

}  // namespace hovercraft_ros
