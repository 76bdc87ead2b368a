#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/geometry/polygon_mesh.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// What was read from a mesh file.
struct LoadedMesh {
  PolygonMesh mesh;                // in its own coordinates
  std::vector<std::string> notes;  // what was made of the file, beginning with its name
};

enum class MeshFormat { kObj, kStl };

/// The surface in an OBJ or STL file, closed or not, as for a convex hull, which takes only points.
/// What the formats may hold: obj_reader.h, stl_reader.h.
///
/// Coordinates are the nearest doubles of the decimal numbers, times the scale. Vertices at equal
/// positions become one, as STL repeats them.
/// @param scale of the coordinates to m along x, y and z, each > 0.
/// @throws std::invalid_argument naming the file, and the line or triangle, if its name does not
/// end in .obj or .stl (in any case), it is no regular file of at most kMostMeshBytes, breaks a
/// rule of its format, or has no face.
HOVERCRAFT_PUBLIC LoadedMesh loadSurface(const std::string& path,
                                         const Vector3& scale = Vector3::Ones());

/// The same of a body. A polygon that is not plane (by kMeshDentDepth of the extent) is cut into
/// triangles from its first vertex, with a note. If edges are open that joining near vertices
/// closes (kWeldDistance), that is done, with a note.
/// @returns a mesh that passes checkClosed().
/// @throws std::invalid_argument naming the file also if the surface is not closed.
HOVERCRAFT_PUBLIC LoadedMesh loadClosedMesh(const std::string& path,
                                            const Vector3& scale = Vector3::Ones());

/// What loadSurface() makes of the content of a file. @param name begins every message and note.
HOVERCRAFT_PUBLIC LoadedMesh parseSurface(const std::string& content, MeshFormat format,
                                          const Vector3& scale, const std::string& name);

/// What loadClosedMesh() makes of it.
HOVERCRAFT_PUBLIC LoadedMesh parseClosedMesh(const std::string& content, MeshFormat format,
                                             const Vector3& scale, const std::string& name);

}  // namespace hovercraft
