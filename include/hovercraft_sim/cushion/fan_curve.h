#pragma once

#include <cmath>

namespace hovercraft {

/// A lift fan at its nominal speed: rise of pressure p = a + b Q - c Q|Q|, with the flow Q. (5)
/// (Yun and Bliault, Theory and Design of Air Cushion Craft, p. 80.) At a share s of that speed the
/// fan laws make it s² a + s b Q - c Q|Q|. Falls strictly if b < 0 or c > 0.
struct FanCurve {
  double shutoff = 0.0;  // a, Pa, > 0: pressure without flow
  double slope = 0.0;    // b, Pa s/m³, <= 0
  double curve = 0.0;    // c, Pa s²/m⁶, >= 0
};

/// A fan at a speed, as cells ask for it.
struct FanAtSpeed {
  double shutoff = 0.0;       // s² a, Pa
  double root_shutoff = 0.0;  // s sqrt(a)
  double slope = 0.0;         // s b, Pa s/m³
  double curve = 0.0;         // c, Pa s²/m⁶
  double free_flow = 0.0;     // against no pressure, m³/s
};

/// The flow against a pressure, m³/s; reversed (< 0) if the pressure is above that without flow:
///   Q = 2 D/(|s b| + sqrt(s² b² + 4 c |D|)),  D = s² a - p. (6)
/// 0 where nothing resists (a fan without curve that stands).
inline double fanFlow(double shutoff, double slope, double curve, double pressure) {
  const double excess = shutoff - pressure;
  const double resistance =
      std::abs(slope) + std::sqrt(slope * slope + 4.0 * curve * std::abs(excess));
  return resistance > 0.0 ? 2.0 * excess / resistance : 0.0;
}
inline double fanFlow(const FanAtSpeed& fan, double pressure) {
  return fanFlow(fan.shutoff, fan.slope, fan.curve, pressure);
}

/// -dQ/dp of the flow of a fan at a flow Q, m³/(s Pa): 1/(|s b| + 2 c |Q|).
inline double fanFlowSlope(const FanAtSpeed& fan, double flow) {
  return 1.0 / (std::abs(fan.slope) + 2.0 * fan.curve * std::abs(flow));
}

/// @param speed s, share of the nominal speed, >= 0.
inline FanAtSpeed atSpeed(const FanCurve& fan, double speed) {
  FanAtSpeed turning;
  turning.shutoff = (speed * speed) * fan.shutoff;
  turning.root_shutoff = speed * std::sqrt(fan.shutoff);
  turning.slope = speed * fan.slope;
  turning.curve = fan.curve;
  turning.free_flow = fanFlow(turning, 0.0);
  return turning;
}

}  // namespace hovercraft
