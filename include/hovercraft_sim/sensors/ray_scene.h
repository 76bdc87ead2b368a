#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/geometry/pose.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// A half space n·x <= offset.
struct HalfSpace {
  Vector3 normal;  // unit, outward
  double offset;   // m
};

/// A convex body that rays may hit: the half spaces of its faces, and a ball around it.
struct HOVERCRAFT_PUBLIC RayTarget {
  /// @param moving index of the moving body that it is; kFixed: it stands at X_WT.
  RayTarget(const ConvexPolyhedron& polyhedron, std::int32_t moving_body,
            const Pose& place = Pose());

  HOVERCRAFT_HIDDEN static constexpr std::int32_t kFixed = -1;  // no index
  std::int32_t moving = kFixed;                                 // index of the body that it is
  Pose X_WT;                                                    // of a fixed one
  std::vector<HalfSpace> faces;                                 // in T
  Vector3 center_T;                                             // m, of the ball
  double radius = 0.0;                                          // m, of the ball around the center
};

/// The beams of a scanner: directions in the xy plane of its frame S.
struct BeamFan {
  std::vector<double> cosines;  // of the angles from x
  std::vector<double> sines;    // of the same
};

/// The nearest hit of each beam with one target: t_in = max over entering faces, t_out = min over
/// leaving ones, hit if t_in <= t_out and t_out >= 0; a beam that starts inside hits at 0.
/// @param X_WS pose of the scanner. @param X_WT pose of the target. @param farthest m: a target
/// beyond is skipped. @param faces scratch of at least as many as the target has.
/// @param ranges of all beams, m: each is lowered to the hit.
HOVERCRAFT_PUBLIC void castBeams(const BeamFan& fan, const Pose& X_WS, const RayTarget& target,
                                 const Pose& X_WT, double farthest, std::vector<HalfSpace>& faces,
                                 double* ranges);

}  // namespace hovercraft
