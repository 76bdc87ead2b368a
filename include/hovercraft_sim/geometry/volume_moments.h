#pragma once

#include "hovercraft_sim/geometry/triangle_mesh.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// Moments of the volume inside a closed surface, in the frame of the surface.
struct VolumeMoments {
  double volume = 0.0;                              // m³
  Vector3 centroid = Vector3::Zero();               // m
  Matrix3 second_about_centroid = Matrix3::Zero();  // ∫ r rᵀ dV, r from the centroid, m⁵
};

/// Exact integrals over a polyhedron: the sum over the signed tetrahedra that its triangles span
/// with a point (the divergence theorem), each by the closed form of Blow and Binstock (2004), "How
/// to find the inertia tensor (or other mass properties) of a 3D solid body represented by a
/// triangle mesh". The point is the centroid itself, so that nothing cancels far from the origin.
/// @param mesh passes checkClosed(). @throws std::logic_error if its volume is not positive.
HOVERCRAFT_PUBLIC VolumeMoments volumeMoments(const TriangleMesh& mesh);

/// The volume alone, m³: negative for a surface that is inside out, 0 for one without triangles.
HOVERCRAFT_PUBLIC double signedVolume(const TriangleMesh& mesh);

}  // namespace hovercraft
