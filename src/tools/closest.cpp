// closest A B [--pose-a x y z qx qy qz qw] [--pose-b ...] [--hull] [--json]: the closest features
// of two convex meshes.
#include <boost/program_options.hpp>
#include <cmath>
#include <fmt/format.h>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/geometry/triangle_mesh.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/tolerances.h"

namespace {

using hovercraft::ClosestFeatures;
using hovercraft::ConvexPolyhedron;
using hovercraft::Feature;
using hovercraft::Pose;
using hovercraft::Vector3;

namespace options = boost::program_options;

/// @param numbers x y z (m), qx qy qz qw; empty: the identity.
Pose poseFrom(const std::vector<double>& numbers, const std::string& key) {
  if (numbers.empty()) return {};
  if (numbers.size() != 7) {
    throw std::invalid_argument(
        fmt::format("--{}: {} numbers, it takes 7: x y z (m) qx qy qz qw", key, numbers.size()));
  }
  const hovercraft::Quaternion q{numbers[6], {numbers[3], numbers[4], numbers[5]}};
  const Vector3 p(numbers[0], numbers[1], numbers[2]);
  if (!p.allFinite()) throw std::invalid_argument("--" + key + ": the position is not finite");
  if (!(std::abs(norm(q) - 1.0) <= hovercraft::kUnitLength)) {
    throw std::invalid_argument(
        fmt::format("--{}: the quaternion has the length {}, it must be 1", key, norm(q)));
  }
  return {rotationMatrix(normalized(q)), p};
}

const char* statusName(hovercraft::Proximity status) {
  switch (status) {
    case hovercraft::Proximity::kSeparated:
      return "separated";
    case hovercraft::Proximity::kTouching:
      return "touching";
    case hovercraft::Proximity::kPenetrating:
      return "penetrating";
    case hovercraft::Proximity::kStepLimit:
      break;
  }
  throw std::runtime_error("the bound on the number of steps was reached: no answer");
}

const char* kindName(const Feature& feature) {
  if (feature.kind == hovercraft::FeatureKind::kVertex) return "vertex";
  return feature.kind == hovercraft::FeatureKind::kEdge ? "edge" : "face";
}

struct Body {
  hovercraft::TriangleMesh mesh;
  ConvexPolyhedron polyhedron;

  Body(const std::string& path, hovercraft::NonConvexMesh choice)
      : mesh(hovercraft::loadTriangleMesh(path)),
        polyhedron(hovercraft::polyhedronFromMesh(mesh, choice, "mesh file '" + path + "'")) {}

  /// The vertices of a feature, counted from 0 in the order of their first use in the file.
  std::string vertices(const Feature& feature) const {
    std::string text;
    for (const std::int32_t v : polyhedron.verticesOf(feature)) {
      std::size_t i = 0;
      while (mesh.vertices[i] != polyhedron.vertex(v)) ++i;
      text += fmt::format("{}{}", text.empty() ? "" : ", ", i);
    }
    return text;
  }
};

void printJson(const Body& A, const Body& B, const ClosestFeatures& c) {
  const auto vector = [](const Vector3& v) {
    return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
  };
  const auto feature = [](const Body& body, const Feature& f) {
    return fmt::format("{{\"type\": \"{}\", \"vertices\": [{}]}}", kindName(f), body.vertices(f));
  };
  fmt::print(
      "{{\"status\": \"{}\", \"distance\": {}, \"point_a\": {}, \"point_b\": {}, \"normal\": {}, "
      "\"feature_a\": {}, \"feature_b\": {}, \"steps\": {}}}\n",
      statusName(c.status), c.distance, vector(c.p_WCa), vector(c.p_WCb), vector(c.nhat_AB_W),
      feature(A, c.feature_a), feature(B, c.feature_b), c.steps);
}

void printText(const Body& A, const Body& B, const ClosestFeatures& c) {
  const auto line = [](const char* name, const Vector3& v) {
    fmt::print("{:<10} {} {} {}\n", name, v.x(), v.y(), v.z());
  };
  fmt::print("{:<10} {}\n{:<10} {} m\n", "status", statusName(c.status), "distance", c.distance);
  line("point_a", c.p_WCa);
  line("point_b", c.p_WCb);
  line("normal", c.nhat_AB_W);
  fmt::print("{:<10} {} {}\n", "feature_a", kindName(c.feature_a), A.vertices(c.feature_a));
  fmt::print("{:<10} {} {}\n", "feature_b", kindName(c.feature_b), B.vertices(c.feature_b));
  fmt::print("{:<10} {}\n", "steps", c.steps);
}

int run(int argc, char** argv) {
  std::vector<std::string> meshes;
  std::vector<double> pose_a;
  std::vector<double> pose_b;
  options::options_description visible(
      "closest A B [--pose-a x y z qx qy qz qw] [--pose-b ...]: closest features of two convex "
      "meshes (m)");
  visible.add_options()("help", "this text")("pose-a", options::value(&pose_a)->multitoken(),
                                             "pose of A in the world, identity")(
      "pose-b", options::value(&pose_b)->multitoken(), "pose of B in the world, identity")(
      "hull", "take the convex hull of a mesh that is not convex")("json", "one JSON object");
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
  if (meshes.size() != 2) throw std::invalid_argument("it takes two mesh files");
  const auto choice = arguments.count("hull") != 0 ? hovercraft::NonConvexMesh::kTakeHull
                                                   : hovercraft::NonConvexMesh::kRefuse;
  const Body A(meshes[0], choice);
  const Body B(meshes[1], choice);
  hovercraft::FeaturePair last;
  const ClosestFeatures c = closestFeatures(A.polyhedron, poseFrom(pose_a, "pose-a"), B.polyhedron,
                                            poseFrom(pose_b, "pose-b"), last);
  if (arguments.count("json") != 0) {
    printJson(A, B, c);
  } else {
    printText(A, B, c);
  }
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
