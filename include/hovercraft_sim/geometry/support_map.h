#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "hovercraft_sim/geometry/convex_polyhedron.h"

namespace hovercraft {

/// The vertex that the cube map of a polyhedron holds for a direction (any length but zero): the
/// support vertex of a direction near to it, from which a climb is short.
inline std::int32_t supportSeed(const PolyhedronData& data, const Vector3& direction) {
  const double ax = std::abs(direction.x());
  const double ay = std::abs(direction.y());
  const double az = std::abs(direction.z());
  std::int32_t side = 0;
  double major = direction.x();
  double s = direction.y();
  double t = direction.z();
  if (ay > ax && ay >= az) {
    side = 2;
    major = direction.y();
    s = direction.z();
    t = direction.x();
  } else if (az > ax && az > ay) {
    side = 4;
    major = direction.z();
    s = direction.x();
    t = direction.y();
  }
  if (!(std::abs(major) > 0.0 && ax + ay + az <= std::numeric_limits<double>::max())) return 0;
  if (major < 0.0) side += 1;
  const double middle = 0.5 * data.support_cells;
  const double scale = middle / std::abs(major);
  const std::int32_t last = data.support_cells - 1;
  const std::int32_t i = std::min(last, static_cast<std::int32_t>(s * scale + middle));
  const std::int32_t j = std::min(last, static_cast<std::int32_t>(t * scale + middle));
  const std::int32_t cell = (side * data.support_cells + i) * data.support_cells + j;
  return data.support_map[static_cast<std::size_t>(cell)];
}

}  // namespace hovercraft
