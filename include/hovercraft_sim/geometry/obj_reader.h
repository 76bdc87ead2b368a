#pragma once

#include <string>

#include "hovercraft_sim/geometry/polygon_mesh.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The vertices and faces of a Wavefront OBJ file as they stand in it (Advanced Visualizer manual,
/// appendix B1). No other file is opened.
///
/// - `v x y z`, also with a weight of 1 or a colour of 3 or 4 numbers behind it; with any other
///   weight it would be a point of a rational curve and is refused.
/// - `f`, `fo`: at least three of v, v/vt, v//vn or v/vt/vn; v from 1 on, or negative, back from
/// the
///   last vertex.
/// - Normals, texture coordinates, points, lines, groups, names and materials are passed over.
/// - Free-form curves and surfaces, `call` and `csh`, and what is none of all these are refused.
/// @param scale of the coordinates to m, each > 0. @param name begins every message.
/// @throws std::invalid_argument naming the line.
PolygonMesh readObj(const std::string& content, const Vector3& scale, const std::string& name);

}  // namespace hovercraft
