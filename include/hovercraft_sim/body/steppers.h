#pragma once

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/math/demand.h"

/// One step of the equation dY/dt = f(t, Y) of (24), each method a pure function of the state.
///
/// The system passed in is any type with two const members, templates on the orientation:
///   StateDerivative<Orientation> derivative(const RigidBodyState<Orientation>&, Stage) const;
///   Twist twist(const RigidBodyState<Orientation>&) const;
/// `Stage` says which time within the step the forces are wanted for, so that a force that depends
/// on time keeps the order of the method. Every method ends by bringing the orientation back to a
/// rotation.
///
/// What their bits are. These are templates: a program that uses them compiles them with its own
/// options, and they compute in the floating-point environment of its thread. They give the same
/// bits everywhere (ARCHITECTURE.md, Determinism) if it is compiled without -ffast-math and its
/// parts, with -ffp-contract=off, and, where fused multiply-add or AVX-512 is switched on
/// (-march=native, -march=x86-64-v3, -mfma, -mavx512f), with -fno-tree-slp-vectorize: g++ 12 forms
/// fused multiply-adds when it vectorises straight-line code, in spite of -ffp-contract=off. With
/// other options a step is as exact, and its last bits are others. What Simulation computes does
/// not depend on any of this, nor does integrationStep() of a DrivenBody
/// (step_inputs.h): both are compiled into the library.
///
/// gnu::flatten has the compiler inline the stages, derivative and all: the slopes stay in
/// registers, and a step takes a quarter less time (bench/README.md). A compiler that does not know
/// it ignores it.

