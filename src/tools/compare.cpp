#include "hovercraft_sim/analysis/compare.h"

#include <boost/program_options.hpp>
#include <exception>
#include <iostream>

#include "hovercraft_sim/bags/trajectory_file.h"
#include "hovercraft_sim/io/output_file.h"
#include "hovercraft_sim/scenario/version.h"

namespace {

namespace po = boost::program_options;

struct Request {
  std::string a;
  std::string b;
  std::string vehicle;
  std::string errors;
  hovercraft::CompareOptions options;
};

/// @returns false if only the help or the version was asked for.
bool parse(int argc, char** argv, Request& request) {
  bool common = false;
  bool interpolate = false;
  double position = 0.0;
  double attitude = 0.0;
  po::options_description options("Options");
  auto add = options.add_options();
  add("a", po::value(&request.a)->required(), "reference (.csv or .bag)");
  add("b", po::value(&request.b)->required(), "what is compared with it");
  add("tolerance,t", po::value(&position), "allowed position error, m");
  add("attitude-tolerance,r", po::value(&attitude), "allowed attitude error, rad");
  add("relative", po::bool_switch(&request.options.relative),
      "judge what is left without the difference of the first poses");
  add("common", po::bool_switch(&common), "pass over times that only one of them has");
  add("interpolate", po::bool_switch(&interpolate), "interpolate B at the times of A");
  add("from-start", po::bool_switch(&request.options.from_start),
      "count times from the first sample of each");
  add("vehicle", po::value(&request.vehicle), "only this one");
  add("errors", po::value(&request.errors), "write the errors over time as CSV; needs one vehicle");
  add("help,h", "this text");
  add("version", "of the package, and of the physics");
  po::positional_options_description positions;
  positions.add("a", 1).add("b", 1);
  po::variables_map values;
  po::store(po::command_line_parser(argc, argv).options(options).positional(positions).run(),
            values);
  if (values.count("help") > 0) {
    std::cout << "compare A B [--tolerance M] [--attitude-tolerance RAD]\n"
                 "Compares two trajectories. Exit status 0 if they agree: within the tolerances "
                 "that are\ngiven, or to the last bit if none is.\n\n"
              << options;
    return false;
  }
  if (values.count("version") > 0) {
    std::cout << hovercraft::versionText("compare") << '\n';
    return false;
  }
  po::notify(values);
  if (common && interpolate) throw po::error("--common and --interpolate exclude each other");
  if (common) request.options.matching = hovercraft::SampleMatching::kCommon;
  if (interpolate) request.options.matching = hovercraft::SampleMatching::kInterpolated;
  if (values.count("tolerance") > 0) request.options.position_tolerance = position;
  if (values.count("attitude-tolerance") > 0) request.options.attitude_tolerance = attitude;
  return true;
}

void writeErrors(const std::string& path, const hovercraft::Comparison& comparison) {
  const std::string text = errorsCsv(comparison);
  hovercraft::OutputFile file(path);
  file.write(text.data(), text.size());
  file.close();
}

/// @returns whether all agree.
bool compare(const Request& request) {
  hovercraft::checkOutputs({{"--errors", request.errors}}, {request.a, request.b});
  const auto a = hovercraft_ros::readTrajectories(request.a);
  const auto b = hovercraft_ros::readTrajectories(request.b);
  const auto pairs = hovercraft::pairByVehicle(a, b, request.vehicle);
  if (!request.errors.empty() && pairs.size() > 1) {
    throw std::invalid_argument("--errors needs one vehicle: choose it with --vehicle");
  }
  bool all_within = true;
  for (const hovercraft::TrajectoryPair& pair : pairs) {
    const hovercraft::Comparison comparison =
        compareTrajectories(*pair.a, *pair.b, request.options);
    std::cout << "A: " << pair.a->source << "\nB: " << pair.b->source << '\n'
              << toText(comparison, request.options);
    if (!request.errors.empty()) writeErrors(request.errors, comparison);
    all_within = all_within && comparison.is_within;
  }
  return all_within;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    Request request;
    if (!parse(argc, argv, request)) return 0;
    return compare(request) ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << "compare: " << error.what() << '\n';
    return 1;
  }
}
