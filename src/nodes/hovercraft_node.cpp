#include "hovercraft_sim/live/hovercraft_node.h"

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <dynamic_reconfigure/server.h>
#include <exception>
#include <stdexcept>
#include <string>

#include <hovercraft_sim/PaceConfig.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include "hovercraft_sim/live/leave_graph.h"
#include "hovercraft_sim/live/node_services.h"
#include "hovercraft_sim/messages/parameters.h"
#include "hovercraft_sim/scenario/version.h"

namespace {

/// What a shutdown of roscpp does for others, without what takes it seconds with many craft. A
/// second SIGINT ends it, should the master not answer.
[[noreturn]] void endAtOnce() {
  std::signal(SIGINT, SIG_DFL);
  hovercraft_ros::leaveGraph();
  std::fflush(nullptr);
  std::_Exit(0);
}

}  // namespace

int main(int argc, char** argv) {
  if (hovercraft::answersVersion("hovercraft_node", argc, argv)) return 0;
  constexpr char purpose[] =
      "The simulation, in real time, slower, faster or in lockstep.\n"
      "roslaunch hovercraft_sim sim.launch starts it.";
  if (hovercraft::answersHelp("hovercraft_node", purpose, argc, argv)) return 0;
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
    // Until here SIGINT is roscpp's, which gives up waiting for a master.
    std::signal(SIGINT, [](int /*signal*/) { hovercraft_ros::HovercraftNode::stop(); });
    node.run();
    if (!ros::isShuttingDown()) endAtOnce();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
