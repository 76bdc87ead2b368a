#include <exception>
#include <memory>
#include <string>

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/param.h>
#include <ros/this_node.h>

#include "hovercraft_sim/clients/command_player.h"
#include "hovercraft_sim/clients/play_config.h"
#include "hovercraft_sim/clients/received_scenario.h"
#include "hovercraft_sim/messages/parameters.h"
#include "hovercraft_sim/records/commands_csv.h"
#include "hovercraft_sim/scenario/version.h"

namespace {

constexpr double kPoll = 0.1;  // s, how often a shutdown is looked for

}  // namespace

int main(int argc, char** argv) {
  if (hovercraft::answersVersion("play_commands", argc, argv)) return 0;
  constexpr char purpose[] =
      "Publishes the commands of a CSV file when their ticks come.\n"
      "roslaunch hovercraft_sim demo.launch starts it beside a simulation.";
  if (hovercraft::answersHelp("play_commands", purpose, argc, argv)) return 0;
  ros::init(argc, argv, "play_commands");
  // The last handle takes the console with it: this one is there until an error has been reported.
  const ros::NodeHandle handle;
  try {
    const std::string& name = ros::this_node::getName();
    XmlRpc::XmlRpcValue parameters;
    ros::param::get("~", parameters);
    const hovercraft_ros::PlayConfig config =
        hovercraft_ros::parsePlayConfig(hovercraft_ros::parameterTree(parameters, name), name);
    const hovercraft::Scenario scenario = hovercraft_ros::receiveScenario(handle, "scenario");
    hovercraft_ros::CommandPlayer player(
        handle, scenario, std::make_unique<hovercraft::CsvCommandSource>(config.file, scenario),
        config.settle_ns, config.wanted_subscribers);
    while (ros::ok() && !player.isDone()) {
      ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPoll));
    }
    if (config.ends_launch && player.isDone()) hovercraft_ros::endLaunch();
  } catch (const std::exception& error) {
    ROS_FATAL("%s", error.what());
    return 1;
  }
  return 0;
}
