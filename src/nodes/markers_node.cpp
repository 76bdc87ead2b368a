#include "hovercraft_sim/view/markers_node.h"

#include <exception>

#include <ros/console.h>
#include <ros/init.h>

#include "hovercraft_sim/scenario/version.h"

int main(int argc, char** argv) {
  if (hovercraft::answersVersion("markers_node", argc, argv)) return 0;
  constexpr char purpose[] =
      "Draws the craft and their world for RViz.\n"
      "roslaunch hovercraft_sim sim.launch rviz:=true starts it.";
  if (hovercraft::answersHelp("markers_node", purpose, argc, argv)) return 0;
  ros::init(argc, argv, "hovercraft_markers");
  // The last handle takes the console with it: this one is there until an error has been reported.
  const ros::NodeHandle handle;
  try {
    const hovercraft_ros::MarkersNode node{handle, ros::NodeHandle("~")};
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
