#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hovercraft_sim/geometry/feature.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/index.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The arrays of a convex polyhedron, packed by the feature that a query stands on: what is tested
/// together lies together. All coordinates in the frame of the polyhedron, m.
struct PolyhedronData {
  /// From this many on, the edges of a face or a vertex are searched from the last one instead of
  /// looked at one by one.
  static constexpr std::int32_t kLongLoop = 16;

  struct Vertex {
    Vector3 p;               // place, m
    std::int32_t fan_begin;  // its edges: fan[fan_begin] ... counter-clockwise seen from outside
    std::int32_t fan_count;  // how many edges
    std::int32_t apex;       // where inner[] holds its axis, if fan_count > kLongLoop; else -1
  };

  /// An edge from vertex[0] to vertex[1]; seen from outside face[0] lies to its left, face[1] to
  /// its right. Two cache lines.
  struct alignas(64) Edge {
    Vector3 p;          // of vertex[0]
    Vector3 direction;  // unit, to vertex[1]
    double length;      // m
    Vector3 inward[2];  // unit, in face[i] and at right angles to the edge, into the face: the
                        // Voronoi plane between the edge and the face
    std::int32_t vertex[2];
    std::int32_t face[2];  // on its two sides
    std::int32_t ring[2];  // where the edge stands in the ring of face[i]
  };

  /// One cache line.
  struct alignas(64) Face {
    Vector3 normal;           // unit, outward
    double offset;            // m, normal · x = offset on the face
    std::int32_t ring_begin;  // its edges: ring[ring_begin] ... counter-clockwise from outside
    std::int32_t ring_count;  // how many edges
    std::int32_t middle;      // where inner[] holds its middle, if ring_count > kLongLoop; else -1
  };

  /// An edge as its face sees it: inside where inward · x >= offset.
  struct alignas(32) RingPlane {
    Vector3 inward;
    double offset;
  };

  /// An edge as one of its vertices sees it.
  struct alignas(32) Spoke {
    Vector3 direction;  // unit, away from the vertex
    double length;      // m
  };

  /// The inside of a face or a vertex of many edges.
  struct Inner {
    Vector3 point;  // of a face: m, its middle; of a vertex: unit, at acute angles with its spokes
    double least;   // m, distance of the middle from the nearest side; of a vertex: the cosine of
                    // its largest angle with a spoke
  };

  std::vector<Vertex> vertices;  // their places and fans
  std::vector<Edge> edges;       // each once
  std::vector<Face> faces;       // their planes and rings
  std::vector<RingPlane> ring;
  std::vector<std::int32_t> ring_edge;   // of each ring plane
  std::vector<Spoke> fan;                // of all vertices, one vertex after another
  std::vector<std::int32_t> fan_edge;    // of each spoke: 2 edge + (0 leaving vertex[0], else 1)
  std::vector<std::int32_t> fan_vertex;  // of each spoke: the vertex at its other end
  std::vector<std::int32_t>
      support_map;                   // support vertex for the middle of each cell of a cube map
  std::vector<Inner> inner;          // of long faces and long vertices only
  std::int32_t support_cells = 0;    // cells along an edge of the cube
  double radius = 0.0;               // m, greatest distance of a vertex from the origin
  Vector3 center = Vector3::Zero();  // mean of the vertices, inside
};

/// A convex polyhedron: vertices, edges and faces with their adjacency, and the planes of their
/// Voronoi regions. Invariants, checked when made: closed, of one piece, faces plane and outward,
/// convex, no vertex twice. It does not change afterwards.
///
/// Faces are taken as they are given: two that lie in one plane stay two, and a vertex may lie on
/// the line between its neighbours in a ring. It is convexHull() and polyhedronFromMesh() that make
/// one face of what is coplanar and leave out the vertices on its edges.
class HOVERCRAFT_PUBLIC ConvexPolyhedron {
 public:
  /// @param vertices m. @param rings the vertices of each face, counter-clockwise seen from
  /// outside.
  /// @throws std::invalid_argument naming the vertex or face that breaks an invariant.
  ConvexPolyhedron(const std::vector<Vector3>& vertices,
                   const std::vector<std::vector<std::int32_t>>& rings);

  const PolyhedronData& data() const { return data_; }                         // as queries read it
  int vertexCount() const { return static_cast<int>(data_.vertices.size()); }  // how many
  int edgeCount() const { return static_cast<int>(data_.edges.size()); }       // how many
  int faceCount() const { return static_cast<int>(data_.faces.size()); }       // how many
  const Vector3& vertex(int index) const { return data_.vertices[at(index)].p; }
  /// All of them, m, in their order.
  std::vector<Vector3> vertices() const;
  /// @param index 0 to edgeCount() - 1
  const PolyhedronData::Edge& edge(int index) const { return data_.edges[at(index)]; }
  /// @param index 0 to faceCount() - 1
  const PolyhedronData::Face& face(int index) const { return data_.faces[at(index)]; }

  /// The vertices of a feature; of a face counter-clockwise seen from outside.
  std::vector<std::int32_t> verticesOf(Feature feature) const;

  /// The planes that bound the Voronoi region of a feature, each with the feature behind it.
  std::vector<VoronoiPlane> voronoiPlanes(Feature feature) const;

  /// A vertex farthest along `direction` (any length but zero): from the cube map, then uphill over
  /// the edges. No allocation.
  int supportVertex(const Vector3& direction) const;

  /// The same, uphill from a vertex that is thought to be near.
  int supportVertexFrom(int start, const Vector3& direction) const;

  /// Bytes of all arrays, the Voronoi planes and the cube map included.
  std::size_t memory() const;

 private:
  PolyhedronData data_;
};

}  // namespace hovercraft
