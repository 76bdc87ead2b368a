#include "hovercraft_sim/geometry/polyhedron_builder.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "hovercraft_sim/geometry/coordinates.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/double_double.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {
namespace {

using Edge = PolyhedronData::Edge;
using Face = PolyhedronData::Face;
using Inner = PolyhedronData::Inner;

void checkVertices(const std::vector<Vector3>& vertices) {
  if (vertices.size() < 4) {
    refusePolyhedron(fmt::format("has {} vertices, a solid has at least 4", vertices.size()));
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (!vertices[i].allFinite()) refusePolyhedron(fmt::format("vertex {} is not finite", i));
  }
  std::vector<std::size_t> order(vertices.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto less = [&](std::size_t a, std::size_t b) {
    const Vector3& u = vertices[a];
    const Vector3& v = vertices[b];
    if (u.x() != v.x()) return u.x() < v.x();
    if (u.y() != v.y()) return u.y() < v.y();
    return u.z() < v.z();
  };
  std::sort(order.begin(), order.end(), less);
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (vertices[order[i - 1]] == vertices[order[i]]) {
      refusePolyhedron(
          fmt::format("vertices {} and {} are both at {}", std::min(order[i - 1], order[i]),
                      std::max(order[i - 1], order[i]), coordinates(vertices[order[i]])));
    }
  }
}

void checkRings(const std::vector<Vector3>& vertices, const Rings& rings) {
  const auto count = static_cast<std::int32_t>(vertices.size());
  std::vector<char> used(vertices.size(), 0);
  for (std::size_t f = 0; f < rings.size(); ++f) {
    if (rings[f].size() < 3) refusePolyhedron(fmt::format("face {} has fewer than 3 vertices", f));
    for (const std::int32_t v : rings[f]) {
      if (v < 0 || v >= count) {
        refusePolyhedron(fmt::format("face {} names vertex {} of {}", f, v, count));
      }
      used[at(v)] = 1;
    }
  }
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end()) {
    refusePolyhedron(fmt::format("vertex {} belongs to no face", unused - used.begin()));
  }
}

/// From this many vertices on, what lies near each other on the surface is put near each other in
/// memory: below it all is in the nearest cache anyway.
constexpr std::size_t kSpreadOut = 256;

/// The place of each vertex on a curve that fills space (Morton 1966): the bits of its coordinates,
/// one of each in turn. A walk over the surface then stays within a few pages of the arrays.
std::vector<std::int32_t> ranksOf(const std::vector<Vector3>& vertices) {
  std::vector<std::int32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  if (vertices.size() < kSpreadOut) return order;
  constexpr std::uint32_t bits = 10;
  constexpr std::uint32_t last_cell = (1U << bits) - 1U;
  Vector3 low = vertices[0];
  Vector3 high = vertices[0];
  for (const Vector3& p : vertices) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::vector<std::uint32_t> codes(vertices.size(), 0);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = high[axis] - low[axis];
      const bool spread = extent > 0.0 && std::isfinite(extent);
      const double share = spread ? (vertices[v][axis] - low[axis]) / extent : 0.0;
      const auto cell = static_cast<std::uint32_t>(share * last_cell);
      for (std::uint32_t bit = 0; bit < bits; ++bit) {
        codes[v] |= ((cell >> bit) & 1U) << (3U * bit + static_cast<std::uint32_t>(axis));
      }
    }
  }
  std::sort(order.begin(), order.end(), [&codes](std::int32_t a, std::int32_t b) {
    return codes[at(a)] != codes[at(b)] ? codes[at(a)] < codes[at(b)] : a < b;
  });
  std::vector<std::int32_t> ranks(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) ranks[at(order[i])] = static_cast<std::int32_t>(i);
  return ranks;
}

