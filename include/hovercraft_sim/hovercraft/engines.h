#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/hovercraft/actuator_array.h"
#include "hovercraft_sim/hovercraft/command_map.h"
#include "hovercraft_sim/hovercraft/rotors.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The three engines (figure 7 of the source: c, l, p), the first of the actuators.
using EngineId = ActuatorId;
constexpr int kEngineCount = 3;  // engines of a craft
static_assert(kEngineCount == kFirstActuator, "the other actuators follow the engines");
constexpr std::array<const char*, kEngineCount> kEngineNames = {"rear", "left", "right"};  // by id

/// Simulated seconds after which an engine without a new command stops, where the scenario does not
/// say.
constexpr double kDefaultCommandTimeout = 0.5;

/// How an engine, or another actuator, follows its commands, as the scenario describes it. What
/// lags is a thrust in N, or with another actuator its level (ActuatorScenario).
struct EngineParameters {
  Vector3 p_HE = Vector3::Zero();        // position in the hull frame (base_link), m
  Vector3 direction = Vector3::UnitX();  // unit vector of positive thrust, in B
  double min_thrust = 0.0;               // N, <= 0
  double max_thrust = 0.0;               // N, >= 0
  double time_constant = 0.0;            // s, first-order lag of thrust; 0 = none
  std::int64_t timeout_ns = 0;           // ns since the last command; 0 = never
  CommandMap command = {};               // from a command to the thrust that it asks for
  RotorParameters rotor = {};            // about `direction`
};

/// What an actuator remembers from one tick to the next.
struct EngineState {
  static constexpr Tick kNever = -1;  // tick of no command

  double commanded = 0.0;  // as received; before the first command the level, N
  double thrust = 0.0;     // N, along the engine's direction, or its level; after limits and lag
  Tick command_tick = kNever;  // at which the last command took effect
  double efficiency = 1.0;     // 0 to 1: the share that is left of what is demanded
  bool stuck = false;          // the thrust stays as it is

  bool isFaulty() const { return stuck || efficiency != 1.0; }  // whether a fault acts
};
using EngineStates = ActuatorArray<EngineState>;  // of all actuators, by id

/// Thrusts and levels as they are.
inline ActuatorArray<double> levelsOf(const EngineStates& states) {
  ActuatorArray<double> levels;
  levels.resize(states.size());
  for (std::size_t id = 0; id < states.size(); ++id) levels[id] = states[id].thrust;
  return levels;
}

/// Thrusts, N, and levels of all actuators over one step: at its stages, and in between.
struct ThrustCourse {
  ActuatorArray<double> start;   // at t
  ActuatorArray<double> middle;  // at t + h/2
  ActuatorArray<double> end;     // at t + h

  /// At a share x of the step, 0 to 1: the parabola through its start, middle and end, which is
  /// exact there and off by the cube of the step over the lag in between.
  ActuatorArray<double> at(double x) const {
    const double at_start = (1.0 - x) * (1.0 - 2.0 * x);
    const double at_middle = 4.0 * x * (1.0 - x);
    const double at_end = x * (2.0 * x - 1.0);
    ActuatorArray<double> values = start;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = (at_start * start[i] + at_middle * middle[i]) + at_end * end[i];
    }
    return values;
  }
  /// Over the piece from `from` to `to` of a step of h, all in s.
  ThrustCourse piece(double from, double to, double h) const {
    return {at(from / h), at(0.5 * (from + to) / h), at(to / h)};
  }

  const ActuatorArray<double>& at(Stage stage) const {
    if (stage == Stage::kStart) return start;
    return stage == Stage::kMiddle ? middle : end;
  }
};

/// Limits, lag and time-out of the engines and the other actuators of one craft at a fixed step
/// size.
class HOVERCRAFT_PUBLIC EngineDynamics {
 public:
  /// What a step needs of an engine.
  struct Rule {
    double min_thrust = 0.0;                                // N
    double max_thrust = 0.0;                                // N
    double half_decay = 0.0;                                // exp(-h/2τ); 0 without lag
    double full_decay = 0.0;                                // exp(-h/τ)
    Tick timeout_ticks = std::numeric_limits<Tick>::max();  // whole steps, rounded up; never
    bool lags = false;                                      // time_constant > 0
    std::shared_ptr<const CommandMap> map;                  // null: a command is the thrust
  };

