#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/geometry/triangle_mesh.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The convex hull of a point cloud, by qhull (Barber, Dobkin and Huhdanpaa 1996). Facets that are
/// coplanar to rounding come as one face; points inside are left out, the others keep their order.
/// No point lies outside by more than kPlanarSlack of the greatest coordinate.
/// @param name begins every message.
/// @throws std::invalid_argument if the points are fewer than four, not finite or in one plane.
HOVERCRAFT_PUBLIC ConvexPolyhedron convexHull(const std::vector<Vector3>& points,
                                              const std::string& name);

/// What to do with a mesh that is not convex.
enum class NonConvexMesh { kRefuse, kTakeHull };

/// The body inside a triangle mesh. Coplanar triangles become one face. The mesh counts as convex
/// if it encloses the volume of its hull and no edge at which it bends inward lies under the
/// surface of that, both up to the rounding of the coordinates in mesh files (kMeshDentSlack,
/// kMeshDentDepth): a dent no deeper is rounding, not a shape, and is filled.
/// @param mesh passes checkClosed(), unless its hull is taken. @param name begins every message.
/// @throws std::invalid_argument naming the vertex farthest outside the plane of a triangle if the
/// mesh is not convex and that is not wanted.
HOVERCRAFT_PUBLIC ConvexPolyhedron polyhedronFromMesh(const TriangleMesh& mesh,
                                                      NonConvexMesh choice,
                                                      const std::string& name);

}  // namespace hovercraft
