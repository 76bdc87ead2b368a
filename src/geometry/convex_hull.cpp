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
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

/// One run of qhull: its state, and what it has to say, freed at the end.
class Qhull {
 public:
  /// @param coplanar m: facets that are bent inward by less become one; 0: by rounding alone.
  Qhull(const std::vector<Vector3>& points, double coplanar) {
    coordinates_.reserve(3 * points.size());
    for (const Vector3& p : points) coordinates_.insert(coordinates_.end(), {p.x(), p.y(), p.z()});
    messages_ = open_memstream(&text_, &length_);
    qh_zero(&state_, messages_);
    std::string command = "qhull Pp";
    if (coplanar > 0.0) command += fmt::format(" C-{}", coplanar);
    exit_code_ = qh_new_qhull(&state_, 3, static_cast<int>(points.size()), coordinates_.data(),
                              False, command.data(), nullptr, messages_);
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

/// The order in which qhull finds facets, and where their rings begin, hangs on the last bits of
/// its sums, which fused multiply-add changes on some processors: each ring begins with its lowest
/// vertex, and they follow each other in the order of their vertices.
void putInOrder(Rings& rings) {
  for (std::vector<std::int32_t>& ring : rings) {
    std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
  }
  std::sort(rings.begin(), rings.end());
}

/// The body of the facets that qhull finds.
ConvexPolyhedron hullBody(const std::vector<Vector3>& points, double coplanar,
                          const std::string& name) {
  Rings rings;
  {
    Qhull qhull(points, coplanar);
    if (qhull.failed()) {
      throw std::invalid_argument(
          fmt::format("{}: no convex hull (points in one plane?): {}", name, qhull.message()));
    }
    rings = qhull.rings(points);
  }
  dropFlatVertices(points.size(), rings);
  const std::vector<Vector3> vertices = compact(points, rings);
  putInOrder(rings);
  try {
    return {vertices, rings};
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("{}: its convex hull: {}", name, error.what()));
  }
}

double gapUnder(const PolyhedronData::Face& face, const Vector3& p) {
  return face.offset - dot(face.normal, p);
}

/// The neighbour of a face whose plane is nearest to a point inside, or the face itself.
std::int32_t nearestBeside(const ConvexPolyhedron& hull, std::int32_t start, const Vector3& p) {
  const PolyhedronData::Face& from = hull.face(start);
  std::int32_t nearest = start;
  double least = gapUnder(from, p);
  for (std::int32_t i = from.ring_begin; i < from.ring_begin + from.ring_count; ++i) {
    const PolyhedronData::Edge& edge = hull.edge(hull.data().ring_edge[at(i)]);
    const std::int32_t other = edge.face[edge.face[0] == start ? 1 : 0];
    const double gap = gapUnder(hull.face(other), p);
    if (gap >= least) continue;
    least = gap;
    nearest = other;
  }
  return nearest;
}

/// How deep (m) a point lies under the surface of the hull: the distance to the nearest plane.
/// Exact if it is more than `enough`, otherwise only known to be no more. Goes from `face` to
/// nearer ones first, which serves points that follow each other on a surface; ends at a face.
double depthUnder(const ConvexPolyhedron& hull, const Vector3& p, double enough,
                  std::int32_t& face) {
  double least = gapUnder(hull.face(face), p);
  for (std::int32_t step = 0; least > enough && step < hull.faceCount(); ++step) {
    const std::int32_t next = nearestBeside(hull, face, p);
    if (next == face) break;
    face = next;
    least = gapUnder(hull.face(face), p);
  }
  for (std::int32_t f = 0; least > enough && f < hull.faceCount(); ++f) {
    const double gap = gapUnder(hull.face(f), p);
    if (gap >= least) continue;
    least = gap;
    face = f;
  }
  return least;
}

/// One side of a triangle.
struct Side {
  int low;  // its vertices, ordered
  int high;
  int opposite;       // the third vertex
  std::size_t owner;  // the triangle
};

/// The sides of all triangles, those of one edge next to each other: by counting for the lower
/// vertex, by sorting the few at each.
std::vector<Side> sortedSides(const TriangleMesh& mesh) {
  std::vector<std::size_t> begins(mesh.vertices.size() + 1, 0);
  for (const auto& t : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) ++begins[at(std::min(t[k], t[(k + 1) % 3])) + 1];
  }
  for (std::size_t v = 1; v < begins.size(); ++v) begins[v] += begins[v - 1];
  std::vector<Side> sides(3 * mesh.triangles.size());
  std::vector<std::size_t> ends(begins.begin(), begins.end() - 1);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax(t[k], t[(k + 1) % 3]);
      sides[ends[at(low)]++] = {low, high, t[(k + 2) % 3], i};
    }
  }
  const auto first = sides.begin();
  for (std::size_t v = 0; v < ends.size(); ++v) {
    std::sort(first + static_cast<std::ptrdiff_t>(begins[v]),
              first + static_cast<std::ptrdiff_t>(ends[v]), [](const Side& a, const Side& b) {
                return a.high != b.high ? a.high < b.high : a.owner < b.owner;
              });
  }
  return sides;
}

