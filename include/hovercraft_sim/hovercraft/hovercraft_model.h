#pragma once

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/hovercraft/drag.h"
#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// What acts on one craft: engines (33) to (37), drag, gravity; and how the body answers (24).
/// Frames: W world, B body (centre of mass, axes of base_link). Constant during a run.
struct HovercraftModel {
  Mobility mobility;
  EngineGeometry engines;
  Drag drag;
  Vector3 weight_W = Vector3::Zero();  // m g, N
  Vector3 wind_W = Vector3::Zero();    // velocity of the air, m/s

  /// dY/dt with the engines at `thrusts` (rear, left, right; N). The wrench is built in B and
  /// rotated into W, its moment as its force (errata 18).
  template <class Orientation>
  StateDerivative<Orientation> derivative(const RigidBodyState<Orientation>& state,
                                          const Vector3& thrusts) const {
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    const Vector3 v_WB = mobility.velocity(state.momentum_W);
    const Vector3 w_WB_B = mobility.angularVelocityInBody(state.angular_momentum_W, R_WB);
    const Vector3 u_B = transposeTimes(R_WB, v_WB - wind_W);
    const Wrench wrench_B = engines.wrenchInBody(thrusts) + drag.wrenchInBody(u_B, w_WB_B);
    const Wrench wrench_W =
        mobility.project({times(R_WB, wrench_B.force) + weight_W, times(R_WB, wrench_B.torque)});
    return {v_WB, orientationRate(times(R_WB, w_WB_B), state.orientation), wrench_W.force,
            wrench_W.torque};
  }
};

/// What pushes a craft from outside during one step, constant in the frame that it is given in.
struct ExternalLoad {
  Wrench in_world;  // N and N m about the centre of mass, in W
  Wrench in_body;   // likewise, in B: turns with the craft
};

/// A craft during one step: the system that a stepper integrates.
struct DrivenHovercraft {
  const HovercraftModel& model;
  const ThrustCourse& thrusts;
  const ExternalLoad* load = nullptr;  // none

  template <class Orientation>
  StateDerivative<Orientation> derivative(const RigidBodyState<Orientation>& state,
                                          Stage stage) const {
    StateDerivative<Orientation> rate = model.derivative(state, thrusts.at(stage));
    if (load != nullptr) {
      const Matrix3 R_WB = rotationMatrix(state.orientation);
      const Wrench pushed =
          model.mobility.project({load->in_world.force + times(R_WB, load->in_body.force),
                                  load->in_world.torque + times(R_WB, load->in_body.torque)});
      rate.force_W += pushed.force;
      rate.torque_W += pushed.torque;
    }
    return rate;
  }
  template <class Orientation>
  Twist twist(const RigidBodyState<Orientation>& state) const {
    return model.mobility.twist(state);
  }
};

/// integrationStep() of a craft, which Simulation makes: a function of the library, so that a
/// program gets its bits whatever the program itself was compiled with.
/// @param h s. The floating-point environment is that of IEEE 754 meanwhile.
HOVERCRAFT_PUBLIC RigidBodyState<Quaternion> integrationStep(Integrator integrator,
                                                             const RigidBodyState<Quaternion>& y,
                                                             const DrivenHovercraft& f, double h);
HOVERCRAFT_PUBLIC RigidBodyState<Matrix3> integrationStep(Integrator integrator,
                                                          const RigidBodyState<Matrix3>& y,
                                                          const DrivenHovercraft& f, double h);

}  // namespace hovercraft
