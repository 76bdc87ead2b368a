#include <boost/program_options.hpp>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "hovercraft_sim/analysis/hover_report.h"
#include "hovercraft_sim/records/late_ros_files.h"
#include "hovercraft_sim/scenario/version.h"

namespace {

namespace po = boost::program_options;

constexpr const char* kUsage =
    "cushion SCENARIO.yaml [--vehicle NAME] [--set KEY.PATH=VALUE ...] [--json]\n"
    "How the craft of a scenario hover over level ground: gap, pressure, flow, power, trim; of\n"
    "heave, pitch and roll frequency, damping ratio, margin of stability (below 3 its air swings\n"
    "by itself) and the longest step with which each integrator lets it decay. SI units.\n\n";

po::options_description options() {
  po::options_description options("Options");
  auto add = options.add_options();
  add("scenario", po::value<std::string>()->required(), "scenario file (YAML)");
  add("vehicle", po::value<std::string>()->default_value("", "all"), "only this one");
  add("set,s", po::value<std::vector<std::string>>()->composing(),
      "KEY.PATH=VALUE: change the scenario first");
  add("json,j", po::bool_switch(), "one JSON object instead of text, numbers to the last bit");
  add("help,h", "this text");
  add("version", "of the package, and of the physics");
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    po::positional_options_description positions;
    positions.add("scenario", 1);
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(options()).positional(positions).run(),
              values);
    if (values.count("help") > 0) {
      std::cout << kUsage << options();
      return 0;
    }
    if (values.count("version") > 0) {
      std::cout << hovercraft::versionText("cushion") << '\n';
      return 0;
    }
    po::notify(values);
    hovercraft::LateRosFiles ros(HOVERCRAFT_ROS_LIBRARY);
    std::vector<std::string> sets;
    if (values.count("set") > 0) sets = values["set"].as<std::vector<std::string>>();
    const hovercraft::Scenario scenario =
        hovercraft::loadScenarioFile(values["scenario"].as<std::string>(), {"--set", sets}, ros);
    const auto reports = hovercraft::hoverReports(scenario, values["vehicle"].as<std::string>());
    std::cout << (values["json"].as<bool>() ? toJson(reports) : toText(reports));
  } catch (const std::exception& error) {
    std::cerr << "cushion: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
