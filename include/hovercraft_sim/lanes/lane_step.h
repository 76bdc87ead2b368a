#pragma once

#include "hovercraft_sim/lanes/lane_forces.h"
#include "hovercraft_sim/lanes/lane_ground.h"

/// A step of a pack of craft by each method: the operations of body/steppers.h and
/// HovercraftModel::derivative(), in their order.

namespace hovercraft::lanes {

/// RigidBodyState by a quaternion, or its derivative: velocity, rate of the quaternion, force and
/// moment.
template <class Isa>
struct Motion {
  Vector<Isa> p;
  Quaternion<Isa> q;
  Vector<Isa> P;
  Vector<Isa> L;
};

template <class Isa>
[[gnu::always_inline]] inline Motion<Isa> operator+(const Motion<Isa>& a, const Motion<Isa>& b) {
  return {a.p + b.p, {a.q.s + b.q.s, a.q.v + b.q.v}, a.P + b.P, a.L + b.L};
}

/// y + h k
template <class Isa>
[[gnu::always_inline]] inline Motion<Isa> moved(const Motion<Isa>& y, double step,
                                                const Motion<Isa>& k) {
  const NumberOf<Isa> h = same<Isa>(step);
  return {y.p + scaled<Isa>(h, k.p),
          {y.q.s + h * k.q.s, y.q.v + scaled<Isa>(h, k.q.v)},
          y.P + scaled<Isa>(h, k.P),
          y.L + scaled<Isa>(h, k.L)};
}

/// What acts at one time of a step and does not depend on the motion.
template <class Isa>
struct StageLoad {
  NumberOf<Isa> levels[kMostActuators];  // of each actuator
  Wrench<Isa> engines_B;
  const StageAir<Isa>* air;  // of the cushion, if there is one
};

/// The system that a stepper integrates: some columns of a block.
/// @tparam kHasMore whether there are forces besides engines, drag and weight, rotors or a ground.
template <class Isa, bool kHasMore>
struct PackSystem {
  using Number = NumberOf<Isa>;

  const StepPlan& plan;
  const BlockConstants& constants;
  Numbers more;
  std::size_t first;
  Vector<Isa> wind_W;

  [[gnu::always_inline]] Wrench<Isa> enginesWrench(const Number* levels) const {
    const Vector<Isa> thrusts = {levels[0], levels[1], levels[2]};
    return {times(loadMatrix<Isa>(constants.engine_force, first), thrusts),
            times(loadMatrix<Isa>(constants.engine_torque, first), thrusts)};
  }

  [[gnu::always_inline]] static Number resistance(Number linear, Number quadratic, Number rate) {
    return -(linear + quadratic * absolute<Isa>(rate)) * rate;
  }
  [[gnu::always_inline]] Vector<Isa> resistance(const Row* linear, const Row* quadratic,
                                                const Vector<Isa>& rate) const {
    const Vector<Isa> one = loadVector<Isa>(linear, first);
    const Vector<Isa> two = loadVector<Isa>(quadratic, first);
    return {resistance(one.x, two.x, rate.x), resistance(one.y, two.y, rate.y),
            resistance(one.z, two.z, rate.z)};
  }

  [[gnu::always_inline]] Vector<Isa> velocity(const Vector<Isa>& momentum_W) const {
    return scaled<Isa>(load<Isa>(constants.inverse_mass, first), momentum_W);
  }
  [[gnu::always_inline]] Vector<Isa> angularVelocityInBody(const Motion<Isa>& y,
                                                           const Matrix<Isa>& R_WB,
                                                           const StageLoad<Isa>& at) const {
    Vector<Isa> L_B = transposeTimes(R_WB, y.L);
    if constexpr (kHasMore) {
      if (plan.rotor_count > 0) L_B = L_B - rotorMomentum<Isa>(plan, more, at.levels);
    }
    return times(loadMatrix<Isa>(constants.inverse_inertia_B, first), L_B);
  }
  /// Angular velocity in W.
  [[gnu::always_inline]] Vector<Isa> angularVelocity(const Motion<Isa>& y,
                                                     const StageLoad<Isa>& at) const {
    const Matrix<Isa> R_WB = rotationMatrix(y.q);
    return times(R_WB, angularVelocityInBody(y, R_WB, at));
  }