/// Where the ring of each face begins: in the order of their first vertices along the curve.
std::vector<std::int32_t> ringBegins(const Rings& rings, const std::vector<std::int32_t>& ranks) {
  std::vector<std::pair<std::int32_t, std::size_t>> order;
  for (std::size_t f = 0; f < rings.size(); ++f) {
    std::int32_t first = ranks[at(rings[f][0])];
    for (const std::int32_t v : rings[f]) first = std::min(first, ranks[at(v)]);
    order.emplace_back(first, f);
  }
  if (ranks.size() >= kSpreadOut) std::sort(order.begin(), order.end());
  std::vector<std::int32_t> begins(rings.size());
  std::int32_t position = 0;
  for (const auto& [first, f] : order) {
    begins[f] = position;
    position += static_cast<std::int32_t>(rings[f].size());
  }
  return begins;
}

/// One side of one face.
struct HalfEdge {
  std::int32_t low;  // its vertices, ordered
  std::int32_t high;
  std::int32_t face;
  std::int32_t ring;        // position in PolyhedronData::ring
  bool forward;             // runs from low to high
  std::int32_t first_rank;  // of its vertices
  std::int32_t second_rank;
};

std::vector<HalfEdge> sortedHalfEdges(const PolyhedronData& data, const Rings& rings,
                                      const std::vector<std::int32_t>& ranks) {
  std::vector<HalfEdge> halves;
  for (std::size_t f = 0; f < rings.size(); ++f) {
    for (std::size_t i = 0; i < rings[f].size(); ++i) {
      const std::int32_t from = rings[f][i];
      const std::int32_t to = rings[f][(i + 1) % rings[f].size()];
      const std::int32_t rank_from = ranks[at(from)];
      const std::int32_t rank_to = ranks[at(to)];
      halves.push_back({std::min(from, to), std::max(from, to), static_cast<std::int32_t>(f),
                        data.faces[f].ring_begin + static_cast<std::int32_t>(i), from < to,
                        std::min(rank_from, rank_to), std::max(rank_from, rank_to)});
    }
  }
  std::sort(halves.begin(), halves.end(), [](const HalfEdge& a, const HalfEdge& b) {
    if (a.first_rank != b.first_rank) return a.first_rank < b.first_rank;
    if (a.second_rank != b.second_rank) return a.second_rank < b.second_rank;
    return a.forward && !b.forward;
  });
  return halves;
}

/// Twice the area of a face times its normal: the sum over the triangles from its first vertex.
struct Area {
  Vector3 vector = Vector3::Zero();
  double products = 0.0;  // of the lengths of the sides that were multiplied: what rounding counts
};

Area areaOf(const std::vector<Vector3>& vertices, const std::vector<std::int32_t>& ring) {
  Area area;
  const Vector3& origin = vertices[at(ring[0])];
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Vector3 a = vertices[at(ring[i])] - origin;
    const Vector3 b = vertices[at(ring[i + 1])] - origin;
    area.vector += cross(a, b);
    area.products += norm(a) * norm(b);
  }
  return area;
}

/// The same of 106 bits, rounded at the end: each component to half a unit in the last place.
Vector3 preciseArea(const std::vector<Vector3>& vertices, const std::vector<std::int32_t>& ring) {
  const PreciseVector origin(vertices[at(ring[0])]);
  PreciseVector area;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    area = area + cross(PreciseVector(vertices[at(ring[i])]) - origin,
                        PreciseVector(vertices[at(ring[i + 1])]) - origin);
  }
  return area.rounded();
}

/// The normal of a sliver is lost in rounding: over the length of the body its plane would miss
/// vertices that lie in it. It is summed more precisely.
Vector3 faceNormal(const std::vector<Vector3>& vertices, const std::vector<std::int32_t>& ring,
                   std::size_t index) {
  const Area area = areaOf(vertices, ring);
  const double size = norm(area.vector);
  if (size > kSliver * area.products) return area.vector / size;
  const Vector3 precise = preciseArea(vertices, ring);
  const double precise_size = norm(precise);
  if (!(precise_size > 0.0)) refusePolyhedron(fmt::format("face {} has no area", index));
  return precise / precise_size;
}

