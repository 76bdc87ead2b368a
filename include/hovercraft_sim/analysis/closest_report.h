#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// What the tool `closest` is asked.
struct ClosestRequest {
  std::string mesh_a;          // path
  std::string mesh_b;          // path
  std::vector<double> pose_a;  // x y z (m) qx qy qz qw in the world; empty: the identity
  std::vector<double> pose_b;
  bool hull = false;                // take the convex hull of a mesh that is not convex
  bool json = false;                // one JSON object instead of lines
  Vector3 scale = Vector3::Ones();  // of the coordinates of both to m
};

/// The closest features of two convex meshes as text: status, distance (negative: depth), point_a,
/// point_b, normal, feature_a and feature_b (type, vertices), steps. Lengths in m. Vertices are
/// counted from 0 in the order in which the faces of the file first use them.
/// @param notes gets what the user should know of the mesh files, unless it is null.
/// @throws std::invalid_argument naming the mesh or the pose that is not in order.
/// @throws std::runtime_error if the bound on the number of steps was reached.
HOVERCRAFT_PUBLIC std::string closestReport(const ClosestRequest& request,
                                            std::vector<std::string>* notes = nullptr);

}  // namespace hovercraft
