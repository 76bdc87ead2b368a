#pragma once

#include <vector>

#include "hovercraft_sim/geometry/polygon_mesh.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The parts of a mesh that hang together by common vertices, in the order of their first
/// faces.
std::vector<PolygonMesh> shellsOf(const PolygonMesh& mesh);

/// How often a closed surface winds around a point that is not on it: 1 inside, 0 outside, negative
/// for an inside that the surface faces; on a face ½. The sum of the solid angles of its faces, as
/// fans of triangles, (van Oosterom and Strackee 1983, "The solid angle of a plane triangle", eq.
/// 8) over 4π.
double windingNumber(const PolygonMesh& surface, const Vector3& point);

}  // namespace hovercraft
