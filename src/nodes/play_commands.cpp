#include <csignal>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/param.h>
#include <ros/this_node.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/ros/command_player.h"
#include "hovercraft_sim/ros/parameters.h"
#include "hovercraft_sim/ros/play_config.h"
#include "hovercraft_sim/sim/commands_csv.h"
#include "hovercraft_sim/sim/scenario_parser.h"

namespace {

constexpr double kScenarioDeadline = 30.0;  // s of wall time to wait for the simulation to appear
constexpr double kStopDeadline = 15.0;      // s of wall time: roslaunch waits as long for a node
constexpr double kPoll = 0.1;               // s, how often a shutdown is looked for

hovercraft::Scenario receiveScenario(const ros::NodeHandle& handle) {
  ros::NodeHandle node(handle);
  std::string text;
  const boost::function<void(const std_msgs::String&)> on_scenario =
      [&text](const std_msgs::String& message) { text = message.data; };
  const ros::Subscriber subscriber = node.subscribe<std_msgs::String>("scenario", 1, on_scenario);
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(kScenarioDeadline);
  while (ros::ok() && text.empty() && ros::WallTime::now() < deadline) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPoll));
  }
  if (text.empty()) {
    throw std::runtime_error(
        "no scenario on " + node.resolveName("scenario") +
        ": is the simulation running, and the topic remapped to its ~scenario?");
  }
  return hovercraft::parseScenario(text, {node.resolveName("scenario"), "", {}});
}

/// Interrupts the roslaunch that started this node, as Ctrl-C does, and waits to be stopped with
/// everything else that it launched. (It would report a required node that ends as dead.)
void endLaunch() {
  kill(getppid(), SIGINT);
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(kStopDeadline);
  while (ros::ok() && ros::WallTime::now() < deadline) ros::WallDuration(kPoll).sleep();
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "play_commands");
  // The last handle takes the console with it: this one is there until an error has been reported.
  const ros::NodeHandle handle;
  try {
    const std::string& name = ros::this_node::getName();
    XmlRpc::XmlRpcValue parameters;
    ros::param::get("~", parameters);
    const hovercraft_ros::PlayConfig config =
        hovercraft_ros::parsePlayConfig(hovercraft_ros::parameterTree(parameters, name), name);
    const hovercraft::Scenario scenario = receiveScenario(handle);
    hovercraft_ros::CommandPlayer player(
        handle, scenario, std::make_unique<hovercraft::CsvCommandSource>(config.file, scenario),
        config.settle_ns, config.wanted_subscribers);
    while (ros::ok() && !player.isDone()) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPoll));
    }
    if (config.ends_launch && player.isDone()) endLaunch();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
