#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/geometry/volume_moments.h"

#include "targets.h"

namespace hovercraft::fuzz {
namespace {

constexpr std::size_t kMostHullVertices = 64;  // qhull takes its time for more

void readAs(MeshFormat format, const std::string& input) {
  try {
    const LoadedMesh surface = parseSurface(input, format, Vector3::Ones(), "input");
    for (const auto& face : surface.mesh.faces) {
      for (const int v : face) {
        if (v < 0 || static_cast<std::size_t>(v) >= surface.mesh.vertices.size()) std::abort();
      }
    }
    if (surface.mesh.vertices.size() <= kMostHullVertices) {
      polyhedronFromMesh(surface.mesh, NonConvexMesh::kTakeHull, "input");
    }
  } catch (const std::invalid_argument&) {  // it names what is wrong
  }
  try {
    const LoadedMesh body = parseClosedMesh(input, format, {0.5, 2.0, 1.0}, "input");
    const VolumeMoments moments = volumeMoments(body.mesh);
    if (!(moments.volume > 0.0 && std::isfinite(moments.volume) && moments.centroid.allFinite() &&
          moments.second_about_centroid.allFinite())) {
      throw std::logic_error("the moments of a closed mesh are not finite");
    }
    if (body.mesh.vertices.size() <= kMostHullVertices) {
      polyhedronFromMesh(body.mesh, NonConvexMesh::kRefuse, "input");
    }
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

void readMesh(const std::string& input) {
  readAs(MeshFormat::kObj, input);
  readAs(MeshFormat::kStl, input);
}

}  // namespace hovercraft::fuzz
