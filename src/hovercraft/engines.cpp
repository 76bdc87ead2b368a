#include "hovercraft_sim/hovercraft/engines.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/elementary.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/tolerances.h"

namespace hovercraft {

EngineDynamics::EngineDynamics(const std::array<EngineParameters, kEngineCount>& parameters,
                               std::int64_t step_ns)
    : parameters_(parameters), step_ns_(step_ns) {
  const FloatingPointEnvironment environment;
  demand(step_ns > 0, "step size must be checked before");
  const double h = toSeconds(step_ns);
  for (int i = 0; i < kEngineCount; ++i) {
    const double time_constant = parameters[static_cast<std::size_t>(i)].time_constant;
    if (time_constant > 0.0) {
      half_decay_[i] = exactExp(-0.5 * h / time_constant);
      full_decay_[i] = exactExp(-h / time_constant);
    }
  }
}

double EngineDynamics::demandedThrust(int engine, const EngineState& state, Tick tick) const {
  if (isTimedOut(engine, state, tick)) return 0.0;
  const auto& limits = parameters_[static_cast<std::size_t>(engine)];
  return std::clamp(state.commanded, limits.min_thrust, limits.max_thrust);
}

ThrustCourse EngineDynamics::course(const EngineStates& states, Tick tick) const {
  ThrustCourse course;
  for (int i = 0; i < kEngineCount; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const double demanded = demandedThrust(i, states[index], tick);
    const bool lags = parameters_[index].time_constant > 0.0;
    double lead = lags ? states[index].thrust - demanded : 0.0;
    if (std::abs(lead) < kSettledThrust) lead = 0.0;
    course.start[i] = demanded + lead;
    course.middle[i] = demanded + lead * half_decay_[i];
    course.end[i] = demanded + lead * full_decay_[i];
  }
  return course;
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
