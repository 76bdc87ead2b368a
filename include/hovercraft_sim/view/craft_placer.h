#pragma once

#include <interactive_markers/interactive_marker_server.h>
#include <map>
#include <string>

#include <geometry_msgs/Pose.h>
#include <ros/node_handle.h>
#include <ros/service_client.h>
#include <ros/time.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft_ros {

/// The pose that a craft can have in a model: of a planar one height, roll and pitch stay those of
/// `now`; the quaternion gets the length 1. @param wanted finite, its quaternion not 0.
HOVERCRAFT_PUBLIC geometry_msgs::Pose fittingPose(const geometry_msgs::Pose& wanted,
                                                  const geometry_msgs::Pose& now,
                                                  hovercraft::BodyModel model);

/// Handles in RViz by which craft are placed: interactive markers, named as the craft. When one is
/// let go, the craft is put there, at rest, by the simulation's service ~set_state, paused or not.
class HOVERCRAFT_PUBLIC CraftPlacer {
 public:
  /// @param own its topics are those of `own`/place. @param set_state name of the service.
  CraftPlacer(const ros::NodeHandle& own, const hovercraft::Scenario& scenario,
              const std::string& set_state);

  /// A handle goes with its craft, unless it is held. @param pose of base_link in the world.
  void show(const std::string& craft, const std::string& world_frame,
            const geometry_msgs::Pose& pose);
  /// Sends what was shown.
  void apply();

 private:
  using Feedback = visualization_msgs::InteractiveMarkerFeedbackConstPtr;
  struct Handle {
    geometry_msgs::Pose pose;  // of its craft
    std::string world_frame;
    bool is_there = false;
    ros::WallTime held_until;  // RViz says now and then that it holds one
    geometry_msgs::Pose shown;
  };

  void take(const Feedback& feedback);
  void place(const std::string& craft, const Handle& handle, const geometry_msgs::Pose& wanted);
  void insert(const std::string& craft, const Handle& handle);

  hovercraft::BodyModel model_;
  std::map<std::string, Handle> handles_;
  bool has_changed_ = false;
  ros::ServiceClient set_state_;
  interactive_markers::InteractiveMarkerServer server_;
};

}  // namespace hovercraft_ros
