#include "hovercraft_sim/ros/hovercraft_node.h"

#include <cstdint>
#include <dynamic_reconfigure/server.h>
#include <exception>
#include <stdexcept>
#include <string>

#include <hovercraft_sim/PaceConfig.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include "hovercraft_sim/ros/node_services.h"
#include "hovercraft_sim/ros/parameters.h"
#include "hovercraft_sim/sim/version.h"

int main(int argc, char** argv) {
  if (hovercraft::answersVersion("hovercraft_node", argc, argv)) return 0;
  ros::init(argc, argv, "hovercraft_sim");
  // The last handle takes the console with it: this one is there until an error has been reported.
  const ros::NodeHandle handle;
  try {
    const ros::NodeHandle private_handle("~");
    const std::string& name = ros::this_node::getName();
    XmlRpc::XmlRpcValue parameters;
    ros::param::get(private_handle.getNamespace(), parameters);
    hovercraft_ros::HovercraftNode node(
        handle, private_handle,
        hovercraft_ros::parseNodeConfig(hovercraft_ros::parameterTree(parameters, name), name));
    const hovercraft_ros::NodeServices services(private_handle, node);
    // The server reads the parameter again, and takes a number that came as text for none.
    private_handle.setParam("real_time_factor", node.config().real_time_factor);
    // It calls back once at its start. What it is left with goes into its answers.
    dynamic_reconfigure::Server<hovercraft_sim::PaceConfig> pace(private_handle);
    pace.setCallback([&node](hovercraft_sim::PaceConfig& config, std::uint32_t /*level*/) {
      config.real_time_factor = node.changeRealTimeFactor(config.real_time_factor);
    });
    node.run();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
