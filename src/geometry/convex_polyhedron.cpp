#include "hovercraft_sim/geometry/convex_polyhedron.h"

#include "hovercraft_sim/geometry/polyhedron_builder.h"
#include "hovercraft_sim/geometry/support_map.h"
#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {

ConvexPolyhedron::ConvexPolyhedron(const std::vector<Vector3>& vertices, const Rings& rings) {
  const FloatingPointEnvironment environment;
  data_ = buildPolyhedron(vertices, rings);
  checkConvex(data_);
  fillSupportMap(data_);
}

std::vector<Vector3> ConvexPolyhedron::vertices() const {
  std::vector<Vector3> points;
  points.reserve(data_.vertices.size());
  for (const auto& vertex : data_.vertices) points.push_back(vertex.p);
  return points;
}

std::vector<std::int32_t> ConvexPolyhedron::verticesOf(Feature feature) const {
  if (feature.kind == FeatureKind::kVertex) return {feature.index};
  if (feature.kind == FeatureKind::kEdge) {
    const PolyhedronData::Edge& e = edge(feature.index);
    return {e.vertex[0], e.vertex[1]};
  }
  std::vector<std::int32_t> result;
  const PolyhedronData::Face& f = face(feature.index);
  for (std::int32_t i = f.ring_begin; i < f.ring_begin + f.ring_count; ++i) {
    const PolyhedronData::Edge& e = edge(data_.ring_edge[at(i)]);
    result.push_back(e.vertex[e.ring[0] == i ? 0 : 1]);
  }
  return result;
}

std::vector<VoronoiPlane> ConvexPolyhedron::voronoiPlanes(Feature feature) const {
  std::vector<VoronoiPlane> planes;
  if (feature.kind == FeatureKind::kVertex) {
    const PolyhedronData::Vertex& v = data_.vertices[at(feature.index)];
    for (std::int32_t i = v.fan_begin; i < v.fan_begin + v.fan_count; ++i) {
      const Vector3& direction = data_.fan[at(i)].direction;
      planes.push_back(
          {direction, dot(direction, v.p), Feature{FeatureKind::kEdge, data_.fan_edge[at(i)] / 2}});
    }
  } else if (feature.kind == FeatureKind::kEdge) {
    const PolyhedronData::Edge& e = edge(feature.index);
    const double start = dot(e.direction, e.p);
    planes.push_back({-e.direction, -start, Feature{FeatureKind::kVertex, e.vertex[0]}});
    planes.push_back({e.direction, start + e.length, Feature{FeatureKind::kVertex, e.vertex[1]}});
    for (int side = 0; side < 2; ++side) {
      planes.push_back(
          {e.inward[side], dot(e.inward[side], e.p), Feature{FeatureKind::kFace, e.face[side]}});
    }
  } else {
    const PolyhedronData::Face& f = face(feature.index);
    for (std::int32_t i = f.ring_begin; i < f.ring_begin + f.ring_count; ++i) {
      const PolyhedronData::RingPlane& plane = data_.ring[at(i)];
      planes.push_back(
          {-plane.inward, -plane.offset, Feature{FeatureKind::kEdge, data_.ring_edge[at(i)]}});
    }
    planes.push_back({-f.normal, -f.offset, std::nullopt});
  }
  return planes;
}

int ConvexPolyhedron::supportVertex(const Vector3& direction) const {
  return climb(data_, supportSeed(data_, direction), direction);
}

int ConvexPolyhedron::supportVertexFrom(int start, const Vector3& direction) const {
  return climb(data_, start, direction);
}

std::size_t ConvexPolyhedron::memory() const {
  const auto bytes = [](const auto& array) { return array.capacity() * sizeof(array[0]); };
  return sizeof(*this) + bytes(data_.vertices) + bytes(data_.edges) + bytes(data_.faces) +
         bytes(data_.ring) + bytes(data_.ring_edge) + bytes(data_.fan) + bytes(data_.fan_edge) +
         bytes(data_.fan_vertex) + bytes(data_.support_map) + bytes(data_.inner);
}

}  // namespace hovercraft