  [[gnu::always_inline]] Vector<Isa> held(const double* free, const Vector<Isa>& v) const {
    return {v.x * same<Isa>(free[0]), v.y * same<Isa>(free[1]), v.z * same<Isa>(free[2])};
  }

  [[gnu::always_inline]] Motion<Isa> derivative(const Motion<Isa>& y,
                                                const StageLoad<Isa>& at) const {
    const Matrix<Isa> R_WB = rotationMatrix(y.q);
    const Vector<Isa> v_WB = velocity(y.P);
    const Vector<Isa> w_WB_B = angularVelocityInBody(y, R_WB, at);
    const Vector<Isa> u_B = transposeTimes(R_WB, v_WB - wind_W);
    const Wrench<Isa> drag = {
        resistance(constants.drag_linear, constants.drag_quadratic, u_B),
        resistance(constants.drag_angular_linear, constants.drag_angular_quadratic, w_WB_B)};
    Wrench<Isa> wrench_B = at.engines_B + drag;
    if constexpr (kHasMore) {
      if (plan.force_count > 0) {
        wrench_B = wrench_B + forcesWrench<Isa>(plan, more, {at.levels, u_B, w_WB_B});
      }
      if (plan.ground.isThere()) {
        addGroundWrench<Isa>(plan.ground, more.from(plan.ground.first_row),
                             {R_WB, y.p, transposeTimes(R_WB, v_WB), w_WB_B, u_B}, at.air,
                             wrench_B);
      }
    }
    const Vector<Isa> force_W =
        times(R_WB, wrench_B.force) + loadVector<Isa>(constants.weight_W, first);
    return {v_WB, quaternionRateWorld(times(R_WB, w_WB_B), y.q),
            held(plan.free_translation, force_W),
            held(plan.free_rotation, times(R_WB, wrench_B.torque))};
  }
};

template <class Isa>
struct StepLoads {
  StageLoad<Isa> start;
  StageLoad<Isa> middle;  // of methods of order 4
  StageLoad<Isa> end;
};

/// The motion a step later, its quaternion not yet of unit length.
template <Method kMethod, class Isa, bool kHasMore>
[[gnu::always_inline]] inline Motion<Isa> steppedMotion(const PackSystem<Isa, kHasMore>& f,
                                                        const Motion<Isa>& y,
                                                        const StepLoads<Isa>& loads) {
  const double h = f.plan.h;
  Motion<Isa> k1 = f.derivative(y, loads.start);
  if constexpr (kMethod == Method::kSemiImplicitEuler) {
    Motion<Isa> kicked = y;
    kicked.P = kicked.P + scaled<Isa>(same<Isa>(h), k1.P);
    kicked.L = kicked.L + scaled<Isa>(same<Isa>(h), k1.L);
    k1.p = f.velocity(kicked.P);
    k1.q = quaternionRateWorld(f.angularVelocity(kicked, loads.end), y.q);
    return moved(y, h, k1);
  } else if constexpr (kMethod == Method::kHeun) {
    const Motion<Isa> k2 = f.derivative(moved(y, h, k1), loads.end);
    return moved(y, 0.5 * h, k1 + k2);
  } else if constexpr (kMethod == Method::kRungeKutta4) {
    const Motion<Isa> k2 = f.derivative(moved(y, 0.5 * h, k1), loads.middle);
    const Motion<Isa> k3 = f.derivative(moved(y, 0.5 * h, k2), loads.middle);
    const Motion<Isa> k4 = f.derivative(moved(y, h, k3), loads.end);
    const Motion<Isa> middle = k2 + k3;
    return moved(y, h / 6.0, (k1 + k4) + (middle + middle));
  } else {
    return moved(y, h, k1);
  }
}

}  // namespace hovercraft::lanes
