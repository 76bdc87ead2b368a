#include <boost/program_options.hpp>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>

#include "hovercraft_sim/records/late_ros_files.h"
#include "hovercraft_sim/scenario/velocity_parameters.h"
#include "hovercraft_sim/scenario/version.h"

namespace {

namespace po = boost::program_options;

const hovercraft::VehicleScenario& vehicleOf(const hovercraft::Scenario& scenario,
                                             const std::string& name) {
  if (name.empty()) return scenario.vehicles.front();
  for (const hovercraft::VehicleScenario& vehicle : scenario.vehicles) {
    if (vehicle.name == name) return vehicle;
  }
  throw std::invalid_argument("--vehicle = " + name + ": the scenario has none of that name");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::string scenario;
    std::string vehicle;
    po::options_description options("Options");
    auto add = options.add_options();
    add("scenario", po::value(&scenario)->required(), "scenario file (YAML)");
    add("vehicle", po::value(&vehicle), "the craft; default: the first one by name");
    add("help,h", "this text");
    add("version", "of the package, and of the physics");
    po::positional_options_description positions;
    positions.add("scenario", 1);
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options).positional(positions).run(),
              values);
    if (values.count("help") > 0) {
      std::cout << "velocity_gains SCENARIO.yaml [--vehicle NAME]\n"
                   "Prints the parameters of velocity_controller for a craft, as YAML.\n\n"
                << options;
      return 0;
    }
    if (values.count("version") > 0) {
      std::cout << hovercraft::versionText("velocity_gains") << '\n';
      return 0;
    }
    po::notify(values);
    hovercraft::LateRosFiles ros(HOVERCRAFT_ROS_LIBRARY);
    const hovercraft::Scenario loaded = hovercraft::loadScenarioFile(scenario, {}, ros);
    std::cout << hovercraft::velocityYaml(
        hovercraft::velocityParametersOf(vehicleOf(loaded, vehicle)), scenario);
  } catch (const std::exception& error) {
    std::cerr << "velocity_gains: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
