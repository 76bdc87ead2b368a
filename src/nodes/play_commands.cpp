#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/ros/command_player.h"
#include "hovercraft_sim/sim/commands_csv.h"
#include "hovercraft_sim/sim/scenario_parser.h"

namespace {

constexpr double kScenarioDeadline = 30.0;  // s of wall time to wait for the simulation to appear
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

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "play_commands");
  // The last handle takes the console with it: this one is there until an error has been reported.
  const ros::NodeHandle handle;
  try {
    const ros::NodeHandle own("~");
    std::string path;
    if (!own.getParam("file", path)) {
      throw std::invalid_argument(own.resolveName("file") +
                                  ": the parameter is missing: a commands CSV");
    }
    const double settle = own.param("settle", 1.0);
    if (!(settle >= 0.0 && std::isfinite(settle))) {
      throw std::invalid_argument(own.resolveName("settle") + ": must be 0 s or more");
    }
    const int subscribers = own.param("wanted_subscribers", 1);
    if (subscribers < 1) {
      throw std::invalid_argument(own.resolveName("wanted_subscribers") + ": must be 1 or more");
    }
    const hovercraft::Scenario scenario = receiveScenario(handle);
    hovercraft_ros::CommandPlayer player(
        handle, scenario, std::make_unique<hovercraft::CsvCommandSource>(path, scenario),
        std::llround(settle * static_cast<double>(hovercraft::kNanosecondsPerSecond)),
        static_cast<std::uint32_t>(subscribers));
    while (ros::ok() && !player.isDone()) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPoll));
    }
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
