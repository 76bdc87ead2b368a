#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/geometry/polygon_mesh.h"

namespace hovercraft {

/// One side of a face, as an undirected edge with the direction in which the face runs.
struct MeshSide {
  int low;
  int high;
  bool forward;  // from low to high
  int face;      // index
};

/// Throws std::invalid_argument: name, reason.
[[noreturn]] void refuseSurface(const std::string& name, const std::string& reason);

/// The sides of all faces, those of one edge next to each other, in the order of their vertices.
std::vector<MeshSide> sortedSides(const PolygonMesh& mesh);

/// The vertices on edges that belong to one face only, in the order of their indices.
std::vector<int> openVertices(const PolygonMesh& mesh);

/// Checks that each edge belongs to exactly two faces that run through it in opposite directions.
/// @throws std::invalid_argument with the kind of the bad edges, their number and the first one.
void checkEdges(const PolygonMesh& mesh, const std::string& name);

}  // namespace hovercraft
