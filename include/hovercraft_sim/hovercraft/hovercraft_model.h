#pragma once

#include <memory>
#include <vector>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/hovercraft/drag.h"
#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/hovercraft/environment.h"
#include "hovercraft_sim/hovercraft/forces.h"
#include "hovercraft_sim/hovercraft/ground_forces.h"
#include "hovercraft_sim/hovercraft/rotors.h"

namespace hovercraft {

/// What acts on one craft: engines (33) to (37), drag, other forces, gravity; and how the body
/// answers (24).
/// Frames: W world, B body (centre of mass, axes of base_link). Constant during a run.
struct HovercraftModel {
  Mobility mobility;                   // mass, inertia and how the model may move
  EngineGeometry engines;              // where they are
  Drag drag;                           // by body axes
  Vector3 weight_W = Vector3::Zero();  // m g, N
  std::shared_ptr<const GroundForces> ground_forces = nullptr;  // none: nothing of it is asked
  std::vector<Force> forces = {};  // of the other actuators, in a fixed order
  std::vector<Rotor> rotors = {};  // likewise

  /// Whether it is more than a body on which engines, drag and weight act.
  bool hasMoreForces() const {
    return !forces.empty() || ground_forces != nullptr || !rotors.empty();
  }

  /// w in B, rad/s. @param levels of the actuators, which turn the rotors.
  Vector3 angularVelocityInBody(const Vector3& angular_momentum_W, const Matrix3& R_WB,
                                const ActuatorArray<double>& levels) const {
    if (rotors.empty()) return mobility.angularVelocityInBody(angular_momentum_W, R_WB);
    return mobility.angularVelocityInBody(angular_momentum_W, R_WB, rotorMomentum(rotors, levels));
  }
  /// Of the centre of mass, in W. @param levels of its actuators.
  template <class Orientation>
  Twist twist(const RigidBodyState<Orientation>& state, const ActuatorArray<double>& levels) const {
    if (rotors.empty()) return mobility.twist(state);
    return mobility.twist(state, rotorMomentum(rotors, levels));
  }

  /// How a body moves, in B. @param levels of its actuators.
  template <class Orientation>
  BodyMotion motionInBody(const RigidBodyState<Orientation>& state,
                          const ActuatorArray<double>& levels,
                          const Environment& environment) const {
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    const Vector3 v_WB = mobility.velocity(state.momentum_W);
    return {R_WB, state.p_WB, transposeTimes(R_WB, v_WB),
            angularVelocityInBody(state.angular_momentum_W, R_WB, levels),
            transposeTimes(R_WB, v_WB - environment.wind_W)};
  }

  /// dY/dt with the actuators at `thrusts` and the fans of the cushion at `fan_speeds` (of a craft
  /// with ground forces), in the air of `environment`. The wrench is built in B and rotated into W,
  /// its moment as its force (errata 18).
  template <class Orientation>
  StateDerivative<Orientation> derivative(const RigidBodyState<Orientation>& state,
                                          const ActuatorArray<double>& thrusts,
                                          const Environment& environment,
                                          const FanSpeeds* fan_speeds = nullptr) const {
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    const Vector3 v_WB = mobility.velocity(state.momentum_W);
    const Vector3 w_WB_B = angularVelocityInBody(state.angular_momentum_W, R_WB, thrusts);
    const Vector3 u_B = transposeTimes(R_WB, v_WB - environment.wind_W);
    Wrench wrench_B = wrenchOfEngines(thrusts) + drag.wrenchInBody(u_B, w_WB_B);
    if (!forces.empty()) wrench_B = wrench_B + wrenchInBody(forces, {thrusts, u_B, w_WB_B});
    if (ground_forces != nullptr && fan_speeds != nullptr) {
      const BodyMotion motion = {R_WB, state.p_WB, transposeTimes(R_WB, v_WB), w_WB_B, u_B};
      wrench_B = wrench_B + ground_forces->wrenchInBody(motion, environment, *fan_speeds);
    }
    const Wrench wrench_W =
        mobility.project({times(R_WB, wrench_B.force) + weight_W, times(R_WB, wrench_B.torque)});
    return {v_WB, orientationRate(times(R_WB, w_WB_B), state.orientation), wrench_W.force,
            wrench_W.torque};
  }

  /// In B. @param thrusts of all actuators, of which the engines come first.
  [[gnu::flatten]] Wrench wrenchOfEngines(const ActuatorArray<double>& thrusts) const {
    return engines.wrenchInBody({thrusts[0], thrusts[1], thrusts[2]});
  }

  /// The same bits for a spatial body without hasMoreForces(), for less.
  template <class Orientation>
  StateDerivative<Orientation> derivativeOfEngines(const RigidBodyState<Orientation>& state,
                                                   const Wrench& engines_B,
                                                   const Environment& environment) const {
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    const Vector3 v_WB = mobility.velocity(state.momentum_W);
    const Vector3 w_WB_B = mobility.angularVelocityInBody(state.angular_momentum_W, R_WB);
    const Vector3 u_B = transposeTimes(R_WB, v_WB - environment.wind_W);
    const Wrench wrench_B = engines_B + drag.wrenchInBody(u_B, w_WB_B);
    return {v_WB, orientationRate(times(R_WB, w_WB_B), state.orientation),
            times(R_WB, wrench_B.force) + weight_W, times(R_WB, wrench_B.torque)};
  }
};

}  // namespace hovercraft
