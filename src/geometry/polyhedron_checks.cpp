#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

#include "hovercraft_sim/geometry/coordinates.h"
#include "hovercraft_sim/geometry/polyhedron_builder.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {

void refusePolyhedron(const std::string& reason) {
  throw std::invalid_argument("convex polyhedron: " + reason);
}

namespace {

using Edge = PolyhedronData::Edge;
using Face = PolyhedronData::Face;

/// The vertex with which the ring goes on after position `i` has ended.
std::int32_t vertexAfter(const PolyhedronData& data, const Face& face, std::int32_t i) {
  const std::int32_t next = i + 1 < face.ring_begin + face.ring_count ? i + 1 : face.ring_begin;
  const Edge& edge = data.edges[at(data.ring_edge[at(next)])];
  return edge.vertex[edge.ring[0] == next ? 1 : 0];
}

double height(const PolyhedronData& data, std::int32_t face, std::int32_t vertex) {
  return dot(data.faces[at(face)].normal, data.vertices[at(vertex)].p) -
         data.faces[at(face)].offset;
}

/// A vertex with its position.
std::string describe(const PolyhedronData& data, std::int32_t vertex) {
  return fmt::format("vertex {} at {}", vertex, coordinates(data.vertices[at(vertex)].p));
}

/// Says so if all vertices lie in the plane of one face.
void checkThickness(const PolyhedronData& data, double tolerance) {
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    double farthest = 0.0;
    for (std::size_t v = 0; v < data.vertices.size(); ++v) {
      farthest = std::max(farthest, std::abs(height(data, static_cast<std::int32_t>(f),
                                                    static_cast<std::int32_t>(v))));
    }
    if (farthest > tolerance) continue;
    refusePolyhedron(fmt::format(
        "the body is flat: no vertex lies more than {} m from the plane of face {}, more than {} m "
        "is a thickness",
        farthest, f, tolerance));
  }
}

/// Every vertex against every face: only to say what is wrong.
[[noreturn]] void refuseWorst(const PolyhedronData& data, const char* what, double tolerance) {
  checkThickness(data, tolerance);
  double worst = 0.0;
  std::int32_t worst_vertex = 0;
  std::int32_t worst_face = 0;
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    for (std::size_t v = 0; v < data.vertices.size(); ++v) {
      const double above = height(data, static_cast<std::int32_t>(f), static_cast<std::int32_t>(v));
      if (above > worst) {
        worst = above;
        worst_vertex = static_cast<std::int32_t>(v);
        worst_face = static_cast<std::int32_t>(f);
      }
    }
  }
  refusePolyhedron(
      fmt::format("{}: {} lies {} m outside the plane of face {}, at most {} m is rounding", what,
                  describe(data, worst_vertex), worst, worst_face, tolerance));
}

/// Diagonal of the bounding box.
double extent(const PolyhedronData& data) {
  Vector3 low = data.vertices[0].p;
  Vector3 high = low;
  for (const PolyhedronData::Vertex& v : data.vertices) {
    low = low.cwiseMin(v.p);
    high = high.cwiseMax(v.p);
  }
  return norm(high - low);
}

/// Rounding of coordinates counts from the origin, that of shapes from their own size.
double slack(const PolyhedronData& data) {
  return kPlanarSlack * std::max(data.radius, extent(data));
}

/// Every vertex of a face against every side of it: only to say what is wrong.
[[noreturn]] void refuseFace(const PolyhedronData& data, std::int32_t face, double tolerance) {
  const Face& polygon = data.faces[at(face)];
  const std::int32_t end = polygon.ring_begin + polygon.ring_count;
  double worst = 0.0;
  std::int32_t worst_vertex = 0;
  std::int32_t worst_position = polygon.ring_begin;
  for (std::int32_t i = polygon.ring_begin; i < end; ++i) {
    for (std::int32_t k = polygon.ring_begin; k < end; ++k) {
      const std::int32_t vertex = vertexAfter(data, polygon, k);
      const Edge& side = data.edges[at(data.ring_edge[at(i)])];
      const double beyond = dot(data.ring[at(i)].inward, side.p - data.vertices[at(vertex)].p);
      if (beyond <= worst) continue;
      worst = beyond;
      worst_vertex = vertex;
      worst_position = i;
    }
  }
  const Edge& worst_side = data.edges[at(data.ring_edge[at(worst_position)])];
  refusePolyhedron(fmt::format(
      "face {} is not a convex polygon: {} lies {} m beyond its side between vertices {} and {}, "
      "at most {} m is rounding",
      face, describe(data, worst_vertex), worst, worst_side.vertex[0], worst_side.vertex[1],
      tolerance));
}

void checkEdge(const PolyhedronData& data, const Edge& edge, double tolerance) {
  for (int side = 0; side < 2; ++side) {
    const Face& other = data.faces[at(edge.face[1 - side])];
    const std::int32_t next = vertexAfter(data, other, edge.ring[1 - side]);
    if (height(data, edge.face[side], next) > tolerance) {
      refuseWorst(data, "is not convex", tolerance);
    }
    const Face& own = data.faces[at(edge.face[side])];
    const Vector3 beyond = data.vertices[at(vertexAfter(data, own, edge.ring[side]))].p - edge.p;
    if (dot(edge.inward[side], beyond) < -tolerance) refuseFace(data, edge.face[side], tolerance);
  }
}

