#pragma once

#include <optional>

#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/pilot/manoeuvre.h"
#include "hovercraft_sim/pilot/planar_motion.h"

/// Angles of turns, the same bits on every machine.
namespace hovercraft {

/// Direction of a heading in W, from x to the bow, positive to port.
struct Heading {
  double along = 1.0;   // x
  double across = 0.0;  // y
};
inline Heading headingOf(double angle) {
  return {exactCos(angle), exactSin(angle)};
}

/// The angle of (along, across), rad; 0 of (0, 0).
inline double angleOf(double across, double along) {
  return across == 0.0 && along == 0.0 ? 0.0 : exactAtan2(across, along);
}

/// How far a craft has turned to a side since a motion, rad.
inline double turned(const PlanarMotion& begin, const PlanarMotion& now, Side side) {
  const double to_port = now.heading - begin.heading;
  return side == Side::kPort ? to_port : -to_port;
}

/// Makes planar motions of those of a body. Counts whole turns by the yaw rate: between two motions
/// that it sees, the mean of theirs must lead to less than half a turn from where the craft is.
class HOVERCRAFT_PUBLIC MotionWatch {
 public:
  /// @param time s. @param p_WB m. @param q_WB unit. @param v_WB m/s, in W. @param w_WB rad/s, in
  /// W.
  PlanarMotion see(double time, const Vector3& p_WB, const Quaternion& q_WB, const Vector3& v_WB,
                   const Vector3& w_WB);

 private:
  std::optional<PlanarMotion> last_;
};

}  // namespace hovercraft
