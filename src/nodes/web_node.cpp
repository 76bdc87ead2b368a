#include "hovercraft_sim/web/web_node.h"

#include <exception>

#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include "hovercraft_sim/messages/parameters.h"
#include "hovercraft_sim/scenario/version.h"

int main(int argc, char** argv) {
  if (hovercraft::answersVersion("web_node", argc, argv)) return 0;
  constexpr char purpose[] =
      "Shows a simulation in the browser, and lets viewers drive it there.\n"
      "roslaunch hovercraft_sim sim.launch web:=true starts it.";
  if (hovercraft::answersHelp("web_node", purpose, argc, argv)) return 0;
  ros::init(argc, argv, "web");
  // The last handle takes the console with it: this one is there until an error has been reported.
  const ros::NodeHandle handle;
  try {
    const ros::NodeHandle own("~");
    const std::string& name = ros::this_node::getName();
    XmlRpc::XmlRpcValue parameters;
    ros::param::get(own.getNamespace(), parameters);
    const hovercraft_ros::WebConfig config =
        hovercraft_ros::parseWebConfig(hovercraft_ros::parameterTree(parameters, name), name);
    hovercraft_ros::WebNode node(handle, config);
    // For a port that was chosen here.
    own.setParam("bound_port", node.port());
    ROS_INFO("%s shows the simulation", hovercraft_ros::urlOf(config, node.port()).c_str());
    node.run();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