void checkPlane(const PolyhedronData& data, std::int32_t f, double tolerance) {
  const Face& face = data.faces[at(f)];
  double worst = 0.0;
  std::int32_t worst_vertex = 0;
  for (std::int32_t i = face.ring_begin; i < face.ring_begin + face.ring_count; ++i) {
    const std::int32_t vertex = vertexAfter(data, face, i);
    const double away = std::abs(height(data, f, vertex));
    if (away <= worst) continue;
    worst = away;
    worst_vertex = vertex;
  }
  if (worst <= tolerance) return;
  refusePolyhedron(
      fmt::format("face {} is not plane: {} lies {} m from its plane, at most {} m is rounding", f,
                  describe(data, worst_vertex), worst, tolerance));
}

/// How many faces a ray from the centre meets: one, unless the surface winds around twice. Goes
/// through the middle of face 0.
int windings(const PolyhedronData& data) {
  const Face& first = data.faces[0];
  Vector3 ray = Vector3::Zero();
  for (std::int32_t i = first.ring_begin; i < first.ring_begin + first.ring_count; ++i) {
    const Edge& edge = data.edges[at(data.ring_edge[at(i)])];
    ray += data.vertices[at(edge.vertex[0])].p + data.vertices[at(edge.vertex[1])].p;
  }
  ray = ray / (2.0 * first.ring_count) - data.center;
  int met = 0;
  for (const Face& face : data.faces) {
    const double slope = dot(face.normal, ray);
    if (!(slope > 0.0)) continue;
    const double scale = (face.offset - dot(face.normal, data.center)) / slope;
    const Vector3 hit = data.center + scale * ray;
    bool inside = true;
    for (std::int32_t i = face.ring_begin; inside && i < face.ring_begin + face.ring_count; ++i) {
      inside = dot(data.ring[at(i)].inward, hit) >= data.ring[at(i)].offset;
    }
    if (inside) ++met;
  }
  return met;
}

}  // namespace

void checkConvex(const PolyhedronData& data) {
  const double tolerance = slack(data);
  for (std::size_t f = 0; f < data.faces.size(); ++f) {
    const Face& face = data.faces[f];
    checkPlane(data, static_cast<std::int32_t>(f), tolerance);
    if (dot(face.normal, data.center) - face.offset >= 0.0) {
      refuseWorst(data, "the faces do not look outward from one inner point", tolerance);
    }
  }
  for (const Edge& edge : data.edges) checkEdge(data, edge, tolerance);
  const auto vertices = static_cast<long>(data.vertices.size());
  const auto edges = static_cast<long>(data.edges.size());
  const auto faces = static_cast<long>(data.faces.size());
  if (vertices - edges + faces != 2 || windings(data) != 1) {
    checkThickness(data, tolerance);
    refusePolyhedron("the surface is not one closed shell");
  }
}

std::int32_t climb(const PolyhedronData& data, std::int32_t start, const Vector3& direction) {
  const double u = direction.x();
  const double v = direction.y();
  const double w = direction.z();
  const PolyhedronData::Spoke* const fan = data.fan.data();
  const auto bound = static_cast<std::int32_t>(data.vertices.size());
  std::int32_t vertex = start;
  for (std::int32_t step = 0; step < bound; ++step) {
    const PolyhedronData::Vertex& here = data.vertices[at(vertex)];
    double best = 0.0;
    std::int32_t chosen = -1;
    for (std::int32_t i = here.fan_begin; i < here.fan_begin + here.fan_count; ++i) {
      const PolyhedronData::Spoke& spoke = fan[i];
      const double gain =
          ((spoke.direction.x() * u + spoke.direction.y() * v) + spoke.direction.z() * w) *
          spoke.length;
      if (gain > best) {
        best = gain;
        chosen = i;
      }
    }
    if (chosen < 0) break;
    vertex = data.fan_vertex[at(chosen)];
  }
  return vertex;
}

void fillSupportMap(PolyhedronData& data) {
  const auto count = static_cast<double>(data.vertices.size());
  data.support_cells = std::max(1, static_cast<std::int32_t>(std::sqrt(count / 6.0)));
  const std::int32_t n = data.support_cells;
  data.support_map.assign(at(6 * n * n), 0);
  std::int32_t vertex = 0;
  for (std::int32_t side = 0; side < 6; ++side) {
    for (std::int32_t i = 0; i < n; ++i) {
      for (std::int32_t k = 0; k < n; ++k) {
        const std::int32_t j = i % 2 == 0 ? k : n - 1 - k;  // to and fro: neighbours follow
        const double s = (2.0 * i + 1.0) / n - 1.0;
        const double t = (2.0 * j + 1.0) / n - 1.0;
        const double major = side % 2 == 0 ? 1.0 : -1.0;
        const Vector3 directions[3] = {{major, s, t}, {t, major, s}, {s, t, major}};
        vertex = climb(data, vertex, directions[side / 2]);
        data.support_map[at((side * n + i) * n + j)] = vertex;
      }
    }
  }
}

}  // namespace hovercraft
