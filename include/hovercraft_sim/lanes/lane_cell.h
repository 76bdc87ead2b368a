#pragma once

#include "hovercraft_sim/lanes/lane_vector.h"

/// Lift fans and the air of cells for packs: each function has the operations of the one of the
/// same name in cushion/fan_curve.h, gap.h and cell_pressure.h, in its order.

namespace hovercraft::lanes {

template <class Isa>
struct FanAtSpeed {
  NumberOf<Isa> shutoff, root_shutoff, slope, curve, free_flow;
};

template <class Isa>
struct CellAir {
  NumberOf<Isa> pressure, fan_flow;
};

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> fanFlow(const FanAtSpeed<Isa>& fan,
                                                    NumberOf<Isa> pressure) {
  using Number = NumberOf<Isa>;
  const Number excess = fan.shutoff - pressure;
  const Number square = fan.slope * fan.slope + same<Isa>(4.0) * fan.curve * absolute<Isa>(excess);
  const Number resistance = absolute<Isa>(fan.slope) + Isa::sqrt(square);
  return where<Isa>(resistance > Number{}, same<Isa>(2.0) * excess / resistance);
}

/// @param rows a, sqrt(a), b, c of the fan.
template <class Isa>
[[gnu::always_inline]] inline FanAtSpeed<Isa> atSpeed(const Row* rows, std::size_t first,
                                                      NumberOf<Isa> speed) {
  FanAtSpeed<Isa> turning;
  turning.shutoff = (speed * speed) * load<Isa>(rows[0], first);
  turning.root_shutoff = speed * load<Isa>(rows[1], first);
  turning.slope = speed * load<Isa>(rows[2], first);
  turning.curve = load<Isa>(rows[3], first);
  turning.free_flow = fanFlow<Isa>(turning, NumberOf<Isa>{});
  return turning;
}

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> leakArea(NumberOf<Isa> area_under_hem,
                                                     NumberOf<Isa> cell_area) {
  const NumberOf<Isa> share = area_under_hem / cell_area;
  return area_under_hem / Isa::sqrt(same<Isa>(1.0) + share * share);
}

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> nearestRoot(NumberOf<Isa> c2, NumberOf<Isa> c1,
                                                        NumberOf<Isa> c0) {
  using Number = NumberOf<Isa>;
  const Number sum = c1 + Isa::sqrt(c1 * c1 - same<Isa>(4.0) * c2 * c0);
  return where<Isa>(sum > Number{}, same<Isa>(-2.0) * c0 / sum);
}

/// Where the cell grows faster than the fan blows: suction.
template <class Isa>
[[gnu::always_inline]] inline CellAir<Isa> suckedAir(const FanAtSpeed<Isa>& fan, NumberOf<Isa> k,
                                                     NumberOf<Isa> u) {
  using Number = NumberOf<Isa>;
  const Number c = fan.curve;
  const Number q =
      nearestRoot<Isa>(same<Isa>(1.0) - c * (k * k), k * (same<Isa>(2.0) * c * u - fan.slope),
                       (fan.shutoff + fan.slope * u) - c * (u * u));
  return {-(q * q), u - k * q};
}

/// Where it shrinks so fast that air goes back through the fan.
template <class Isa>
[[gnu::always_inline]] inline CellAir<Isa> pushedAir(const FanAtSpeed<Isa>& fan, NumberOf<Isa> k,
                                                     NumberOf<Isa> u) {
  using Number = NumberOf<Isa>;
  const Number c = fan.curve;
  const Number q =
      nearestRoot<Isa>(same<Isa>(1.0) - c * (k * k), -k * (same<Isa>(2.0) * c * u + fan.slope),
                       -((c * (u * u) + fan.slope * u) + fan.shutoff));
  return {q * q, u + k * q};
}

template <class Isa>
[[gnu::always_inline]] inline CellAir<Isa> blownAir(const FanAtSpeed<Isa>& fan, NumberOf<Isa> k,
                                                    NumberOf<Isa> u) {
  using Number = NumberOf<Isa>;
  const Number c = fan.curve;
  const Number c2 = same<Isa>(1.0) + c * (k * k);
  const Number c1 = k * (same<Isa>(2.0) * c * u - fan.slope);
  const Number c0 = (c * (u * u) - fan.slope * u) - fan.shutoff;
  const Number root = Isa::sqrt(c1 * c1 - same<Isa>(4.0) * c2 * c0);
  const MaskOf<Isa> adds = c1 > Number{};
  const Number q = choose<Isa>(adds, same<Isa>(-2.0) * c0, root - c1) /
                   choose<Isa>(adds, c1 + root, same<Isa>(2.0) * c2);
  return {q * q, u + k * q};
}

/// The other two cases are computed where a craft of the pack is in one of them.
template <class Isa>
[[gnu::always_inline]] inline CellAir<Isa> cellAir(const FanAtSpeed<Isa>& fan, NumberOf<Isa> k,
                                                   NumberOf<Isa> u) {
  const MaskOf<Isa> sucks = u > fan.free_flow;
  const MaskOf<Isa> pushes = ~sucks & (u < -k * fan.root_shutoff);
  CellAir<Isa> air = blownAir<Isa>(fan, k, u);
  if (!Isa::allOf(~(sucks | pushes))) {
    const CellAir<Isa> sucked = suckedAir<Isa>(fan, k, u);
    const CellAir<Isa> pushed = pushedAir<Isa>(fan, k, u);
    air = {choose<Isa>(sucks, sucked.pressure, choose<Isa>(pushes, pushed.pressure, air.pressure)),
           choose<Isa>(sucks, sucked.fan_flow, choose<Isa>(pushes, pushed.fan_flow, air.fan_flow))};
  }
  return air;
}

}  // namespace hovercraft::lanes
