#pragma once

#include <vector>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/cushion/body_motion.h"
#include "hovercraft_sim/cushion/ground.h"
#include "hovercraft_sim/cushion/ground_spring.h"
#include "hovercraft_sim/cushion/mirror_pairs.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// How hulls stand on ground that is no polyhedron: each vertex is a spring.
struct PadParameters {
  double sink = 1e-3;  // m: how deep a body sinks that four of its vertices carry
  GroundSpring spring = {10.0, 0.5, 0.02};  // of a vertex
};

/// The vertices of a body's hull as springs on the ground.
class HOVERCRAFT_PUBLIC Pads {
 public:
  Pads() = default;
  /// @param vertices_B of the hull, m. @param weight m g, N: four vertices that sink by the
  /// parameters' sink carry it.
  Pads(const std::vector<Vector3>& vertices_B, double weight, const PadParameters& parameters);

  /// Whether it has no vertices: nothing acts then.
  bool empty() const { return vertices_B_.empty(); }
  /// The wrench on the body about its centre of mass, in B.
  Wrench wrenchInBody(const BodyMotion& motion, const Ground& ground) const;

  double stiffness() const { return stiffness_; }         // N/m, of a vertex
  const GroundSpring& spring() const { return spring_; }  // of the parameters
  /// In B, m: mirrored pairs first, one after the other, then those alone.
  const std::vector<Vector3>& vertices() const { return vertices_B_; }
  std::size_t pairedCount() const { return paired_; }  // of so many vertices
  /// The box around the vertices, in B, m.
  const Vector3& middle() const { return middle_B_; }
  const Vector3& halfExtent() const { return half_extent_; }  // from the middle to the sides

 private:
  Wrench wrenchOf(const Vector3& p_B, const BodyMotion& motion, const GroundSample& sample) const;

  void surround();
  bool isClearOf(const GroundPlane& plane, const BodyMotion& motion) const;

  std::vector<Vector3> vertices_B_;        // mirrored pairs first: one after the other
  std::size_t paired_ = 0;                 // of so many
  Vector3 middle_B_ = Vector3::Zero();     // m, of the box around the vertices
  Vector3 half_extent_ = Vector3::Zero();  // m
  double stiffness_ = 0.0;
  GroundSpring spring_;
};

}  // namespace hovercraft
