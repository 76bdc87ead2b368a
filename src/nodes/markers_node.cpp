#include "hovercraft_sim/ros/markers_node.h"

#include <exception>

#include <ros/console.h>
#include <ros/init.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "hovercraft_markers");
  try {
    const hovercraft_ros::MarkersNode node{ros::NodeHandle(), ros::NodeHandle("~")};
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