namespace hovercraft {

/// The time of a stage within one step: t, t + h/2, t + h.
enum class Stage { kStart, kMiddle, kEnd };

enum class Integrator { kEuler, kSemiImplicitEuler, kHeun, kRungeKutta4, kLie4 };

/// Whether it is of first order: the explicit or the semi-implicit Euler.
constexpr bool isEuler(Integrator integrator) {
  return integrator == Integrator::kEuler || integrator == Integrator::kSemiImplicitEuler;
}

/// Component by component.
template <class Orientation>
StateDerivative<Orientation> operator+(const StateDerivative<Orientation>& a,
                                       const StateDerivative<Orientation>& b) {
  return {a.v_WB + b.v_WB, a.orientation_rate + b.orientation_rate, a.force_W + b.force_W,
          a.torque_W + b.torque_W};
}

/// Y + h k, without renormalisation.
template <class Orientation>
RigidBodyState<Orientation> moved(const RigidBodyState<Orientation>& state, double h,
                                  const StateDerivative<Orientation>& k) {
  return {state.p_WB + h * k.v_WB, state.orientation + h * k.orientation_rate,
          state.momentum_W + h * k.force_W, state.angular_momentum_W + h * k.torque_W};
}

/// Explicit Euler, order 1: Y + h f(t, Y).
template <class Orientation, class System>
RigidBodyState<Orientation> eulerStep(const RigidBodyState<Orientation>& y, const System& f,
                                      double h) {
  return moved(y, h, f.derivative(y, Stage::kStart));
}

/// Semi-implicit (symplectic) Euler, order 1: momenta first, then position and orientation with the
/// new velocities (the source's section 4).
template <class Orientation, class System>
RigidBodyState<Orientation> semiImplicitEulerStep(const RigidBodyState<Orientation>& y,
                                                  const System& f, double h) {
  StateDerivative<Orientation> k = f.derivative(y, Stage::kStart);
  RigidBodyState<Orientation> kicked = y;
  kicked.momentum_W += h * k.force_W;
  kicked.angular_momentum_W += h * k.torque_W;
  const Twist twist = f.twist(kicked);
  k.v_WB = twist.v_WB;
  k.orientation_rate = orientationRate(twist.w_WB, y.orientation);
  return moved(y, h, k);
}

/// Heun, order 2: Y + h/2 (k1 + k2), k2 at the end of an Euler step (the source's formula with its
/// first slope).
template <class Orientation, class System>
[[gnu::flatten]] RigidBodyState<Orientation> heunStep(const RigidBodyState<Orientation>& y,
                                                      const System& f, double h) {
  const auto k1 = f.derivative(y, Stage::kStart);
  const auto k2 = f.derivative(moved(y, h, k1), Stage::kEnd);
  return moved(y, 0.5 * h, k1 + k2);
}

/// Classical Runge-Kutta, order 4: Y + h/6 (k1 + 2 k2 + 2 k3 + k4).
template <class Orientation, class System>
[[gnu::flatten]] RigidBodyState<Orientation> rungeKutta4Step(const RigidBodyState<Orientation>& y,
                                                             const System& f, double h) {
  const auto k1 = f.derivative(y, Stage::kStart);
  const auto k2 = f.derivative(moved(y, 0.5 * h, k1), Stage::kMiddle);
  const auto k3 = f.derivative(moved(y, 0.5 * h, k2), Stage::kMiddle);
  const auto k4 = f.derivative(moved(y, h, k3), Stage::kEnd);
  const auto middle = k2 + k3;
  return moved(y, h / 6.0, (k1 + k4) + (middle + middle));
}

/// The angular velocity (W, rad/s) of which orientationRate() made this.
inline Vector3 turnRate(const Quaternion& rate, const Quaternion& q_WB) {
  return angularVelocityOf(rate, q_WB);
}
inline Vector3 turnRate(const Matrix3& rate, const Matrix3& R_WB) {
  // [w]x = R' R^T: each component of w from the two entries that hold it.
  const Matrix3 skew = product(rate, R_WB.transpose());
  return {0.5 * (skew(2, 1) - skew(1, 2)), 0.5 * (skew(0, 2) - skew(2, 0)),
          0.5 * (skew(1, 0) - skew(0, 1))};
}
/// The orientation after a turn by u (in W, rad).
inline Quaternion turned(const Vector3& u, const Quaternion& q_WB) {
  return quaternionOfSmallTurn(u) * q_WB;
}
inline Matrix3 turned(const Vector3& u, const Matrix3& R_WB) {
  return product(rotationMatrix(quaternionOfSmallTurn(u)), R_WB);
}

/// moved() with the orientation turned instead.
template <class Orientation>
RigidBodyState<Orientation> movedAndTurned(const RigidBodyState<Orientation>& state, double h,
                                           const StateDerivative<Orientation>& k,
                                           const Orientation& orientation) {
  return {state.p_WB + h * k.v_WB, orientation, state.momentum_W + h * k.force_W,
          state.angular_momentum_W + h * k.torque_W};
}

/// The commutator-free Lie group method of order 4 (Celledoni, Marthinsen and Owren,
/// Commutator-free Lie group methods, Future Generation Computer Systems 19 (2003) 341):
/// orientations are turned by exponentials, and so stay rotations in every stage. Position and
/// momenta go by the classical Runge-Kutta method, which it is where nothing turns.
template <class Orientation, class System>
[[gnu::flatten]] RigidBodyState<Orientation> lie4Step(const RigidBodyState<Orientation>& y,
                                                      const System& f, double h) {
  const auto k1 = f.derivative(y, Stage::kStart);
  const Vector3 w1 = turnRate(k1.orientation_rate, y.orientation);
  const Orientation half = turned((0.5 * h) * w1, y.orientation);
  const auto y2 = movedAndTurned(y, 0.5 * h, k1, half);
  const auto k2 = f.derivative(y2, Stage::kMiddle);
  const Vector3 w2 = turnRate(k2.orientation_rate, y2.orientation);
  const auto y3 = movedAndTurned(y, 0.5 * h, k2, turned((0.5 * h) * w2, y.orientation));
  const auto k3 = f.derivative(y3, Stage::kMiddle);
  const Vector3 w3 = turnRate(k3.orientation_rate, y3.orientation);
  const auto y4 = movedAndTurned(y, h, k3, turned(h * (w3 - 0.5 * w1), half));
  const auto k4 = f.derivative(y4, Stage::kEnd);
  const Vector3 w4 = turnRate(k4.orientation_rate, y4.orientation);
  const Vector3 middle = 2.0 * (w2 + w3);
  const Orientation first = turned((h / 12.0) * ((3.0 * w1 - w4) + middle), y.orientation);
  const Orientation end = turned((h / 12.0) * ((3.0 * w4 - w1) + middle), first);
  const auto twice = k2 + k3;
  return movedAndTurned(y, h / 6.0, (k1 + k4) + (twice + twice), end);
}

/// One step of length h (s) by the chosen method; the orientation of the result is a rotation
/// again.
template <class Orientation, class System>
RigidBodyState<Orientation> integrationStep(Integrator integrator,
                                            const RigidBodyState<Orientation>& y, const System& f,
                                            double h) {
  auto next = [&] {
    switch (integrator) {
      case Integrator::kEuler:
        return eulerStep(y, f, h);
      case Integrator::kSemiImplicitEuler:
        return semiImplicitEulerStep(y, f, h);
      case Integrator::kHeun:
        return heunStep(y, f, h);
      case Integrator::kRungeKutta4:
        return rungeKutta4Step(y, f, h);
      case Integrator::kLie4:
        return lie4Step(y, f, h);
    }
    demand(false, "unknown integrator");
    return y;
  }();
  next.orientation = renormalized(next.orientation);
  return next;
}

}  // namespace hovercraft
