#pragma once

#include <memory>

#include "hovercraft_sim/cushion/height_map.h"
#include "hovercraft_sim/geometry/pose.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/sensors/ray_scene.h"

namespace hovercraft {

/// The ground that rays may hit: a plane, or a map of heights, bilinear within each mesh.
class HOVERCRAFT_PUBLIC RayGround {
 public:
  /// @param plane nhat_W of length 1, pointing up.
  explicit RayGround(const GroundPlane& plane) : plane_(plane) {}
  /// @param map that is not null.
  explicit RayGround(std::shared_ptr<const HeightMapGround> map);
  /// A map of its own.
  explicit RayGround(const HeightGrid& grid);

  /// The nearest hit of each beam, as castBeams(); of a map exact within each mesh, where the
  /// height along a beam is a quadratic. A beam that starts below hits at 0.
  void cast(const BeamFan& fan, const Pose& X_WS, double farthest, double* ranges) const;

 private:
  double hitPlane(const Vector3& p_W, const Vector3& direction_W) const;
  double hitMap(const Vector3& p_W, const Vector3& direction_W, double farthest) const;
  double heightOver(const Vector3& p_W) const;

  GroundPlane plane_;
  std::shared_ptr<const HeightMapGround> map_;  // none: a plane
  double highest_ = 0.0;                        // m, of the map
};

}  // namespace hovercraft
