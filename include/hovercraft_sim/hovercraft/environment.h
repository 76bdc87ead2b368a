#pragma once

#include <optional>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The ground below a point: the plane that touches it there.
struct GroundPoint {
  double height = 0.0;                // m: z in W of the ground on the vertical line of the point
  Vector3 nhat_W = Vector3::UnitZ();  // unit normal, upward: z > 0
};

/// The ground as forces see it. It does not change during a step, and the same point gives the same
/// bits whatever was asked before.
class HOVERCRAFT_PUBLIC Ground {
 public:
  Ground() = default;
  Ground(const Ground&) = default;
  Ground(Ground&&) = default;
  Ground& operator=(const Ground&) = default;
  Ground& operator=(Ground&&) = default;
  virtual ~Ground() = default;

  /// The highest ground that is not above a point. @param p_W m. @returns none: there is no ground
  /// below it. Allocates nothing.
  [[nodiscard]] virtual std::optional<GroundPoint> under(const Vector3& p_W) const = 0;
};

/// What surrounds a body during a step.
struct Environment {
  Vector3 wind_W = Vector3::Zero();  // velocity of the air, m/s
  const Ground* ground = nullptr;    // none; must outlive the step
};

}  // namespace hovercraft
