#pragma once

#include "hovercraft_sim/lanes/lane_step.h"

/// The step of lie4 of a pack of craft: the operations of lie4Step() in body/steppers.h and of what
/// it takes of math/quaternion.h, in their order.

namespace hovercraft::lanes {

template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> scaledBy(double factor, const Vector<Isa>& v) {
  return scaled<Isa>(same<Isa>(factor), v);
}
template <class Isa>
[[gnu::always_inline]] inline Quaternion<Isa> product(const Quaternion<Isa>& a,
                                                      const Quaternion<Isa>& b) {
  return {a.s * b.s - dot(a.v, b.v),
          (scaled<Isa>(a.s, b.v) + scaled<Isa>(b.s, a.v)) + cross(a.v, b.v)};
}
template <class Isa>
[[gnu::always_inline]] inline Vector<Isa> angularVelocityOf(const Quaternion<Isa>& rate,
                                                            const Quaternion<Isa>& q_WB) {
  const Vector<Isa> difference = scaled<Isa>(q_WB.s, rate.v) - scaled<Isa>(rate.s, q_WB.v);
  return scaledBy(2.0, difference - cross(rate.v, q_WB.v));
}
template <class Isa>
[[gnu::always_inline]] inline Quaternion<Isa> quaternionOfSmallTurn(const Vector<Isa>& u) {
  using Number = NumberOf<Isa>;
  const Number x = same<Isa>(0.25) * dot(u, u);
  const Number s6 = same<Isa>(1.0 / 720.0) - x / same<Isa>(40320.0);
  const Number s4 = same<Isa>(1.0 / 24.0) - x * s6;
  const Number s2 = same<Isa>(1.0 / 2.0) - x * s4;
  const Number s = same<Isa>(1.0) - x * s2;
  const Number v4 = same<Isa>(1.0 / 240.0) - x / same<Isa>(10080.0);
  const Number v2 = same<Isa>(1.0 / 12.0) - x * v4;
  const Number sinc = same<Isa>(0.5) - x * v2;
  return {s, scaled<Isa>(sinc, u)};
}
/// turned() by factor u.
template <class Isa>
[[gnu::always_inline]] inline Quaternion<Isa> turned(double factor, const Vector<Isa>& u,
                                                     const Quaternion<Isa>& q_WB) {
  return product(quaternionOfSmallTurn(scaledBy(factor, u)), q_WB);
}

template <class Isa>
[[gnu::always_inline]] inline Motion<Isa> movedAndTurned(const Motion<Isa>& y, double step,
                                                         const Motion<Isa>& k,
                                                         const Quaternion<Isa>& q_WB) {
  const NumberOf<Isa> h = same<Isa>(step);
  return {y.p + scaled<Isa>(h, k.p), q_WB, y.P + scaled<Isa>(h, k.P), y.L + scaled<Isa>(h, k.L)};
}

/// The motion a step later, its quaternion not yet of unit length.
template <class Isa, bool kHasMore>
[[gnu::always_inline]] inline Motion<Isa> lie4Motion(const PackSystem<Isa, kHasMore>& f,
                                                     const Motion<Isa>& y,
                                                     const StepLoads<Isa>& loads) {
  const double h = f.plan.h;
  const Motion<Isa> k1 = f.derivative(y, loads.start);
  const Vector<Isa> w1 = angularVelocityOf(k1.q, y.q);
  const Quaternion<Isa> half = turned(0.5 * h, w1, y.q);
  const Motion<Isa> y2 = movedAndTurned(y, 0.5 * h, k1, half);
  const Motion<Isa> k2 = f.derivative(y2, loads.middle);
  const Vector<Isa> w2 = angularVelocityOf(k2.q, y2.q);
  const Motion<Isa> y3 = movedAndTurned(y, 0.5 * h, k2, turned(0.5 * h, w2, y.q));
  const Motion<Isa> k3 = f.derivative(y3, loads.middle);
  const Vector<Isa> w3 = angularVelocityOf(k3.q, y3.q);
  const Motion<Isa> y4 = movedAndTurned(y, h, k3, turned(h, w3 - scaledBy(0.5, w1), half));
  const Motion<Isa> k4 = f.derivative(y4, loads.end);
  const Vector<Isa> w4 = angularVelocityOf(k4.q, y4.q);
  const Vector<Isa> middle = scaledBy(2.0, w2 + w3);
  const Quaternion<Isa> first = turned(h / 12.0, (scaledBy(3.0, w1) - w4) + middle, y.q);
  const Quaternion<Isa> end = turned(h / 12.0, (scaledBy(3.0, w4) - w1) + middle, first);
  const Motion<Isa> twice = k2 + k3;
  return movedAndTurned(y, h / 6.0, (k1 + k4) + (twice + twice), end);
}

}  // namespace hovercraft::lanes