Face facePlane(const std::vector<Vector3>& vertices, const std::vector<std::int32_t>& ring,
               std::size_t index) {
  Face face{faceNormal(vertices, ring, index), 0.0, 0, static_cast<std::int32_t>(ring.size()), -1};
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const std::int32_t v : ring) {
    low = std::min(low, dot(face.normal, vertices[at(v)]));
    high = std::max(high, dot(face.normal, vertices[at(v)]));
  }
  face.offset = 0.5 * (low + high);
  return face;
}

void addEdge(PolyhedronData& data, const HalfEdge& a, const HalfEdge& b) {
  Edge edge{};
  edge.vertex[0] = a.low;
  edge.vertex[1] = a.high;
  edge.p = data.vertices[at(a.low)].p;
  const Vector3 along = data.vertices[at(a.high)].p - edge.p;
  edge.length = norm(along);
  edge.direction = along / edge.length;
  const HalfEdge* const halves[2] = {&a, &b};
  for (int side = 0; side < 2; ++side) {
    const HalfEdge& half = *halves[side];
    const Vector3 along_ring = side == 0 ? edge.direction : Vector3(-edge.direction);
    const Vector3 inward = cross(data.faces[at(half.face)].normal, along_ring);
    edge.face[side] = half.face;
    edge.ring[side] = half.ring;
    edge.inward[side] = inward / norm(inward);
    data.ring[at(half.ring)] = {edge.inward[side], dot(edge.inward[side], edge.p)};
    data.ring_edge[at(half.ring)] = static_cast<std::int32_t>(data.edges.size());
  }
  data.edges.push_back(edge);
}

void addEdges(PolyhedronData& data, const Rings& rings, const std::vector<std::int32_t>& ranks) {
  const std::vector<HalfEdge> halves = sortedHalfEdges(data, rings, ranks);
  data.ring.resize(halves.size());
  data.ring_edge.resize(halves.size());
  data.edges.reserve(halves.size() / 2);
  for (std::size_t i = 0; i < halves.size(); i += 2) {
    const HalfEdge& a = halves[i];
    const bool paired = i + 1 < halves.size() && halves[i + 1].low == a.low &&
                        halves[i + 1].high == a.high && a.forward && !halves[i + 1].forward;
    const bool thrice = paired && i + 2 < halves.size() && halves[i + 2].low == a.low &&
                        halves[i + 2].high == a.high;
    if (!paired || thrice) {
      refusePolyhedron(
          fmt::format("the edge between vertices {} and {} does not belong to exactly two faces "
                      "that run through it in opposite directions",
                      a.low, a.high));
    }
    addEdge(data, a, halves[i + 1]);
  }
}

/// For each vertex an edge that leaves it, as in PolyhedronData::fan_edge.
std::vector<std::int32_t> firstSpokes(const PolyhedronData& data) {
  std::vector<std::int32_t> first(data.vertices.size(), -1);
  for (std::size_t e = 0; e < data.edges.size(); ++e) {
    for (int side = 0; side < 2; ++side) {
      std::int32_t& start = first[at(data.edges[e].vertex[side])];
      if (start < 0) start = static_cast<std::int32_t>(2 * e) + side;
    }
  }
  return first;
}

/// The spoke that follows counter-clockwise around `vertex`: the edge before this one in the ring
/// of its left face ends here, so its other way leaves.
std::int32_t nextSpoke(const PolyhedronData& data, std::int32_t half, std::int32_t vertex) {
  const Edge& edge = data.edges[at(half / 2)];
  const Face& face = data.faces[at(edge.face[half % 2])];
  const std::int32_t position = edge.ring[half % 2];
  const bool wraps = position == face.ring_begin;
  const std::int32_t previous = wraps ? position + face.ring_count - 1 : position - 1;
  const std::int32_t e = data.ring_edge[at(previous)];
  return 2 * e + (data.edges[at(e)].vertex[0] == vertex ? 0 : 1);
}

