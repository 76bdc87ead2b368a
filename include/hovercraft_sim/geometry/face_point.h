#pragma once

#include <vector>

#include "hovercraft_sim/geometry/polygon_mesh.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// A point inside a face, also of one that is not convex (O'Rourke 1998, "Computational Geometry in
/// C", 1.6: every polygon has a diagonal): of a triangle the centroid, m. Of a face without area it
/// is one of its points.
Vector3 pointInFace(const PolygonMesh& mesh, const std::vector<int>& face);

}  // namespace hovercraft
