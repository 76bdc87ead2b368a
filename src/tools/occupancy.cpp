#include "hovercraft_sim/analysis/occupancy.h"

#include <boost/program_options.hpp>
#include <exception>
#include <iostream>
#include <string>

#include "hovercraft_sim/records/late_ros_files.h"
#include "hovercraft_sim/scenario/version.h"

namespace {

namespace po = boost::program_options;

po::options_description optionsOf(std::string& scenario, std::string& output,
                                  hovercraft::OccupancyRequest& request) {
  po::options_description options("Options");
  auto add = options.add_options();
  add("scenario", po::value(&scenario)->required(), "scenario file (YAML)");
  add("output,o", po::value(&output)->required(), "map (.yaml); its image (.pgm) lies beside it");
  add("height", po::value(&request.height)->default_value(request.height),
      "m: of the plane at which obstacles are cut");
  add("resolution,r", po::value(&request.resolution)->default_value(request.resolution),
      "m: side of a cell");
  add("margin", po::value(&request.margin)->default_value(request.margin),
      "m of free cells around the obstacles");
  add("help,h", "this text");
  add("version", "of the package, and of the physics");
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::string scenario;
    std::string output;
    hovercraft::OccupancyRequest request;
    const po::options_description options = optionsOf(scenario, output, request);
    po::positional_options_description positions;
    positions.add("scenario", 1);
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options).positional(positions).run(),
              values);
    if (values.count("help") > 0) {
      std::cout << "occupancy SCENARIO.yaml --output MAP.yaml\n"
                   "Writes the obstacles of a scenario as a map that map_server reads.\n\n"
                << options;
      return 0;
    }
    if (values.count("version") > 0) {
      std::cout << hovercraft::versionText("occupancy") << '\n';
      return 0;
    }
    po::notify(values);
    hovercraft::LateRosFiles ros(HOVERCRAFT_ROS_LIBRARY);
    hovercraft::writeMapOf(scenario, request, output, ros);
  } catch (const std::exception& error) {
    std::cerr << "occupancy: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
