#include <boost/program_options.hpp>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "hovercraft_sim/analysis/mass_report.h"
#include "hovercraft_sim/records/late_ros_files.h"
#include "hovercraft_sim/scenario/mesh_scale.h"
#include "hovercraft_sim/scenario/version.h"

namespace {

namespace po = boost::program_options;

constexpr const char* kUsage =
    "mass_properties SCENARIO.yaml [--vehicle NAME] [--json]\n"
    "mass_properties MESH [--density R | --mass M] [--scale S] [--json]\n"
    "Mass, volume, center_of_mass, inertia, principal_moments and principal_axes of the vehicles\n"
    "of a scenario, or of the homogeneous body inside a closed mesh (OBJ, STL). SI units, in the\n"
    "axes of the file: for a vehicle base_link. The inertia is the tensor about the center of\n"
    "mass, its products of inertia with a minus sign; principal_axes has one row for each moment.\n"
    "The volume of a vehicle is the sum of its parts'; unknown (null) if there are none. With\n"
    "several vehicles the JSON object is {\"vehicles\": {NAME: {...}, ...}}.\n\n";

po::options_description options() {
  po::options_description options("Options");
  auto add = options.add_options();
  add("file", po::value<std::vector<std::string>>(),
      "a scenario if it ends in .yaml or .yml, else a mesh");
  add("density,d", po::value<double>(),
      "of a mesh, kg/m^3; 1 if neither this nor the mass is given");
  add("mass,m", po::value<double>(), "of a mesh, kg");
  add("scale,s", po::value<std::vector<std::string>>()->multitoken(),
      "of the coordinates of a mesh to m, one number or three: 0.001 for millimetres");
  add("vehicle", po::value<std::string>()->default_value("", "all"), "of a scenario");
  add("json,j", po::bool_switch(), "one JSON object instead of text, numbers to the last bit");
  add("help,h", "this text");
  add("version", "of the package, and of the physics");
  return options;
}

hovercraft::MassReportRequest requestFrom(const po::variables_map& values) {
  hovercraft::MassReportRequest request;
  std::vector<std::string> files;
  if (values.count("file") > 0) files = values["file"].as<std::vector<std::string>>();
  if (values.count("scale") > 0) {
    request.scale = hovercraft::takeScale(values["scale"].as<std::vector<std::string>>(), files);
  }
  if (files.size() != 1) throw std::invalid_argument("it takes one file: a scenario or a mesh");
  request.file = files.front();
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
    positions.add("file", -1);
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options()).positional(positions).run(),
              values);
    if (values.count("help") > 0) {
      std::cout << kUsage << options();
      return 0;
    }
    if (values.count("version") > 0) {
      std::cout << hovercraft::versionText("mass_properties") << '\n';
      return 0;
    }
    po::notify(values);
    const hovercraft::MassReportRequest request = requestFrom(values);
    hovercraft::LateRosFiles ros(HOVERCRAFT_ROS_LIBRARY);
    const auto bodies = hovercraft::bodiesOf(request, [&ros](const std::string& path) {
      return hovercraft::loadScenarioFile(path, {}, ros);
    });
    for (const auto& body : bodies) {
      for (const std::string& note : body.notes) std::cerr << "mass_properties: " << note << '\n';
    }
    std::cout << (request.json ? toJson(bodies) : toText(bodies));
  } catch (const std::exception& error) {
    std::cerr << "mass_properties: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
