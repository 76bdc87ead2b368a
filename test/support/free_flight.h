#pragma once

#include "hovercraft_sim/body/steppers.h"

#include "orientations.h"

namespace hovercraft::testing {

/// The asymmetric body of every free test: a box, turning near its middle axis, so that it tumbles.
struct Brick {
  Vector3 moments = {1.0, 2.0, 2.5};  // kg m²
  Vector3 w_WB_B = {0.4, 1.5, 0.9};   // rad/s
  Matrix3 R_WB = rotationFromRpy({0.3, -0.7, 1.9});

  Mobility mobility() const { return Mobility::spatial(1.0, moments.asDiagonal()); }
};

template <class Orientation>
RigidBodyState<Orientation> stateOf(const Mobility& mobility, const Matrix3& R_WB,
                                    const Vector3& v_WB, const Vector3& w_WB_B) {
  return mobility.stateOfMotion(Vector3(Vector3::Zero()),
                                orientationOf<Orientation>(quaternionFromMatrix(R_WB)),
                                {v_WB, times(R_WB, w_WB_B)});
}

/// A body without forces.
struct FreeSystem {
  const Mobility& mobility;

  template <class Orientation>
  StateDerivative<Orientation> derivative(const RigidBodyState<Orientation>& state,
                                          Stage /*stage*/) const {
    const Twist velocities = twist(state);
    return {velocities.v_WB, orientationRate(velocities.w_WB, state.orientation), Vector3::Zero(),
            Vector3::Zero()};
  }
  template <class Orientation>
  Twist twist(const RigidBodyState<Orientation>& state) const {
    return mobility.twist(state);
  }
};

template <class Orientation>
RigidBodyState<Orientation> freeFlight(Integrator integrator, const Brick& brick, double duration,
                                       int steps) {
  const Mobility mobility = brick.mobility();
  auto state = stateOf<Orientation>(mobility, brick.R_WB, Vector3::Zero(), brick.w_WB_B);
  for (int n = 0; n < steps; ++n) {
    state = integrationStep(integrator, state, FreeSystem{mobility}, duration / steps);
  }
  return state;
}

}  // namespace hovercraft::testing
