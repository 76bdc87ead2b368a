#pragma once

#include "hovercraft_sim/lanes/lane_step.h"

/// The step of a craft in the plane by the numbers that are not 0: of the operations of lane_step.h
/// those are left out that multiply by 0 or add the product. Where isPlanar() holds, what is left
/// has the same bits:
/// - Quaternion [s, 0, 0, z], momentum (P_x, P_y, 0) and angular momentum (0, 0, L_z) with zeros of
///   positive sign stay so: +0 plus either zero is +0, and settling makes +0.
/// - A sum changes by a product that is left out only if it is a zero, in its sign. The signs of
///   zero forces, velocities of the air and entries of R are lost in the next sum, whose other
///   part, a number of the state, is never -0.
/// - A number that is not finite comes into P or L by what is left too: the craft is lost in the
///   same step. Forces along z and moments about x and y are finite, as constants are bounded.

namespace hovercraft::lanes {

/// Numbers of a motion in the plane, or of its derivative.
template <class Isa>
struct PlanarMotion {
  NumberOf<Isa> x, y;  // p, m
  NumberOf<Isa> s, z;  // of the quaternion
  NumberOf<Isa> momentum_x, momentum_y;
  NumberOf<Isa> angular_momentum;
};

template <class Isa>
[[gnu::always_inline]] inline PlanarMotion<Isa> operator+(const PlanarMotion<Isa>& a,
                                                          const PlanarMotion<Isa>& b) {
  return {a.x + b.x,
          a.y + b.y,
          a.s + b.s,
          a.z + b.z,
          a.momentum_x + b.momentum_x,
          a.momentum_y + b.momentum_y,
          a.angular_momentum + b.angular_momentum};
}
template <class Isa>
[[gnu::always_inline]] inline PlanarMotion<Isa> moved(const PlanarMotion<Isa>& y, double step,
                                                      const PlanarMotion<Isa>& k) {
  const NumberOf<Isa> h = same<Isa>(step);
  return {y.x + h * k.x,
          y.y + h * k.y,
          y.s + h * k.s,
          y.z + h * k.z,
          y.momentum_x + h * k.momentum_x,
          y.momentum_y + h * k.momentum_y,
          y.angular_momentum + h * k.angular_momentum};
}

/// What the engines make at one time of a step.
template <class Isa>
struct PlanarLoad {
  NumberOf<Isa> levels[3];
  NumberOf<Isa> f_x, f_y, t_z;  // in B
};
template <class Isa>
[[gnu::always_inline]] inline PlanarMotion<Isa> planarMotion(const BlockState& state,
                                                             std::size_t first) {
  return {load<Isa>(state.p_WB[0], first),
          load<Isa>(state.p_WB[1], first),
          load<Isa>(state.q_s, first),
          load<Isa>(state.q_v[2], first),
          load<Isa>(state.momentum_W[0], first),
          load<Isa>(state.momentum_W[1], first),
          load<Isa>(state.angular_momentum_W[2], first)};
}
template <class Isa>
[[gnu::always_inline]] inline void storeMotion(const PlanarMotion<Isa>& y, BlockState& state,
                                               std::size_t first) {
  store<Isa>(y.x, state.p_WB[0], first);
  store<Isa>(y.y, state.p_WB[1], first);
  store<Isa>(y.s, state.q_s, first);
  store<Isa>(y.z, state.q_v[2], first);
  store<Isa>(y.momentum_x, state.momentum_W[0], first);
  store<Isa>(y.momentum_y, state.momentum_W[1], first);
  store<Isa>(y.angular_momentum, state.angular_momentum_W[2], first);
}

template <class Isa>
struct PlanarLoads {
  PlanarLoad<Isa> start, middle, end;
};

/// PackSystem in the plane, of engines, drag and weight.
template <class Isa>
struct PlanarSystem {
  using Number = NumberOf<Isa>;

  const StepPlan& plan;
  const BlockConstants& constants;
  std::size_t first;
  Number wind_x, wind_y;

  [[gnu::always_inline]] Number at(const Row& row) const { return load<Isa>(row, first); }
  /// A row of a matrix times the thrusts.
  [[gnu::always_inline]] Number timesLevels(const Row* column, const Number* levels) const {
    return (at(column[0]) * levels[0] + at(column[3]) * levels[1]) + at(column[6]) * levels[2];
  }
  [[gnu::always_inline]] void loadEngines(PlanarLoad<Isa>& load) const {
    load.f_x = timesLevels(constants.engine_force, load.levels);
    load.f_y = timesLevels(constants.engine_force + 1, load.levels);
    load.t_z = timesLevels(constants.engine_torque + 2, load.levels);
  }
  [[gnu::always_inline]] void loadAll(PlanarLoads<Isa>& loads, bool has_middle) const {
    loadEngines(loads.start);
    if (has_middle) loadEngines(loads.middle);
    loadEngines(loads.end);
  }
  [[gnu::always_inline]] Number resistance(const Row& linear, const Row& quadratic,
                                           Number rate) const {
    return -(at(linear) + at(quadratic) * absolute<Isa>(rate)) * rate;
  }