  /// @param step_ns length of a step, ns, > 0.
  EngineDynamics(const ActuatorArray<EngineParameters>& parameters, std::int64_t step_ns);

  /// Simulated time from the tick at which the last command took effect to `tick`, ns; -1 if there
  /// was none.
  std::int64_t commandAge(const EngineState& state, Tick tick) const {
    return state.command_tick == EngineState::kNever ? -1 : (tick - state.command_tick) * step_ns_;
  }

  /// The last command is as old as the time-out or older.
  bool isTimedOut(int engine, const EngineState& state, Tick tick) const {
    return isTimedOut(rules_[static_cast<std::size_t>(engine)], state, tick);
  }

  /// The last command lies beyond the engine's limits.
  bool isSaturated(int engine, const EngineState& state) const {
    return isSaturated(rules_[static_cast<std::size_t>(engine)], state);
  }

  /// The thrust that the engine strives for in the step that begins at `tick`, N.
  double demandedThrust(int engine, const EngineState& state, Tick tick) const {
    return demandOf(rules_[static_cast<std::size_t>(engine)], state, tick);
  }

  const Rule& rule(std::size_t id) const { return rules_[id]; }  // of an actuator

  /// The same of a rule that is kept elsewhere.
  static bool isTimedOut(const Rule& rule, const EngineState& state, Tick tick) {
    return state.command_tick != EngineState::kNever &&
           tick - state.command_tick >= rule.timeout_ticks;
  }
  static bool isSaturated(const Rule& limits, const EngineState& state) {
    if (isMapped(limits, state)) {
      return limits.map->exceeds(state.commanded, limits.min_thrust, limits.max_thrust);
    }
    return state.commanded < limits.min_thrust || state.commanded > limits.max_thrust;
  }
  /// N or level.
  static double demandOf(const Rule& rule, const EngineState& state, Tick tick) {
    if (state.stuck) return state.thrust;
    if (isTimedOut(rule, state, tick)) return 0.0;
    const double level = isMapped(rule, state)
                             ? rule.map->levelOf(state.commanded, rule.min_thrust, rule.max_thrust)
                             : state.commanded;
    return state.efficiency * std::clamp(level, rule.min_thrust, rule.max_thrust);
  }

  /// Thrusts in the step that begins at `tick`. Without lag the thrust is the demand from the start
  /// of the step on; with lag it is the exact solution of T' = (demand - T)/time_constant at each
  /// stage.
  ThrustCourse course(const EngineStates& states, Tick tick) const;
  /// The same, written into what the last step left there.
  /// @returns the tick of the first step that has other thrusts if neither command nor fault comes:
  /// `tick` itself where a thrust changes within the step.
  [[nodiscard]] Tick course(const EngineStates& states, Tick tick, ThrustCourse& course) const;

 private:
  /// Before the first command what is commanded is a level.
  static bool isMapped(const Rule& rule, const EngineState& state) {
    return rule.map != nullptr && state.command_tick != EngineState::kNever;
  }

  Tick nextTimeout(const EngineStates& states, Tick tick) const;

  std::int64_t step_ns_;
  ActuatorArray<Rule> rules_;
};

/// From three thrusts to the wrench about the centre of mass: (33) to (37) as two 3×3 matrices.
class HOVERCRAFT_PUBLIC EngineGeometry {
 public:
  /// @param p_HB centre of mass in the hull frame, m.
  EngineGeometry(const std::array<EngineParameters, kEngineCount>& parameters, const Vector3& p_HB);

  /// Force (33) and moment (37), both in B, of the thrusts (rear, left, right; N).
  Wrench wrenchInBody(const Vector3& thrusts) const {
    return {times(force_map_, thrusts), times(torque_map_, thrusts)};
  }
  /// Column i: force (N) and moment (N m) of 1 N of engine i.
  const Matrix3& forceMap() const { return force_map_; }
  const Matrix3& torqueMap() const { return torque_map_; }  // N m

 private:
  Matrix3 force_map_;   // column i: direction of engine i
  Matrix3 torque_map_;  // column i: r_i × direction of engine i, (34) to (36) for 1 N
};

}  // namespace hovercraft
