#pragma once

#include <array>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// A surface of triangles. Seen from outside the body, the vertices of each triangle run
/// counter-clockwise.
struct TriangleMesh {
  std::vector<Vector3> vertices;              // m, in the frame of the mesh
  std::vector<std::array<int, 3>> triangles;  // indices of vertices
};

/// The surface in a mesh file, closed or not, as for a convex hull, which takes only points: OBJ or
/// STL, or another format that assimp reads.
///
/// All meshes of the file are joined, each with the transforms of its nodes; materials, normals,
/// points and lines are ignored, polygons are triangulated. Vertices at equal positions become one,
/// as STL repeats them; triangles of which two vertices coincide are dropped. The indices follow
/// the first use of each vertex by a triangle, not the order in the file.
///
/// Assimp keeps coordinates in single precision, each exact to 2e-7 of itself (kMeshCoordinate): a
/// volume computed from them is exact to some 6e-7, less so far from the origin of the file.
/// @throws std::invalid_argument naming the file if it is missing, not readable, not a mesh, or
/// without a triangle.
HOVERCRAFT_PUBLIC TriangleMesh loadSurface(const std::string& path);

/// The same of a body.
/// @returns a mesh that passes checkClosed().
/// @throws std::invalid_argument naming the file also if the surface is not closed.
HOVERCRAFT_PUBLIC TriangleMesh loadTriangleMesh(const std::string& path);

/// Checks that a mesh bounds a solid: it has triangles, each edge belongs to exactly two of them
/// that run through it in opposite directions, and the enclosed volume is positive and known to 1 %
/// (kMeshVolume) in spite of the rounding of coordinates. It may have several shells, also touching
/// ones; one inside another is the wall of a cavity and must face inwards. That the surface does
/// not cut itself is not checked.
/// @param name begins every message, such as "mesh file 'hull.obj'".
/// @throws std::invalid_argument that says what is wrong and where.
HOVERCRAFT_PUBLIC void checkClosed(const TriangleMesh& mesh, const std::string& name);

}  // namespace hovercraft
