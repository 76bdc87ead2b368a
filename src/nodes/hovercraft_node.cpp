#include "hovercraft_sim/ros/hovercraft_node.h"

#include <cstdint>
#include <dynamic_reconfigure/server.h>
#include <exception>
#include <stdexcept>

#include <hovercraft_sim/PaceConfig.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include "hovercraft_sim/ros/node_services.h"
#include "hovercraft_sim/ros/parameters.h"

int main(int argc, char** argv) {
  ros::init(argc, argv, "hovercraft_sim");
  // The last handle takes the console with it: this one is there until an error has been reported.
  const ros::NodeHandle handle;
  try {
    const ros::NodeHandle private_handle("~");
    XmlRpc::XmlRpcValue parameters;
    ros::param::get(private_handle.getNamespace(), parameters);
    hovercraft_ros::HovercraftNode node(
        handle, private_handle,
        hovercraft_ros::parseNodeConfig(hovercraft_ros::toYaml(parameters),
                                        ros::this_node::getName()));
    const hovercraft_ros::NodeServices services(private_handle, node);
    // The server calls back once at its start, with the parameter of the node.
    dynamic_reconfigure::Server<hovercraft_sim::PaceConfig> pace(private_handle);
    pace.setCallback([&node](const hovercraft_sim::PaceConfig& config, std::uint32_t /*level*/) {
      node.setRealTimeFactor(config.real_time_factor);
    });
    node.run();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
