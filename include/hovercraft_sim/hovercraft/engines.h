#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/body/steppers.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The three engines (figure 7 of the source: c, l, p), in the order of every array of three.
enum class EngineId : int { kRear = 0, kLeft = 1, kRight = 2 };
constexpr int kEngineCount = 3;
constexpr std::array<const char*, kEngineCount> kEngineNames = {"rear", "left", "right"};

/// Simulated seconds after which an engine without a new command stops, where the scenario does not
/// say.
constexpr double kDefaultCommandTimeout = 0.5;

/// One engine as the scenario describes it.
struct EngineParameters {
  Vector3 p_HE = Vector3::Zero();        // position in the hull frame (base_link), m
  Vector3 direction = Vector3::UnitX();  // unit vector of positive thrust, in B
  double min_thrust = 0.0;               // N, <= 0
  double max_thrust = 0.0;               // N, >= 0
  double time_constant = 0.0;            // s, first-order lag of thrust; 0 = none
  std::int64_t timeout_ns = 0;           // ns since the last command; 0 = never
};

/// What an engine remembers from one tick to the next.
struct EngineState {
  static constexpr Tick kNever = -1;

  double commanded = 0.0;      // N, as received
  double thrust = 0.0;         // N, along the engine's direction, after limits and lag
  Tick command_tick = kNever;  // at which the last command took effect
};
using EngineStates = std::array<EngineState, kEngineCount>;

/// The thrusts (rear, left, right; N) over one step: at its stages, and in between.
struct ThrustCourse {
  Vector3 start;
  Vector3 middle;
  Vector3 end;

  /// At a share x of the step, 0 to 1: the parabola through its start, middle and end, which is
  /// exact there and off by the cube of the step over the lag in between.
  Vector3 at(double x) const {
    const double at_start = (1.0 - x) * (1.0 - 2.0 * x);
    const double at_middle = 4.0 * x * (1.0 - x);
    const double at_end = x * (2.0 * x - 1.0);
    return (at_start * start + at_middle * middle) + at_end * end;
  }
  /// Over the piece from `from` to `to` of a step of h, all in s.
  ThrustCourse piece(double from, double to, double h) const {
    return {at(from / h), at(0.5 * (from + to) / h), at(to / h)};
  }

  const Vector3& at(Stage stage) const {
    if (stage == Stage::kStart) return start;
    return stage == Stage::kMiddle ? middle : end;
  }
};

/// Limits, lag and time-out of the three engines of one craft at a fixed step size.
class HOVERCRAFT_PUBLIC EngineDynamics {
 public:
  /// @param step_ns length of a step, ns, > 0.
  EngineDynamics(const std::array<EngineParameters, kEngineCount>& parameters,
                 std::int64_t step_ns);

  /// Simulated time from the tick at which the last command took effect to `tick`, ns; -1 if there
  /// was none.
  std::int64_t commandAge(const EngineState& state, Tick tick) const {
    return state.command_tick == EngineState::kNever ? -1 : (tick - state.command_tick) * step_ns_;
  }

  /// The last command is as old as the time-out or older.
  bool isTimedOut(int engine, const EngineState& state, Tick tick) const {
    return state.command_tick != EngineState::kNever &&
           tick - state.command_tick >= rules_[static_cast<std::size_t>(engine)].timeout_ticks;
  }

  /// The last command lies beyond the engine's limits.
  bool isSaturated(int engine, const EngineState& state) const {
    const Rule& limits = rules_[static_cast<std::size_t>(engine)];
    return state.commanded < limits.min_thrust || state.commanded > limits.max_thrust;
  }

  /// The thrust that the engine strives for in the step that begins at `tick`, N.
  double demandedThrust(int engine, const EngineState& state, Tick tick) const {
    if (isTimedOut(engine, state, tick)) return 0.0;
    const Rule& limits = rules_[static_cast<std::size_t>(engine)];
    return std::clamp(state.commanded, limits.min_thrust, limits.max_thrust);
  }

  /// Thrusts in the step that begins at `tick`. Without lag the thrust is the demand from the start
  /// of the step on; with lag it is the exact solution of T' = (demand - T)/time_constant at each
  /// stage.
  ThrustCourse course(const EngineStates& states, Tick tick) const;

 private:
  /// What a step needs of an engine.
  struct Rule {
    double min_thrust = 0.0;                                // N
    double max_thrust = 0.0;                                // N
    double half_decay = 0.0;                                // exp(-h/2τ); 0 without lag
    double full_decay = 0.0;                                // exp(-h/τ)
    Tick timeout_ticks = std::numeric_limits<Tick>::max();  // whole steps, rounded up; never
    bool lags = false;
  };

  std::int64_t step_ns_;
  std::array<Rule, kEngineCount> rules_;
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

 private:
  Matrix3 force_map_;   // column i: direction of engine i
  Matrix3 torque_map_;  // column i: r_i × direction of engine i, (34) to (36) for 1 N
};

}  // namespace hovercraft
