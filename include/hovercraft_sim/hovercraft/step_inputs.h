#pragma once

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/hovercraft/environment.h"
#include "hovercraft_sim/hovercraft/hovercraft_model.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// What pushes a body from outside during one step, constant in the frame that it is given in.
struct ExternalLoad {
  Wrench in_world;  // N and N m about the centre of mass, in W
  Wrench in_body;   // likewise, in B: turns with the body
};

/// All that determines the motion of one body in a step besides its state and contact: the same for
/// a craft and for a loose body, whose engines have no thrust.
struct StepInputs {
  ThrustCourse thrusts;            // of the whole step
  bool is_steady = false;          // they are the same at all stages
  ExternalLoad load;               // besides engines, drag and weight
  bool is_loaded = false;          // else `load` counts for nothing
  Environment environment;         // wind and ground
  FanSpeedCourse fan_speeds = {};  // of the whole step; of a craft with a cushion
};

/// A piece of a step, s from its start; contact cuts a step at every impact.
struct StepPiece {
  double from = 0.0;        // where it begins
  double to = 0.0;          // where it ends
  bool in_contact = false;  // both Eulers give way to Heun's method (doc/contact.md)
};

/// One body during one piece of a step: the system that a stepper integrates.
struct DrivenBody {
  const HovercraftModel& model;                // of the body
  const ThrustCourse& thrusts;                 // at the start, middle and end of the piece
  const Environment& environment;              // of the step
  const ExternalLoad* load = nullptr;          // none
  const FanSpeedCourse* fan_speeds = nullptr;  // over the piece; of a craft with ground forces
  bool is_steady = false;                      // the thrusts are the same at all stages

  /// dY/dt at a stage of the piece.
  template <class Orientation>
  StateDerivative<Orientation> derivative(const RigidBodyState<Orientation>& state,
                                          Stage stage) const {
    StateDerivative<Orientation> rate =
        model.derivative(state, thrusts.at(stage), environment,
                         fan_speeds != nullptr ? &fan_speeds->at(stage) : nullptr);
    addLoad(state, rate);
    return rate;
  }
  /// Adds what pushes the body from outside.
  template <class Orientation>
  void addLoad(const RigidBodyState<Orientation>& state, StateDerivative<Orientation>& rate) const {
    if (load == nullptr) return;
    const Matrix3 R_WB = rotationMatrix(state.orientation);
    const Wrench pushed =
        model.mobility.project({load->in_world.force + times(R_WB, load->in_body.force),
                                load->in_world.torque + times(R_WB, load->in_body.torque)});
    rate.force_W += pushed.force;
    rate.torque_W += pushed.torque;
  }
  /// Of the centre of mass, in W, at the end of the piece.
  template <class Orientation>
  Twist twist(const RigidBodyState<Orientation>& state) const {
    return model.twist(state, thrusts.end);
  }
};

/// A spatial body on which nothing but engines, drag and weight acts, by the wrenches of its
/// engines at the stages: the same system, for less.
struct DrivenBodyOfEngines {
  const DrivenBody& body;  // whose model, environment and load count
  const Wrench* start;     // in B
  const Wrench* middle;    // likewise
  const Wrench* end;       // likewise

  /// That of a stage.
  const Wrench& at(Stage stage) const {
    if (stage == Stage::kStart) return *start;
    return stage == Stage::kMiddle ? *middle : *end;
  }
  /// dY/dt, as DrivenBody.
  template <class Orientation>
  StateDerivative<Orientation> derivative(const RigidBodyState<Orientation>& state,
                                          Stage stage) const {
    StateDerivative<Orientation> rate =
        body.model.derivativeOfEngines(state, at(stage), body.environment);
    body.addLoad(state, rate);
    return rate;
  }
  /// Of the centre of mass, in W.
  template <class Orientation>
  Twist twist(const RigidBodyState<Orientation>& state) const {
    return body.model.mobility.twist(state);
  }
};

/// integrationStep() of a body by whichever of the two it is; for the library.
template <class Orientation>
RigidBodyState<Orientation> bodyStep(Integrator integrator, const RigidBodyState<Orientation>& y,
                                     const DrivenBody& f, double h) {
  const HovercraftModel& model = f.model;
  if (model.hasMoreForces() || model.mobility.isPlanar()) {
    return integrationStep<Orientation, DrivenBody>(integrator, y, f, h);
  }
  const Wrench start = model.wrenchOfEngines(f.thrusts.start);
  Wrench middle;
  Wrench end;
  DrivenBodyOfEngines system = {f, &start, &start, &start};
  const bool is_of_order_4 =
      integrator == Integrator::kRungeKutta4 || integrator == Integrator::kLie4;
  if (!f.is_steady && (is_of_order_4 || integrator == Integrator::kHeun)) {
    end = model.wrenchOfEngines(f.thrusts.end);
    system.end = &end;
  }
  if (!f.is_steady && is_of_order_4) {
    middle = model.wrenchOfEngines(f.thrusts.middle);
    system.middle = &middle;
  }
  return integrationStep<Orientation, DrivenBodyOfEngines>(integrator, y, system, h);
}

/// integrationStep() of a body, which Simulation makes: a function of the library, so that a
/// program gets its bits whatever the program itself was compiled with.
/// @param h s. The floating-point environment is that of IEEE 754 meanwhile.
HOVERCRAFT_PUBLIC RigidBodyState<Quaternion> integrationStep(Integrator integrator,
                                                             const RigidBodyState<Quaternion>& y,
                                                             const DrivenBody& f, double h);
HOVERCRAFT_PUBLIC RigidBodyState<Matrix3> integrationStep(Integrator integrator,
                                                          const RigidBodyState<Matrix3>& y,
                                                          const DrivenBody& f, double h);

}  // namespace hovercraft
