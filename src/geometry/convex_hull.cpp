#include "hovercraft_sim/geometry/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fmt/format.h>
#include <libqhull_r/qhull_ra.h>
#include <memory>
#include <stdexcept>

#include "hovercraft_sim/geometry/polyhedron_builder.h"
#include "hovercraft_sim/geometry/volume_moments.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

std::size_t at(std::int32_t index) {
  return static_cast<std::size_t>(index);
}

/// One run of qhull: its state, and what it has to say, freed at the end.
class Qhull {
 public:
  explicit Qhull(const std::vector<Vector3>& points) {
    coordinates_.reserve(3 * points.size());
    for (const Vector3& p : points) coordinates_.insert(coordinates_.end(), {p.x(), p.y(), p.z()});
    messages_ = open_memstream(&text_, &length_);
    qh_zero(&state_, messages_);
    char command[] = "qhull Pp";
    exit_code_ = qh_new_qhull(&state_, 3, static_cast<int>(points.size()), coordinates_.data(),
                              False, command, nullptr, messages_);
  }
  Qhull(const Qhull&) = delete;
  Qhull& operator=(const Qhull&) = delete;
  ~Qhull() {
    qh_freeqhull(&state_, !qh_ALL);
    int current = 0;
    int total = 0;
    qh_memfreeshort(&state_, &current, &total);
    if (messages_ != nullptr) std::fclose(messages_);
    std::free(text_);  // NOLINT(cppcoreguidelines-no-malloc): open_memstream allocates so
  }

  bool failed() const { return exit_code_ != 0; }

  /// The first line that qhull wrote.
  std::string message() {
    std::fflush(messages_);
    const std::string all(text_, length_);
    return all.substr(0, all.find('\n'));
  }

  /// The vertices of each facet, counter-clockwise seen from outside.
  Rings rings(const std::vector<Vector3>& points) {
    Rings result;
    for (facetT* facet = state_.facet_list; facet != nullptr && facet->next != nullptr;
         facet = facet->next) {
      setT* const ordered = qh_facet3vertex(&state_, facet);
      std::vector<std::int32_t> ring;
      for (int i = 0; i < qh_setsize(&state_, ordered); ++i) {
        const auto* vertex = static_cast<const vertexT*>(ordered->e[i].p);
        ring.push_back(qh_pointid(&state_, vertex->point));
      }
      qh_settempfree_all(&state_);
      orient(points, facet->normal, ring);
      result.push_back(std::move(ring));
    }
    return result;
  }

 private:
  static void orient(const std::vector<Vector3>& points, const double* outward,
                     std::vector<std::int32_t>& ring) {
    Vector3 area = Vector3::Zero();
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
      const Vector3 a = points[at(ring[i])] - points[at(ring[0])];
      const Vector3 b = points[at(ring[i + 1])] - points[at(ring[0])];
      area += cross(a, b);
    }
    if (dot(area, {outward[0], outward[1], outward[2]}) < 0.0) {
      std::reverse(ring.begin(), ring.end());
    }
  }

  qhT state_{};
  std::vector<double> coordinates_;
  char* text_ = nullptr;
  std::size_t length_ = 0;
  std::FILE* messages_ = nullptr;
  int exit_code_ = 0;
};

/// Leaves out of the rings the vertices that fewer than three faces share: they lie on an edge or
/// inside a face.
void dropFlatVertices(std::size_t count, Rings& rings) {
  bool changed = true;
  while (changed) {
    std::vector<int> faces(count, 0);
    for (const auto& ring : rings) {
      for (const std::int32_t v : ring) ++faces[at(v)];
    }
    changed = false;
    for (auto& ring : rings) {
      const auto flat = [&](std::int32_t v) { return faces[at(v)] < 3; };
      const auto end = std::remove_if(ring.begin(), ring.end(), flat);
      changed = changed || end != ring.end();
      ring.erase(end, ring.end());
    }
    const auto empty = [](const auto& ring) { return ring.size() < 3; };
    rings.erase(std::remove_if(rings.begin(), rings.end(), empty), rings.end());
  }
}

