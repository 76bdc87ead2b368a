#include <boost/program_options.hpp>
#include <exception>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>
#include <ros/node_handle.h>

#include "hovercraft_sim/clients/pilot_node.h"
#include "hovercraft_sim/clients/received_scenario.h"
#include "hovercraft_sim/scenario/pilot_parser.h"
#include "hovercraft_sim/scenario/version.h"

namespace {

constexpr double kPoll = 0.1;  // s, how often a shutdown is looked for

/// The file that is flown; nothing if only help or the version was asked for.
std::optional<std::string> fileOf(int argc, char** argv) {
  namespace po = boost::program_options;
  std::string file;
  po::options_description options("Options");
  auto add = options.add_options();
  add("file", po::value(&file)->required(), "manoeuvres (YAML): doc/manoeuvres.md");
  add("help,h", "this text");
  add("version", "of the package, and of the physics");
  po::positional_options_description positions;
  positions.add("file", 1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(options).positional(positions).run(),
            values);
  if (values.count("help") > 0) {
    std::cout << "pilot FILE.yaml [hovercraft_sim/scenario:=SCENARIO_TOPIC]\n"
                 "Flies manoeuvres with a craft of a simulation that runs, and says what they came "
                 "to.\nWithout ROS running: simulate SCENARIO.yaml --pilot FILE.yaml\n\n"
              << options;
    return std::nullopt;
  }
  if (values.count("version") > 0) {
    std::cout << hovercraft::versionText("pilot") << '\n';
    return std::nullopt;
  }
  po::notify(values);
  if (file.empty()) throw std::invalid_argument("FILE.yaml: the name must not be empty");
  return file;
}

/// Flies until the plan is over or the node is stopped. @returns whether all of it was flown.
bool fly(const ros::NodeHandle& handle, const std::string& file) {
  const hovercraft::Scenario scenario =
      hovercraft_ros::receiveScenario(handle, "hovercraft_sim/scenario");
  hovercraft_ros::PilotNode node(handle, scenario, hovercraft::loadPilot(file, scenario));
  std::size_t told = 0;
  const auto tell = [&] {
    for (; told < node.pilot().flown().size(); ++told) {
      std::cout << hovercraft::toText(node.pilot().flown()[told]) << std::flush;
    }
  };
  while (ros::ok() && !node.isDone()) {
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPoll));
    node.watchPublisher();
    tell();
  }
  // roscpp sends from a thread of its own: what was published last is to go before this ends.
  if (ros::ok()) ros::WallDuration(kPoll).sleep();
  return node.isDone() && node.pilot().isOver();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    // Of two nodes of one name the first is shut down; __name:= still names this one.
    ros::init(argc, argv, "pilot", ros::init_options::AnonymousName);
    const auto file = fileOf(argc, argv);
    if (!file) return 0;
    // The last handle takes the console with it: this one is there until an error was reported.
    const ros::NodeHandle handle;
    try {
      if (fly(handle, *file)) return 0;
      std::cerr << "pilot: the run ended, or began anew, before the last manoeuvre did\n";
    } catch (const std::exception& error) {
      ROS_FATAL("%s", error.what());
    }
  } catch (const std::exception& error) {
    std::cerr << "pilot: " << error.what() << '\n';
  }
  return 1;
}
