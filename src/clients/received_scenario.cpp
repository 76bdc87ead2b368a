#include "hovercraft_sim/clients/received_scenario.h"

#include <csignal>
#include <stdexcept>
#include <unistd.h>

#include <ros/callback_queue.h>
#include <ros/init.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/scenario/scenario_parser.h"

namespace hovercraft_ros {
namespace {

constexpr double kScenarioDeadline = 30.0;  // s of wall time to wait for the simulation to appear
constexpr double kStopDeadline = 15.0;      // s of wall time: roslaunch waits as long for a node
constexpr double kShutdownPoll = 0.1;       // s, how often a shutdown is looked for

}  // namespace

hovercraft::Scenario receiveScenario(const ros::NodeHandle& handle, const std::string& topic) {
  ros::NodeHandle node(handle);
  std::string text;
  const boost::function<void(const std_msgs::String&)> on_scenario =
      [&text](const std_msgs::String& message) { text = message.data; };
  const ros::Subscriber subscriber = node.subscribe<std_msgs::String>(topic, 1, on_scenario);
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(kScenarioDeadline);
  while (ros::ok() && text.empty() && ros::WallTime::now() < deadline) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kShutdownPoll));
  }
  if (text.empty()) {
    throw std::runtime_error(
        "no scenario on " + node.resolveName(topic) +
        ": is the simulation running, and the topic remapped to its ~scenario?");
  }
  return hovercraft::parseScenario(text, {node.resolveName(topic), "", {}});
}

void endLaunch() {
  kill(getppid(), SIGINT);
  const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(kStopDeadline);
  while (ros::ok() && ros::WallTime::now() < deadline) ros::WallDuration(kShutdownPoll).sleep();
}

}  // namespace hovercraft_ros
