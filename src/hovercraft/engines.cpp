#include "hovercraft_sim/hovercraft/engines.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {

EngineDynamics::EngineDynamics(const ActuatorArray<EngineParameters>& parameters,
                               std::int64_t step_ns)
    : step_ns_(step_ns) {
  const FloatingPointEnvironment environment;
  demand(step_ns > 0, "step size must be checked before");
  const double h = toSeconds(step_ns);
  rules_.resize(parameters.size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const EngineParameters& engine = parameters[i];
    Rule& rule = rules_[i];
    rule.min_thrust = engine.min_thrust;
    rule.max_thrust = engine.max_thrust;
    if (!engine.command.isPlain()) rule.map = std::make_shared<const CommandMap>(engine.command);
    if (engine.timeout_ns > 0) {
      rule.timeout_ticks = engine.timeout_ns / step_ns + (engine.timeout_ns % step_ns > 0 ? 1 : 0);
    }
    if (engine.time_constant > 0.0) {
      rule.lags = true;
      rule.half_decay = exactExp(-0.5 * h / engine.time_constant);
      rule.full_decay = exactExp(-h / engine.time_constant);
    }
  }
}

Tick EngineDynamics::course(const EngineStates& states, Tick tick, ThrustCourse& course) const {
  const std::size_t count = rules_.size();
  if (course.start.size() != count) {
    for (auto* values : {&course.start, &course.middle, &course.end}) values->resize(count);
  }
  const EngineState* state = states.begin();
  double* start = course.start.begin();
  double* middle = course.middle.begin();
  double* end = course.end.begin();
  bool is_steady = true;
  for (const Rule& rule : rules_) {
    const double demanded = demandOf(rule, *state, tick);
    double lead = rule.lags ? state->thrust - demanded : 0.0;
    if (std::abs(lead) < kSettledThrust) lead = 0.0;
    *start = demanded + lead;
    *middle = demanded + lead * rule.half_decay;
    *end = demanded + lead * rule.full_decay;
    // A lag ends some units in the last place before what it strives for.
    is_steady = is_steady && *start == *middle && *middle == *end;
    ++state, ++start, ++middle, ++end;
  }
  return is_steady ? nextTimeout(states, tick) : tick;
}

/// The first tick after `tick` at which an engine times out; if none does, the last there is.
Tick EngineDynamics::nextTimeout(const EngineStates& states, Tick tick) const {
  Tick next = std::numeric_limits<Tick>::max();
  const EngineState* state = states.begin();
  for (const Rule& rule : rules_) {
    if (state->command_tick != EngineState::kNever) {
      const Tick left = rule.timeout_ticks - (tick - state->command_tick);
      if (left > 0 && left < next - tick) next = tick + left;
    }
    ++state;
  }
  return next;
}

ThrustCourse EngineDynamics::course(const EngineStates& states, Tick tick) const {
  ThrustCourse result;
  static_cast<void>(course(states, tick, result));
  return result;
}

EngineGeometry::EngineGeometry(const std::array<EngineParameters, kEngineCount>& parameters,
                               const Vector3& p_HB) {
  const FloatingPointEnvironment environment;
  for (int i = 0; i < kEngineCount; ++i) {
    const EngineParameters& engine = parameters[static_cast<std::size_t>(i)];
    const Vector3 p_BE = engine.p_HE - p_HB;
    force_map_.col(i) = engine.direction;
    torque_map_.col(i) = cross(p_BE, engine.direction);
  }
}

}  // namespace hovercraft
