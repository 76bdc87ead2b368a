#include "hovercraft_sim/records/simulate.h"

#include <boost/program_options.hpp>
#include <exception>
#include <iostream>
#include <unistd.h>

#include "hovercraft_sim/records/late_ros_files.h"
#include "hovercraft_sim/scenario/version.h"

namespace {

namespace po = boost::program_options;

po::options_description optionsOf(hovercraft::SimulateRequest& request) {
  po::options_description options("Options");
  auto add = options.add_options();
  add("scenario", po::value(&request.scenario)->required(), "scenario file (YAML)");
  add("commands,c", po::value(&request.commands), "commands to fly (.csv or .bag)");
  add("pilot,p", po::value(&request.pilots)->composing(),
      "manoeuvres to fly (.yaml), instead of commands; one for each craft that has a pilot");
  add("duration,d", po::value(&request.duration),
      "simulated seconds; default: to 1 s after the last command or manoeuvre");
  add("output,o", po::value(&request.output)->required(),
      "states (.csv or .bag); - is CSV on the standard output");
  add("set,s", po::value(&request.sets)->composing(),
      "KEY.PATH=VALUE: change the scenario first, such as vehicles.hovercraft.mass=6; several with "
      "; "
      "between them");
  add("contacts", po::value(&request.contacts), "contacts (.csv): bounces, sticks, rests");
  add("actuators", po::value(&request.actuators),
      "engines and other actuators (.csv): commanded, applied, faults");
  add("cushion", po::value(&request.cushion),
      "cells of cushions (.csv): pressure, gap, flow, force");
  add("sensors", po::value(&request.sensors),
      "folder for the samples of the sensors, one CSV file each: VEHICLE.SENSOR.csv");
  add("truth-odom", po::value(&request.truth_odom)->default_value(request.truth_odom),
      "in a bag, the topic of the true odometry; with another name than odom, the first odometry "
      "sensor is on odom");
  add("every,e", po::value(&request.every)->default_value(request.every),
      "put out every N-th tick");
  add("actuators-every", po::value(&request.actuators_every),
      "actuators every N-th tick; default: as --every");
  add("cushion-every", po::value(&request.cushion_every),
      "cells of cushions every N-th tick; default: as --every");
  add("hold", po::bool_switch(&request.hold), "commands hold for ever: no engine times out");
  add("help,h", "this text");
  add("version", "of the package, and of the physics");
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    hovercraft::SimulateRequest request;
    const po::options_description options = optionsOf(request);
    po::positional_options_description positions;
    positions.add("scenario", 1);
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options).positional(positions).run(),
              values);
    if (values.count("help") > 0) {
      std::cout << "simulate SCENARIO.yaml [--commands FILE | --pilot FILE] [--duration S] [--set "
                   "KEY.PATH=VALUE "
                   "...] --output FILE\n"
                   "Runs a scenario as fast as it goes and writes the states of its vehicles.\n\n"
                << options;
      return 0;
    }
    if (values.count("version") > 0) {
      std::cout << hovercraft::versionText("simulate") << '\n';
      return 0;
    }
    po::notify(values);
    request.shows_progress = isatty(STDERR_FILENO) != 0;
    hovercraft::LateRosFiles ros(HOVERCRAFT_ROS_LIBRARY);
    hovercraft::simulate(request, std::cerr, ros);
  } catch (const std::exception& error) {
    std::cerr << "simulate: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
