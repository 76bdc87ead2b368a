#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// A surface of plane polygons, which need not be convex. Seen from outside the body, the vertices
/// of each face run counter-clockwise.
struct PolygonMesh {
  std::vector<Vector3> vertices;        // m, in the frame of the mesh
  std::vector<std::vector<int>> faces;  // indices of vertices, at least three, none after itself
  double rounding = kDoubleRounding;    // of a coordinate, relative to the greatest one (-)
};

/// Twice the area of a face times its normal (Newell 1972), m²: the sum over the fan of triangles
/// from its first vertex.
Vector3 twiceArea(const PolygonMesh& mesh, const std::vector<int>& face);

/// The greatest magnitude of a coordinate, m.
double greatestCoordinate(const PolygonMesh& mesh);

/// The longest edge of the box around a mesh that has vertices, m.
double extentOf(const PolygonMesh& mesh);

/// Checks that a mesh bounds a solid: it has faces, each edge belongs to exactly two of them that
/// run through it in opposite directions, and the enclosed volume is positive and known to 1 %
/// (kMeshVolume) in spite of the rounding of coordinates. It may have several shells, also touching
/// ones, but at most kMostShells; one inside another is the wall of a cavity and must face inwards.
/// That the surface does not cut itself is not checked, nor that its faces are plane.
/// @param name begins every message, such as "mesh file 'hull.obj'".
/// @throws std::invalid_argument that says what is wrong and where.
HOVERCRAFT_PUBLIC void checkClosed(const PolygonMesh& mesh, const std::string& name);

}  // namespace hovercraft