/// Twice the area of a triangle times its normal.
Vector3 areaOf(const TriangleMesh& mesh, const std::array<int, 3>& t) {
  const Vector3& a = mesh.vertices[at(t[0])];
  return cross(mesh.vertices[at(t[1])] - a, mesh.vertices[at(t[2])] - a);
}

/// Whether an edge at which the surface bends inward lies deeper than `slack` (m) under the surface
/// of the hull. A surface of one piece without such an edge is convex, and every dent has one: at
/// its bottom, or where it reaches the surface again.
bool hasDent(const TriangleMesh& mesh, const ConvexPolyhedron& hull, double slack) {
  const std::vector<Side> sides = sortedSides(mesh);
  std::int32_t face = 0;
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side& side = sides[i];
    const Side& other = sides[i + 1];
    if (side.low != other.low || side.high != other.high) continue;
    const Vector3& a = mesh.vertices[at(side.low)];
    const Vector3& b = mesh.vertices[at(side.high)];
    const Vector3 normal = areaOf(mesh, mesh.triangles[side.owner]);
    if (!(dot(normal, mesh.vertices[at(other.opposite)] - a) > 0.0)) continue;
    for (const Vector3& p : {a, b, Vector3(0.5 * (a + b))}) {
      if (depthUnder(hull, p, slack, face) > slack) return true;
    }
  }
  return false;
}

/// The greatest height of a vertex over the plane of a triangle.
struct Outside {
  double height = 0.0;  // m
  int vertex = 0;       // of the hull
  std::array<int, 3> triangle{};
};

Outside worstVertex(const TriangleMesh& mesh, const ConvexPolyhedron& hull) {
  Outside worst;
  for (const auto& t : mesh.triangles) {
    const Vector3 normal = areaOf(mesh, t);
    const double area = norm(normal);
    if (!(area > 0.0)) continue;
    const int vertex = hull.supportVertex(normal);
    const double height = dot(normal, hull.vertex(vertex) - mesh.vertices[at(t[0])]) / area;
    if (height > worst.height) worst = {height, vertex, t};
  }
  return worst;
}

[[noreturn]] void refuseMesh(const TriangleMesh& mesh, const ConvexPolyhedron& hull,
                             const std::string& name) {
  const Outside worst = worstVertex(mesh, hull);
  const Vector3& p = hull.vertex(worst.vertex);
  const auto place = std::find(mesh.vertices.begin(), mesh.vertices.end(), p);
  throw std::invalid_argument(fmt::format(
      "{}: is not convex: vertex {} at ({}, {}, {}) lies {} m outside the plane of the triangle of "
      "vertices {}, {}, {} (hull: true takes the convex hull instead)",
      name, place - mesh.vertices.begin(), p.x(), p.y(), p.z(), worst.height, worst.triangle[0],
      worst.triangle[1], worst.triangle[2]));
}

struct Extent {
  double area = 0.0;    // m²
  double volume = 0.0;  // m³
};

Extent extentOf(const PolyhedronData& body) {
  Extent sum;
  for (const PolyhedronData::Face& face : body.faces) {
    double face_area = 0.0;
    for (std::int32_t i = face.ring_begin; i < face.ring_begin + face.ring_count; ++i) {
      const PolyhedronData::RingPlane& side = body.ring[at(i)];
      const PolyhedronData::Edge& edge = body.edges[at(body.ring_edge[at(i)])];
      face_area += 0.5 * edge.length * (dot(side.inward, body.center) - side.offset);
    }
    sum.area += face_area;
    sum.volume += face_area * (face.offset - dot(face.normal, body.center)) / 3.0;
  }
  return sum;
}

}  // namespace

ConvexPolyhedron convexHull(const std::vector<Vector3>& points, const std::string& name) {
  const FloatingPointEnvironment environment;
  if (points.size() < 4) {
    throw std::invalid_argument(
        fmt::format("{}: {} points have no convex hull, it takes at least 4", name, points.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      throw std::invalid_argument(fmt::format("{}: point {} is not finite", name, i));
    }
  }
  try {
    return hullBody(points, 0.0, name);
  } catch (const std::invalid_argument&) {
    // Points that leave a plane or a line by some ten roundings can be too far out for qhull to
    // merge their facets, and too near for the planes of these to be of use.
    double largest = 0.0;
    for (const Vector3& p : points) largest = std::max(largest, norm(p));
    return hullBody(points, 0.5 * kPlanarSlack * largest, name);
  }
}

ConvexPolyhedron polyhedronFromMesh(const TriangleMesh& mesh, NonConvexMesh choice,
                                    const std::string& name) {
  const FloatingPointEnvironment environment;
  ConvexPolyhedron hull = convexHull(mesh.vertices, name);
  if (choice == NonConvexMesh::kTakeHull) return hull;
  const Extent extent = extentOf(hull.data());
  const double radius = hull.data().radius;
  const bool has_gaps = extent.volume - signedVolume(mesh) > kMeshDentSlack * radius * extent.area;
  if (has_gaps || hasDent(mesh, hull, kMeshDentDepth * radius)) refuseMesh(mesh, hull, name);
  return hull;
}

}  // namespace hovercraft