/// The vertices in use, and the rings in terms of them.
std::vector<Vector3> compact(const std::vector<Vector3>& points, Rings& rings) {
  std::vector<std::int32_t> renamed(points.size(), -1);
  for (const auto& ring : rings) {
    for (const std::int32_t v : ring) renamed[at(v)] = 0;
  }
  std::vector<Vector3> vertices;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (renamed[i] < 0) continue;
    renamed[i] = static_cast<std::int32_t>(vertices.size());
    vertices.push_back(points[i]);
  }
  for (auto& ring : rings) {
    for (std::int32_t& v : ring) v = renamed[at(v)];
  }
  return vertices;
}

/// The greatest height of a vertex over the plane of a triangle that shares an edge with one of its
/// own, or the greatest over all planes when `all` is set, and the vertex.
struct Dent {
  double depth = 0.0;
  int vertex = 0;
};

Dent worstVertex(const TriangleMesh& mesh) {
  Dent worst;
  for (const auto& t : mesh.triangles) {
    const Vector3& a = mesh.vertices[at(t[0])];
    const Vector3 normal = cross(mesh.vertices[at(t[1])] - a, mesh.vertices[at(t[2])] - a);
    const double area = norm(normal);
    if (!(area > 0.0)) continue;
    const Vector3 unit = normal / area;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const double above = dot(unit, mesh.vertices[v] - a);
      if (above > worst.depth) worst = {above, static_cast<int>(v)};
    }
  }
  return worst;
}

}  // namespace

ConvexPolyhedron convexHull(const std::vector<Vector3>& points, const std::string& name) {
  if (points.size() < 4) {
    throw std::invalid_argument(
        fmt::format("{}: {} points have no convex hull, it takes at least 4", name, points.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      throw std::invalid_argument(fmt::format("{}: point {} is not finite", name, i));
    }
  }
  Rings rings;
  {
    Qhull qhull(points);
    if (qhull.failed()) {
      throw std::invalid_argument(
          fmt::format("{}: no convex hull (points in one plane?): {}", name, qhull.message()));
    }
    rings = qhull.rings(points);
  }
  dropFlatVertices(points.size(), rings);
  const std::vector<Vector3> vertices = compact(points, rings);
  try {
    return {vertices, rings};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: its convex hull: {}", name, error.what()));
  }
}

ConvexPolyhedron polyhedronFromMesh(const TriangleMesh& mesh, NonConvexMesh choice,
                                    const std::string& name) {
  ConvexPolyhedron hull = convexHull(mesh.vertices, name);
  if (choice == NonConvexMesh::kTakeHull) return hull;
  // A closed surface bounds its convex hull exactly when it encloses the same volume.
  double area = 0.0;
  double volume = 0.0;
  for (const PolyhedronData::Face& face : hull.data().faces) {
    double face_area = 0.0;
    for (std::int32_t i = face.ring_begin; i < face.ring_begin + face.ring_count; ++i) {
      const PolyhedronData::RingPlane& side = hull.data().ring[at(i)];
      const PolyhedronData::Edge& edge = hull.edge(hull.data().ring_edge[at(i)]);
      face_area += 0.5 * edge.length * (dot(side.inward, hull.data().center) - side.offset);
    }
    area += face_area;
    volume += face_area * (face.offset - dot(face.normal, hull.data().center)) / 3.0;
  }
  const double rounding = kMeshDentSlack * hull.data().radius;
  if (volume - signedVolume(mesh) > rounding * area) {
    const Dent worst = worstVertex(mesh);
    const Vector3& p = mesh.vertices[at(worst.vertex)];
    throw std::invalid_argument(fmt::format(
        "{}: is not convex: vertex {} at ({}, {}, {}) lies {} m outside the plane of a triangle "
        "(hull: true takes the convex hull instead)",
        name, worst.vertex, p.x(), p.y(), p.z(), worst.depth));
  }
  return hull;
}

}  // namespace hovercraft
