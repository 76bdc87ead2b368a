#include "hovercraft_sim/analysis/closest_report.h"

#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/collision/closest_features.h"
#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

/// @param numbers x y z (m), qx qy qz qw; empty: the identity.
Pose poseFrom(const std::vector<double>& numbers, const std::string& key) {
  if (numbers.empty()) return {};
  if (numbers.size() != 7) {
    throw std::invalid_argument(
        fmt::format("--{}: {} numbers, it takes 7: x y z (m) qx qy qz qw", key, numbers.size()));
  }
  const Quaternion q{numbers[6], {numbers[3], numbers[4], numbers[5]}};
  const Vector3 p(numbers[0], numbers[1], numbers[2]);
  if (!(p.cwiseAbs().maxCoeff() <= kFarthest)) {
    throw std::invalid_argument(
        fmt::format("--{}: x, y, z = {}, {}, {}: each must be a number from -{:.0e} to {:.0e} m",
                    key, p.x(), p.y(), p.z(), kFarthest, kFarthest));
  }
  if (!(std::abs(norm(q) - 1.0) <= kUnitLength)) {
    throw std::invalid_argument(
        fmt::format("--{}: the quaternion has the length {}, it must be 1", key, norm(q)));
  }
  return {rotationMatrix(normalized(q)), p};
}

const char* statusName(Proximity status) {
  switch (status) {
    case Proximity::kSeparated:
      return "separated";
    case Proximity::kTouching:
      return "touching";
    case Proximity::kPenetrating:
      return "penetrating";
    case Proximity::kStepLimit:
      break;
  }
  throw std::runtime_error("the bound on the number of steps was reached: no answer");
}

const char* kindName(const Feature& feature) {
  if (feature.kind == FeatureKind::kVertex) return "vertex";
  return feature.kind == FeatureKind::kEdge ? "edge" : "face";
}

struct Body {
  LoadedMesh loaded;
  ConvexPolyhedron polyhedron;

  Body(const std::string& path, const Vector3& scale, NonConvexMesh choice)
      : loaded(choice == NonConvexMesh::kTakeHull ? loadSurface(path, scale)
                                                  : loadClosedMesh(path, scale)),
        polyhedron(polyhedronFromMesh(loaded.mesh, choice, "mesh file '" + path + "'")) {}

  /// The vertices of a feature, counted from 0 in the order of their first use in the file.
  std::string vertices(const Feature& feature) const {
    std::string text;
    for (const std::int32_t v : polyhedron.verticesOf(feature)) {
      std::size_t i = 0;
      while (loaded.mesh.vertices[i] != polyhedron.vertex(v)) ++i;
      text += fmt::format("{}{}", text.empty() ? "" : ", ", i);
    }
    return text;
  }
};

std::string jsonReport(const Body& A, const Body& B, const ClosestFeatures& c) {
  const auto vector = [](const Vector3& v) {
    return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
  };
  const auto feature = [](const Body& body, const Feature& f) {
    return fmt::format("{{\"type\": \"{}\", \"vertices\": [{}]}}", kindName(f), body.vertices(f));
  };
  return fmt::format(
      "{{\"status\": \"{}\", \"distance\": {}, \"point_a\": {}, \"point_b\": {}, "
      "\"normal\": {}, \"feature_a\": {}, \"feature_b\": {}, \"steps\": {}}}\n",
      statusName(c.status), c.distance, vector(c.p_WCa), vector(c.p_WCb), vector(c.nhat_AB_W),
      feature(A, c.feature_a), feature(B, c.feature_b), c.steps);
}

std::string textReport(const Body& A, const Body& B, const ClosestFeatures& c) {
  const auto line = [](const char* name, const Vector3& v) {
    return fmt::format("{:<10} {} {} {}\n", name, v.x(), v.y(), v.z());
  };
  const auto feature = [](const char* name, const Body& body, const Feature& f) {
    return fmt::format("{:<10} {} {}\n", name, kindName(f), body.vertices(f));
  };
  return fmt::format("{:<10} {}\n{:<10} {} m\n", "status", statusName(c.status), "distance",
                     c.distance) +
         line("point_a", c.p_WCa) + line("point_b", c.p_WCb) + line("normal", c.nhat_AB_W) +
         feature("feature_a", A, c.feature_a) + feature("feature_b", B, c.feature_b) +
         fmt::format("{:<10} {}\n", "steps", c.steps);
}

}  // namespace

std::string closestReport(const ClosestRequest& request, std::vector<std::string>* notes) {
  const FloatingPointEnvironment environment;
  const NonConvexMesh choice = request.hull ? NonConvexMesh::kTakeHull : NonConvexMesh::kRefuse;
  const Pose X_WA = poseFrom(request.pose_a, "pose-a");
  const Pose X_WB = poseFrom(request.pose_b, "pose-b");
  const Body A(request.mesh_a, request.scale, choice);
  const Body B(request.mesh_b, request.scale, choice);
  if (notes != nullptr) {
    for (const Body* body : {&A, &B}) {
      notes->insert(notes->end(), body->loaded.notes.begin(), body->loaded.notes.end());
    }
  }
  FeaturePair last;
  const ClosestFeatures c = closestFeatures(A.polyhedron, X_WA, B.polyhedron, X_WB, last);
  return request.json ? jsonReport(A, B, c) : textReport(A, B, c);
}

}  // namespace hovercraft