  [[gnu::always_inline]] PlanarMotion<Isa> derivative(const PlanarMotion<Isa>& y,
                                                      const PlanarLoad<Isa>& load) const {
    const Number z2 = y.z + y.z;
    const Number cosine = same<Isa>(1.0) - z2 * y.z;
    const Number sine = z2 * y.s;
    const Number per_mass = at(constants.inverse_mass);
    const Number v_x = per_mass * y.momentum_x;
    const Number v_y = per_mass * y.momentum_y;
    const Number w = at(constants.inverse_inertia_B[8]) * y.angular_momentum;
    const Number air_x = v_x - wind_x;
    const Number air_y = v_y - wind_y;
    const Number u_x = cosine * air_x + sine * air_y;
    const Number u_y = cosine * air_y - sine * air_x;
    const Number f_x =
        load.f_x + resistance(constants.drag_linear[0], constants.drag_quadratic[0], u_x);
    const Number f_y =
        load.f_y + resistance(constants.drag_linear[1], constants.drag_quadratic[1], u_y);
    const Number t_z = load.t_z + resistance(constants.drag_angular_linear[2],
                                             constants.drag_angular_quadratic[2], w);
    return {v_x,
            v_y,
            same<Isa>(-0.5) * (w * y.z),
            same<Isa>(0.5) * (y.s * w),
            (cosine * f_x - sine * f_y) + at(constants.weight_W[0]),
            (sine * f_x + cosine * f_y) + at(constants.weight_W[1]),
            t_z};
  }
};

/// By Euler, Heun or RK4.
template <Method kMethod, class Isa>
[[gnu::always_inline]] inline PlanarMotion<Isa> steppedMotion(const PlanarSystem<Isa>& f,
                                                              const PlanarMotion<Isa>& y,
                                                              const PlanarLoads<Isa>& loads) {
  static_assert(kMethod != Method::kSemiImplicitEuler);
  const double h = f.plan.h;
  const PlanarMotion<Isa> k1 = f.derivative(y, loads.start);
  if constexpr (kMethod == Method::kHeun) {
    return moved(y, 0.5 * h, k1 + f.derivative(moved(y, h, k1), loads.end));
  } else if constexpr (kMethod == Method::kRungeKutta4) {
    const PlanarMotion<Isa> k2 = f.derivative(moved(y, 0.5 * h, k1), loads.middle);
    const PlanarMotion<Isa> k3 = f.derivative(moved(y, 0.5 * h, k2), loads.middle);
    const PlanarMotion<Isa> k4 = f.derivative(moved(y, h, k3), loads.end);
    const PlanarMotion<Isa> middle = k2 + k3;
    return moved(y, h / 6.0, (k1 + k4) + (middle + middle));
  } else {
    return moved(y, h, k1);
  }
}

/// Whether some craft of a block can be stepped so.
template <class Isa>
[[gnu::always_inline]] inline bool isPlanar(const Block& block, std::size_t first) {
  if (!block.constants.is_planar) return false;
  const BlockState& state = block.state;
  const Row* const zeros[] = {&state.q_v[0], &state.q_v[1], &state.momentum_W[2],
                              &state.angular_momentum_W[0], &state.angular_momentum_W[1]};
  const Row* const others[] = {
      &state.p_WB[0], &state.p_WB[1],       &state.p_WB[2],       &state.q_s,
      &state.q_v[2],  &state.momentum_W[0], &state.momentum_W[1], &state.angular_momentum_W[2]};
  constexpr std::int64_t kNegativeZero = -0x7fffffffffffffff - 1;
  MaskOf<Isa> wrong = {};
  for (const Row* row : zeros) wrong |= maskOf<Isa>(load<Isa>(*row, first));  // any bit
  for (const Row* row : others) {
    wrong |= maskOf<Isa>(load<Isa>(*row, first)) == (MaskOf<Isa>{} + kNegativeZero);
  }
  const NumberOf<Isa> most = same<Isa>(kMostOfPlanar);
  for (std::size_t i = 0; i < 3; ++i) {
    wrong |= ~(absolute<Isa>(load<Isa>(state.level[i], first)) <= most);
    wrong |= ~(absolute<Isa>(load<Isa>(block.demand[i], first)) <= most);
  }
  return Isa::allOf(wrong == MaskOf<Isa>{});
}

}  // namespace hovercraft::lanes
