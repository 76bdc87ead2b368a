#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/geometry/triangle_mesh.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The convex hull of a point cloud, by qhull (Barber, Dobkin and Huhdanpaa 1996). Facets that are
/// coplanar to rounding come as one face; points inside are left out, the others keep their order.
/// @param name begins every message.
/// @throws std::invalid_argument if the points are fewer than four, not finite or in one plane.
ConvexPolyhedron convexHull(const std::vector<Vector3>& points, const std::string& name);

/// What to do with a mesh that is not convex.
enum class NonConvexMesh { kRefuse, kTakeHull };

/// The body inside a triangle mesh. Coplanar triangles become one face. A dent no deeper than the
/// single precision that mesh files are read with is rounding, not a shape, and is filled.
/// @param mesh passes checkClosed(). @param name begins every message.
/// @throws std::invalid_argument naming the worst vertex if the mesh is not convex and that is not
/// wanted.
ConvexPolyhedron polyhedronFromMesh(const TriangleMesh& mesh, NonConvexMesh choice,
                                    const std::string& name);

}  // namespace hovercraft
