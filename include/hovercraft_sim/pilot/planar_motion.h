#pragma once

namespace hovercraft {

/// How a craft moves in the plane, as a pilot sees it: of its centre of mass, W world.
struct PlanarMotion {
  double time = 0.0;      // s
  double x = 0.0;         // m, in W
  double y = 0.0;         // m, in W
  double heading = 0.0;   // rad from x to the bow, positive to port, not wrapped at a half turn
  double surge = 0.0;     // m/s ahead
  double sway = 0.0;      // m/s to port
  double yaw_rate = 0.0;  // rad/s, positive to port
};

}  // namespace hovercraft
