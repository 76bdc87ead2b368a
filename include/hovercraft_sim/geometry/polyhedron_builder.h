#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/geometry/convex_polyhedron.h"

namespace hovercraft {

using Rings = std::vector<std::vector<std::int32_t>>;

/// @throws std::invalid_argument "convex polyhedron: REASON".
[[noreturn]] void refusePolyhedron(const std::string& reason);

/// Adjacency and planes from vertices and faces; checks what the rings alone can tell (indices,
/// duplicates, closed surface).
/// @throws std::invalid_argument
PolyhedronData buildPolyhedron(const std::vector<Vector3>& vertices, const Rings& rings);

/// Checks that the surface bounds a convex body.
/// @throws std::invalid_argument that names the worst vertex.
void checkConvex(const PolyhedronData& data);

/// Fills the cube map of support vertices.
void fillSupportMap(PolyhedronData& data);

/// The vertex reached uphill from `start`.
std::int32_t climb(const PolyhedronData& data, std::int32_t start, const Vector3& direction);

}  // namespace hovercraft
