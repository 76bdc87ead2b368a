#include <exception>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include "hovercraft_sim/clients/velocity_node.h"
#include "hovercraft_sim/messages/parameters.h"
#include "hovercraft_sim/scenario/version.h"

int main(int argc, char** argv) {
  if (hovercraft::answersVersion("velocity_controller", argc, argv)) return 0;
  constexpr char purpose[] =
      "Turns cmd_vel into thrusts.\n"
      "roslaunch hovercraft_sim autonomy.launch starts it beside a simulation.";
  if (hovercraft::answersHelp("velocity_controller", purpose, argc, argv)) return 0;
  ros::init(argc, argv, "velocity_controller");
  ros::NodeHandle handle;
  try {
    const std::string& name = ros::this_node::getName();
    XmlRpc::XmlRpcValue parameters;
    ros::param::get(ros::NodeHandle("~").getNamespace(), parameters);
    const hovercraft_ros::VelocityNode node(
        handle, hovercraft_ros::parseVelocityNodeConfig(
                    hovercraft_ros::parameterTree(parameters, name), name));
    ros::spin();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
