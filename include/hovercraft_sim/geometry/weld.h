#pragma once

#include <optional>

#include "hovercraft_sim/geometry/polygon_mesh.h"

namespace hovercraft {

/// The same surface with one vertex at each position, in the order in which the faces first use
/// them. A vertex that follows itself in a face stands once, and what is left with fewer than three
/// is no face: its sides lie in edges of others.
PolygonMesh joinedVertices(const PolygonMesh& mesh);

/// A surface whose open edges were closed by joining vertices.
struct WeldedMesh {
  PolygonMesh mesh;
  int joined = 0;         // vertices that moved to another one
  double farthest = 0.0;  // m, that one of them moved
};

/// Joins vertices on open edges that lie within kWeldDistance of each other, if no edge is open
/// then; none otherwise, or if there is nothing to join. Vertices on closed edges stay apart.
[[nodiscard]] std::optional<WeldedMesh> weldedShut(const PolygonMesh& mesh);

}  // namespace hovercraft
