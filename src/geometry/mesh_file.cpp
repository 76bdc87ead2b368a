#include "hovercraft_sim/geometry/mesh_file.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <optional>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/geometry/mesh_edges.h"
#include "hovercraft_sim/geometry/obj_reader.h"
#include "hovercraft_sim/geometry/stl_reader.h"
#include "hovercraft_sim/geometry/weld.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/regular_file.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

std::string nameOf(const std::string& path) {
  return "mesh file '" + path + "'";
}

/// By the end of the name, since an OBJ file may begin with anything.
MeshFormat formatOf(const std::string& path) {
  const std::size_t slash = path.find_last_of('/');
  const std::string file = slash == std::string::npos ? path : path.substr(slash + 1);
  const std::size_t point = file.find_last_of('.');
  std::string ending = point == std::string::npos ? "" : file.substr(point);
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (ending == ".obj") return MeshFormat::kObj;
  if (ending == ".stl") return MeshFormat::kStl;
  throw std::invalid_argument(
      nameOf(path) +
      ": its name must end in .obj or .stl: write a mesh of another format as one of these, for "
      "instance in Blender (File, Export) or MeshLab (File, Export Mesh As), a solid of CAD in "
      "FreeCAD");
}

std::string contentOf(const std::string& path) {
  return contentOfRegularFile(path, nameOf(path), kMostMeshBytes);
}

/// How far (m) the farthest vertex of a face lies from its plane through the middle of the
/// vertices.
double heightOver(const PolygonMesh& mesh, const std::vector<int>& face) {
  if (face.size() == 3) return 0.0;
  const Vector3 area = twiceArea(mesh, face);
  const double size = norm(area);
  const Vector3& origin = mesh.vertices[static_cast<std::size_t>(face[0])];
  Vector3 middle = Vector3::Zero();  // from the origin
  for (const int v : face) middle += mesh.vertices[static_cast<std::size_t>(v)] - origin;
  middle = middle / static_cast<double>(face.size());
  double height = 0.0;
  for (const int v : face) {
    const Vector3 p = (mesh.vertices[static_cast<std::size_t>(v)] - origin) - middle;
    height = std::max(height, size > 0.0 ? std::abs(dot(p, area)) / size : norm(p));
  }
  return height;
}

/// Cuts the faces that are not plane into the fan from their first vertex.
void cutBentFaces(LoadedMesh& loaded, const std::string& name) {
  const double slack = kMeshDentDepth * extentOf(loaded.mesh);
  std::vector<std::vector<int>> faces;
  std::size_t bent = 0;
  double worst = 0.0;
  for (std::size_t f = 0; f < loaded.mesh.faces.size(); ++f) {
    std::vector<int>& face = loaded.mesh.faces[f];
    const double height = heightOver(loaded.mesh, face);
    if (!(height > slack)) {
      faces.push_back(face);
      continue;
    }
    ++bent;
    worst = std::max(worst, height);
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      if (face[0] == face[i] || face[0] == face[i + 1]) continue;  // no area
      faces.push_back({face[0], face[i], face[i + 1]});
    }
  }
  if (bent == 0) return;
  loaded.mesh.faces = std::move(faces);
  loaded.notes.push_back(
      fmt::format("{}: polygons that are not plane: {}, the worst by {:.3g} m; they are taken as "
                  "triangles from their first vertex",
                  name, bent, worst));
}

void closeByWelding(LoadedMesh& loaded, const std::string& name) {
  std::optional<WeldedMesh> welded = weldedShut(loaded.mesh);
  if (!welded) return;
  loaded.mesh = std::move(welded->mesh);
  loaded.notes.push_back(
      fmt::format("{}: closed by joining vertices on open edges: {}, up to {:.3g} m apart", name,
                  welded->joined, welded->farthest));
}

}  // namespace

LoadedMesh parseSurface(const std::string& content, MeshFormat format, const Vector3& scale,
                        const std::string& name) {
  const FloatingPointEnvironment environment;
  LoadedMesh loaded;
  if (format == MeshFormat::kObj) {
    loaded.mesh = joinedVertices(readObj(content, scale, name));
  } else {
    const StlContent stl = readStl(content, scale, name);
    loaded.mesh = joinedVertices(stl.mesh);
    if (stl.trailing_bytes > 0) {
      loaded.notes.push_back(
          fmt::format("{}: bytes left out behind its triangles: {}", name, stl.trailing_bytes));
    }
  }
  if (loaded.mesh.faces.empty()) throw std::invalid_argument(name + ": no faces");
  return loaded;
}

LoadedMesh parseClosedMesh(const std::string& content, MeshFormat format, const Vector3& scale,
                           const std::string& name) {
  const FloatingPointEnvironment environment;
  LoadedMesh loaded = parseSurface(content, format, scale, name);
  cutBentFaces(loaded, name);
  closeByWelding(loaded, name);
  checkClosed(loaded.mesh, name);
  return loaded;
}

LoadedMesh loadSurface(const std::string& path, const Vector3& scale) {
  const MeshFormat format = formatOf(path);
  return parseSurface(contentOf(path), format, scale, nameOf(path));
}

LoadedMesh loadClosedMesh(const std::string& path, const Vector3& scale) {
  const MeshFormat format = formatOf(path);
  return parseClosedMesh(contentOf(path), format, scale, nameOf(path));
}

}  // namespace hovercraft
