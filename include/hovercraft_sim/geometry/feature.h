#pragma once

#include <cstdint>
#include <optional>

#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// What a boundary is made of. A polygon has no faces.
enum class FeatureKind : std::uint8_t { kVertex, kEdge, kFace };

/// One feature of a polygon or polyhedron. Features are relatively open: an edge does not hold its
/// end points, a face not its edges, so that every boundary point belongs to exactly one.
struct Feature {
  FeatureKind kind = FeatureKind::kVertex;  // vertex, edge or face
  std::int32_t index = 0;                   // among those of its kind

  /// The same feature of one body.
  bool operator==(const Feature& other) const { return kind == other.kind && index == other.index; }
  bool operator!=(const Feature& other) const { return !(*this == other); }  // its opposite
};

/// One side of a Voronoi region: the region lies in normal · x <= offset.
struct VoronoiPlane {
  Vector3 normal = Vector3::Zero();  // unit
  double offset = 0.0;               // m
  std::optional<Feature> behind;     // whose region lies behind the plane; none: the body itself
};

}  // namespace hovercraft
