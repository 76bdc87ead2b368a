#pragma once

#include <cstddef>
#include <string>

#include "hovercraft_sim/geometry/polygon_mesh.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// What an STL file holds.
struct StlContent {
  PolygonMesh mesh;                // three vertices of its own for each triangle
  std::size_t trailing_bytes = 0;  // behind the triangles of a binary file
};

/// The triangles of an STL file (3D Systems 1988), whose normals are passed over: the order of the
/// vertices says which side is outside.
///
/// It is binary if the n triangles that its header counts fit into it, 84 + 50 n bytes: a text has
/// no such count, whether or not the header begins with "solid". Fewer than 50 bytes may follow
/// them. It is text if it begins with "solid", in any case; it may hold several solids.
/// @param scale of the coordinates to m, each > 0. @param name begins every message.
/// @throws std::invalid_argument naming the line or the triangle, counted from 1.
StlContent readStl(const std::string& content, const Vector3& scale, const std::string& name);

}  // namespace hovercraft
