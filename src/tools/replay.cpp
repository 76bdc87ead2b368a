#include "hovercraft_sim/bags/replay.h"

#include <boost/program_options.hpp>
#include <exception>
#include <iostream>

#include "hovercraft_sim/scenario/version.h"

int main(int argc, char** argv) {
  namespace po = boost::program_options;
  try {
    hovercraft_ros::ReplayRequest request;
    po::options_description options("Options");
    auto add = options.add_options();
    add("bag", po::value(&request.bag)->required(), "recording of the node, or bag of simulate");
    add("output,o", po::value(&request.output), "bag to write the run into, anew");
    add("set,s", po::value(&request.sets)->composing(),
        "KEY.PATH=VALUE: change the scenario first, such as vehicles.hovercraft.mass=6; several "
        "with ; between them");
    add("truth-odom", po::value(&request.truth_odom)->default_value(request.truth_odom),
        "in the output, the topic of the true odometry; with another name than odom, the first "
        "odometry sensor is on odom");
    add("help,h", "this text");
    add("version", "of the package, and of the physics");
    po::positional_options_description positions;
    positions.add("bag", 1);
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options).positional(positions).run(),
              values);
    if (values.count("help") > 0) {
      std::cout
          << "replay RUN.bag [--output OUT.bag] [--set KEY.PATH=VALUE ...]\n"
             "Runs again what a bag recorded and compares every state bit for bit.\n"
             "Exit status: 0 identical, 1 different or bad input, 2 not all can be checked, or\n"
             "different from what an older physics version recorded: then with the largest "
             "error.\n\n"
          << options;
      return 0;
    }
    if (values.count("version") > 0) {
      std::cout << hovercraft::versionText("replay") << '\n';
      return 0;
    }
    po::notify(values);
    std::string verdict;
    const int status = hovercraft_ros::replayBag(request, verdict);
    std::cout << verdict << '\n';
    return status;
  } catch (const std::exception& error) {
    std::cerr << "replay: " << error.what() << '\n';
    return 1;
  }
}
