#include <boost/program_options.hpp>
#include <exception>
#include <iostream>

#include "hovercraft_sim/ros/simulate.h"
#include "hovercraft_sim/sim/mass_report.h"

namespace {

namespace po = boost::program_options;

constexpr const char* kUsage =
    "mass_properties SCENARIO.yaml [--vehicle NAME] [--json]\n"
    "mass_properties MESH [--density R | --mass M] [--json]\n"
    "Mass, volume, center_of_mass, inertia, principal_moments and principal_axes of the vehicles\n"
    "of a scenario, or of the homogeneous body inside a closed mesh (OBJ, STL). SI units, in the\n"
    "axes of the file: for a vehicle base_link. The inertia is the tensor about the center of\n"
    "mass, its products of inertia with a minus sign; principal_axes has one row for each moment.\n"
    "The volume of a vehicle is the sum of its parts'; unknown (null) if there are none. With\n"
    "several vehicles the JSON object is {\"vehicles\": {NAME: {...}, ...}}.\n\n";

po::options_description options() {
  po::options_description options("Options");
  auto add = options.add_options();
  add("file", po::value<std::string>()->required(),
      "a scenario if it ends in .yaml or .yml, else a mesh");
  add("density,d", po::value<double>(),
      "of a mesh, kg/m^3; 1 if neither this nor the mass is given");
  add("mass,m", po::value<double>(), "of a mesh, kg");
  add("vehicle", po::value<std::string>()->default_value("", "all"), "of a scenario");
  add("json,j", po::bool_switch(), "one JSON object instead of text, numbers to the last bit");
  add("help,h", "this text");
  return options;
}

hovercraft::MassReportRequest requestFrom(const po::variables_map& values) {
  hovercraft::MassReportRequest request;
  request.file = values["file"].as<std::string>();
  if (values.count("density") > 0) request.density = values["density"].as<double>();
  if (values.count("mass") > 0) request.mass = values["mass"].as<double>();
  request.vehicle = values["vehicle"].as<std::string>();
  request.json = values["json"].as<bool>();
  return request;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    po::positional_options_description positions;
    positions.add("file", 1);
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options()).positional(positions).run(),
              values);
    if (values.count("help") > 0) {
      std::cout << kUsage << options();
      return 0;
    }
    po::notify(values);
    const hovercraft::MassReportRequest request = requestFrom(values);
    const auto bodies = hovercraft::bodiesOf(
        request, [](const std::string& path) { return hovercraft_ros::loadScenarioFile(path); });
    std::cout << (request.json ? toJson(bodies) : toText(bodies));
  } catch (const std::exception& error) {
    std::cerr << "mass_properties: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