void addFans(PolyhedronData& data, const std::vector<std::int32_t>& ranks) {
  const std::vector<std::int32_t> first = firstSpokes(data);
  std::vector<std::int32_t> order(ranks.size());
  for (std::size_t v = 0; v < ranks.size(); ++v) order[at(ranks[v])] = static_cast<std::int32_t>(v);
  data.fan.reserve(2 * data.edges.size());
  data.fan_edge.reserve(2 * data.edges.size());
  data.fan_vertex.reserve(2 * data.edges.size());
  for (const std::int32_t v : order) {
    const auto begin = static_cast<std::int32_t>(data.fan.size());
    std::int32_t half = first[at(v)];
    do {
      const Edge& edge = data.edges[at(half / 2)];
      const Vector3 direction = half % 2 == 0 ? edge.direction : Vector3(-edge.direction);
      data.fan.push_back({direction, edge.length});
      data.fan_edge.push_back(half);
      data.fan_vertex.push_back(edge.vertex[1 - half % 2]);
      half = nextSpoke(data, half, v);
    } while (half != first[at(v)]);
    data.vertices[at(v)].fan_begin = begin;
    data.vertices[at(v)].fan_count = static_cast<std::int32_t>(data.fan.size()) - begin;
  }
  if (data.fan.size() != 2 * data.edges.size())
    refusePolyhedron("the surface touches itself in a vertex");
}

/// A point inside each face of many edges, and a direction inside the cone of each vertex of many:
/// against the normals of its faces.
void addInner(PolyhedronData& data) {
  for (Face& face : data.faces) {
    if (face.ring_count <= PolyhedronData::kLongLoop) continue;
    Vector3 sum = Vector3::Zero();
    for (std::int32_t i = face.ring_begin; i < face.ring_begin + face.ring_count; ++i) {
      const Edge& edge = data.edges[at(data.ring_edge[at(i)])];
      sum += data.vertices[at(edge.vertex[0])].p + data.vertices[at(edge.vertex[1])].p;
    }
    Inner inner{sum / (2.0 * face.ring_count), std::numeric_limits<double>::infinity()};
    for (std::int32_t i = face.ring_begin; i < face.ring_begin + face.ring_count; ++i) {
      const PolyhedronData::RingPlane& side = data.ring[at(i)];
      inner.least = std::min(inner.least, dot(side.inward, inner.point) - side.offset);
    }
    face.middle = static_cast<std::int32_t>(data.inner.size());
    data.inner.push_back(inner);
  }
  for (PolyhedronData::Vertex& vertex : data.vertices) {
    if (vertex.fan_count <= PolyhedronData::kLongLoop) continue;
    Vector3 sum = Vector3::Zero();
    for (std::int32_t i = vertex.fan_begin; i < vertex.fan_begin + vertex.fan_count; ++i) {
      const std::int32_t half = data.fan_edge[at(i)];
      sum -= data.faces[at(data.edges[at(half / 2)].face[half % 2])].normal;
    }
    Inner inner{sum / norm(sum), std::numeric_limits<double>::infinity()};
    for (std::int32_t i = vertex.fan_begin; i < vertex.fan_begin + vertex.fan_count; ++i) {
      inner.least = std::min(inner.least, dot(data.fan[at(i)].direction, inner.point));
    }
    vertex.apex = static_cast<std::int32_t>(data.inner.size());
    data.inner.push_back(inner);
  }
}

}  // namespace

PolyhedronData buildPolyhedron(const std::vector<Vector3>& vertices, const Rings& rings) {
  checkVertices(vertices);
  checkRings(vertices, rings);
  PolyhedronData data;
  data.vertices.reserve(vertices.size());
  for (const Vector3& p : vertices) {
    data.vertices.push_back({p, 0, 0, -1});
    data.radius = std::max(data.radius, norm(p));
    data.center += p;
  }
  data.center /= static_cast<double>(vertices.size());
  const std::vector<std::int32_t> ranks = ranksOf(vertices);
  const std::vector<std::int32_t> ring_begins = ringBegins(rings, ranks);
  data.faces.reserve(rings.size());
  for (std::size_t f = 0; f < rings.size(); ++f) {
    data.faces.push_back(facePlane(vertices, rings[f], f));
    data.faces.back().ring_begin = ring_begins[f];
  }
  addEdges(data, rings, ranks);
  addFans(data, ranks);
  addInner(data);
  return data;
}

}  // namespace hovercraft
