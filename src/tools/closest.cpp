// closest A B [--pose-a x y z qx qy qz qw] [--pose-b ...] [--scale s]
// [--hull] [--json]: the closest features of two convex meshes.
#include <boost/program_options.hpp>
#include <exception>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "hovercraft_sim/analysis/closest_report.h"
#include "hovercraft_sim/scenario/mesh_scale.h"
#include "hovercraft_sim/scenario/version.h"

namespace {

namespace options = boost::program_options;

int run(int argc, char** argv) {
  hovercraft::ClosestRequest request;
  std::vector<std::string> meshes;
  std::vector<std::string> scale;
  options::options_description visible(
      "closest A B [--pose-a x y z qx qy qz qw] [--pose-b ...]: closest features of two convex "
      "meshes (OBJ, STL; m)");
  visible.add_options()("help", "this text")("version", "of the package, and of the physics")(
      "pose-a", options::value(&request.pose_a)->multitoken(), "pose of A in the world, identity")(
      "pose-b", options::value(&request.pose_b)->multitoken(), "pose of B in the world, identity")(
      "scale", options::value(&scale)->multitoken(),
      "of the coordinates of both meshes to m, one number or three: 0.001 for millimetres")(
      "hull", options::bool_switch(&request.hull),
      "take the convex hull of a mesh that is not convex, or open")(
      "json", options::bool_switch(&request.json), "one JSON object");
  options::options_description all;
  all.add(visible).add_options()("mesh", options::value(&meshes));
  options::positional_options_description positional;
  positional.add("mesh", 2);
  // Without short options, so that -0.5 is a number.
  const int style = options::command_line_style::allow_long |
                    options::command_line_style::long_allow_adjacent |
                    options::command_line_style::long_allow_next;
  options::command_line_parser parser(argc, argv);
  options::variables_map arguments;
  options::store(parser.options(all).positional(positional).style(style).run(), arguments);
  options::notify(arguments);
  if (arguments.count("help") != 0) {
    std::cout << visible;
    return 0;
  }
  if (arguments.count("version") != 0) {
    std::cout << hovercraft::versionText("closest") << '\n';
    return 0;
  }
  if (!scale.empty()) request.scale = hovercraft::takeScale(scale, meshes);
  if (meshes.size() != 2) throw std::invalid_argument("it takes two mesh files");
  request.mesh_a = meshes[0];
  request.mesh_b = meshes[1];
  std::vector<std::string> notes;
  const std::string report = hovercraft::closestReport(request, &notes);
  for (const std::string& note : notes) std::cerr << "closest: " << note << "\n";
  std::cout << report;
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "closest: " << error.what() << "\n";
    return 1;
  }
}
