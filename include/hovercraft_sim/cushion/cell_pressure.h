#pragma once

#include <cmath>

#include "hovercraft_sim/cushion/fan_curve.h"

namespace hovercraft {

/// Air of one cell.
struct CellAir {
  double pressure;  // p, Pa, over that of the surroundings
  double fan_flow;  // Q of its fan, m³/s
};

/// The root q >= 0 of c2 q² + c1 q + c0 with c0 <= 0, the nearest to 0; without loss of digits.
/// 0 if there is no resistance to tell it.
inline double nearestRoot(double c2, double c1, double c0) {
  const double sum = c1 + std::sqrt(c1 * c1 - 4.0 * c2 * c0);
  return sum > 0.0 ? -2.0 * c0 / sum : 0.0;
}

/// The pressure at which the fan gives what escapes and what the cell's growth takes up:
/// Q_fan(p) = k sign(p) sqrt|p| + u, in closed form. (7) It falls strictly in p, so that there is
/// one; the three cases join with a continuous slope. The escape k sign(p) sqrt|p| is that of a
/// sharp edged orifice. (4)
/// @param outflow k = C_d A sqrt(2/rho), m³/(s sqrt(Pa)), >= 0.
/// @param pumping u, m³/s: rate at which the cell's volume grows.
inline CellAir cellAir(const FanAtSpeed& fan, double outflow, double pumping) {
  const double k = outflow;
  const double u = pumping;
  const double c = fan.curve;
  const double B = fan.slope;
  const double A = fan.shutoff;
  if (u > fan.free_flow) {  // the cell grows faster than the fan blows: suction
    const double q =
        nearestRoot(1.0 - c * (k * k), k * (2.0 * c * u - B), (A + B * u) - c * (u * u));
    return {-(q * q), u - k * q};
  }
  if (u < -k * fan.root_shutoff) {  // it shrinks so fast that air goes back through the fan
    const double q =
        nearestRoot(1.0 - c * (k * k), -k * (2.0 * c * u + B), -((c * (u * u) + B * u) + A));
    return {q * q, u + k * q};
  }
  const double c2 = 1.0 + c * (k * k);
  const double c1 = k * (2.0 * c * u - B);
  const double c0 = (c * (u * u) - B * u) - A;
  const double root = std::sqrt(c1 * c1 - 4.0 * c2 * c0);
  // Of two forms the one that does not cancel.
  const double q = c1 > 0.0 ? -2.0 * c0 / (c1 + root) : (root - c1) / (2.0 * c2);
  return {q * q, u + k * q};
}

}  // namespace hovercraft
