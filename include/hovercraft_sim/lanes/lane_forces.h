#pragma once

#include "hovercraft_sim/lanes/lane_vector.h"

/// The forces of actuators, of polars and of rotors for packs: each function has the operations of
/// the one in hovercraft/forces.h, drag_polar.h and rotors.h, in its order.

namespace hovercraft::lanes {

/// What holds for a pack at a stage of a step.
template <class Isa>
struct ForceInputs {
  const NumberOf<Isa>* levels;  // of each actuator
  Vector<Isa> u_B;
  Vector<Isa> w_WB_B;
};

/// Some columns of the numbers of forces and rotors.
struct Numbers {
  const Row* rows;
  std::size_t first;

  template <class Isa>
  [[gnu::always_inline]] NumberOf<Isa> at(std::size_t row) const {
    return load<Isa>(rows[row], first);
  }
  template <class Isa>
  [[gnu::always_inline]] Vector<Isa> vector(std::size_t row) const {
    return loadVector<Isa>(rows + row, first);
  }
  [[gnu::always_inline]] Numbers from(std::size_t row) const { return {rows + row, first}; }
};

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> airSpeed(const Numbers& force,
                                                     const ForceInputs<Isa>& inputs) {
  return dot(inputs.u_B + cross(inputs.w_WB_B, force.vector<Isa>(0)), force.vector<Isa>(3));
}

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> fanThrust(const Numbers& fan, std::size_t id,
                                                      const ForceInputs<Isa>& inputs) {
  using Number = NumberOf<Isa>;
  const Number at_rest = inputs.levels[id];
  const Number inverse_speed = fan.at<Isa>(6);
  const Number share = airSpeed<Isa>(fan, inputs) * inverse_speed;
  const Number one = same<Isa>(1.0);
  const Number left = choose<Isa>(at_rest < Number{}, one + share, one - share);
  return choose<Isa>(inverse_speed == Number{}, at_rest, at_rest * notNegative<Isa>(left));
}

template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> propellerForm(const Vector<Isa>& k, NumberOf<Isa> n,
                                                          NumberOf<Isa> v) {
  return (k.x * n * absolute<Isa>(n) + k.y * absolute<Isa>(n) * v) + k.z * v * absolute<Isa>(v);
}
template <class Isa>
[[gnu::always_inline]] inline NumberOf<Isa> propellerThrust(const Numbers& propeller,
                                                            std::size_t id,
                                                            const ForceInputs<Isa>& inputs) {
  const NumberOf<Isa> v = airSpeed<Isa>(propeller, inputs) / propeller.at<Isa>(6);
  return propeller.at<Isa>(7) * propellerForm<Isa>(propeller.vector<Isa>(9), inputs.levels[id], v);
}

template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> wrenchAt(const Numbers& place, const Vector<Isa>& force) {
  return {force, cross(place.vector<Isa>(0), force)};
}

template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> propellerWrench(const Numbers& propeller, std::size_t id,
                                                          const ForceInputs<Isa>& inputs) {
  const NumberOf<Isa> v = airSpeed<Isa>(propeller, inputs) / propeller.at<Isa>(6);
  const NumberOf<Isa> torque =
      propeller.at<Isa>(8) * propellerForm<Isa>(propeller.vector<Isa>(12), inputs.levels[id], v);
  const Vector<Isa> direction = propeller.vector<Isa>(3);
  Wrench<Isa> result =
      wrenchAt<Isa>(propeller, scaled<Isa>(propellerThrust<Isa>(propeller, id, inputs), direction));
  result.torque = result.torque - scaled<Isa>(torque, direction);
  return result;
}

template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> rudderWrench(const Numbers& rudder, const ForceStep& step,
                                                       const ForceInputs<Isa>& inputs) {
  using Number = NumberOf<Isa>;
  const Number half = same<Isa>(0.5) * airSpeed<Isa>(rudder, inputs);
  const Numbers fan = rudder.from(kRudderRows);
  Number thrust = Number{};
  if (step.fan_kind == ForceKind::kFan) thrust = fanThrust<Isa>(fan, step.fan_id, inputs);
  if (step.fan_kind == ForceKind::kPropeller) {
    thrust = propellerThrust<Isa>(fan, step.fan_id, inputs);
  }
  const Number induced = notNegative<Isa>(thrust) * rudder.at<Isa>(13);
  const Number v = notNegative<Isa>(half + Isa::sqrt(half * half + induced));
  const Number delta = inputs.levels[step.id];
  const Number scale = rudder.at<Isa>(9) * (v * v);
  const Number drag = rudder.at<Isa>(11) + rudder.at<Isa>(12) * (delta * delta);
  return wrenchAt<Isa>(rudder,
                       scaled<Isa>(scale * (rudder.at<Isa>(10) * delta), rudder.vector<Isa>(6)) -
                           scaled<Isa>(scale * drag, rudder.vector<Isa>(3)));
}

template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> polarCoefficients(const Numbers& polar,
                                                            NumberOf<Isa> cosine,
                                                            NumberOf<Isa> sine) {
  using Number = NumberOf<Isa>;
  const Number twice = same<Isa>(2.0) * cosine;
  Number cos_k = same<Isa>(1.0), cos_next = cosine;
  Number sin_k = Number{}, sin_next = sine;
  Vector<Isa> sums = {};
  for (std::size_t k = 0; k < kPolarTerms; ++k) {
    sums = sums + Vector<Isa>{polar.at<Isa>(4 + k) * cos_k,
                              polar.at<Isa>(4 + kPolarTerms + k) * sin_next,
                              polar.at<Isa>(4 + 2 * kPolarTerms + k) * sin_next};
    const Number cos_after = twice * cos_next - cos_k;
    const Number sin_after = twice * sin_next - sin_k;
    cos_k = cos_next, cos_next = cos_after;
    sin_k = sin_next, sin_next = sin_after;
  }
  return sums;
}

/// 0 where the air stands.
template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> polarWrench(const Numbers& polar,
                                                      const ForceInputs<Isa>& inputs) {
  using Number = NumberOf<Isa>;
  const Number x = inputs.u_B.x, y = inputs.u_B.y;
  const Number square = x * x + y * y;
  const Number speed = Isa::sqrt(square);
  const Vector<Isa> sums = polarCoefficients<Isa>(polar, x / speed, y / speed);
  const Number pressure = same<Isa>(0.5) * polar.at<Isa>(0) * square;
  const Number across = pressure * polar.at<Isa>(2);
  const MaskOf<Isa> blows = square > Number{};
  return {{where<Isa>(blows, -(pressure * polar.at<Isa>(1)) * sums.x),
           where<Isa>(blows, -across * sums.y), Number{}},
          {Number{}, Number{}, where<Isa>(blows, -across * (polar.at<Isa>(3) * sums.z))}};
}

/// The sum of the forces, in their order.
template <class Isa>
[[gnu::always_inline]] inline Wrench<Isa> forcesWrench(const StepPlan& plan, const Numbers& numbers,
                                                       const ForceInputs<Isa>& inputs) {
  Wrench<Isa> sum = {};
  for (std::size_t i = 0; i < plan.force_count; ++i) {
    const ForceStep& step = plan.forces[i];
    const Numbers force = numbers.from(step.first_row);
    switch (step.kind) {
      case ForceKind::kFan:
        sum = sum + wrenchAt<Isa>(force, scaled<Isa>(fanThrust<Isa>(force, step.id, inputs),
                                                     force.vector<Isa>(3)));
        break;
      case ForceKind::kPropeller:
        sum = sum + propellerWrench<Isa>(force, step.id, inputs);
        break;
      case ForceKind::kRudder:
        sum = sum + rudderWrench<Isa>(force, step, inputs);
        break;
      case ForceKind::kPolar:
        sum = sum + polarWrench<Isa>(force, inputs);
        break;
      case ForceKind::kNone:
        break;
    }
  }
  return sum;
}

/// The angular momentum of the rotors relative to the hull, in B.
template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> rotorMomentum(const StepPlan& plan,
                                                        const Numbers& numbers,
                                                        const NumberOf<Isa>* levels) {
  using Number = NumberOf<Isa>;
  Vector<Isa> sum = {};
  for (std::size_t i = 0; i < plan.rotor_count; ++i) {
    const RotorStep& step = plan.rotors[i];
    const Numbers rotor = numbers.from(step.first_row);
    const Number scale = rotor.at<Isa>(0);
    const Number level = levels[step.id];
    Number momentum = scale * level;
    if (step.by_square_root) {
      const Number root = scale * Isa::sqrt(absolute<Isa>(level));
      momentum = choose<Isa>(level < Number{}, -root, root);
    }
    sum = sum + scaled<Isa>(momentum, rotor.vector<Isa>(1));
  }
  return sum;
}

}  // namespace hovercraft::lanes
