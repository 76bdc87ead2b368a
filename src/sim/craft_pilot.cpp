#include "hovercraft_sim/sim/craft_pilot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/sim/command_source.h"

namespace hovercraft {

CraftPilot::CraftPilot(PilotFile file, std::int64_t step_ns)
    : file_(std::move(file)), step_ns_(step_ns), pilot_(file_.plan) {
  command_.vehicle = file_.vehicle;
  command_.engines = 0;
  command_.thrusts.resize(file_.idle.size());
  for (std::size_t id = 0; id < file_.idle.size(); ++id) {
    command_.thrusts[id] = commandOf(id, file_.idle[id]);
  }
  const auto is_other = [](std::size_t id) { return id >= kFirstActuator; };
  const bool has_others = std::any_of(file_.channels.begin(), file_.channels.end(), is_other);
  for (const std::size_t id : file_.channels) {
    // Live, a ThrustCommand is for all three engines, an ActuatorCommand for those that it names.
    const EngineMask mask = has_others || is_other(id) ? maskOf(id) : kAllEngines;
    command_.engines = static_cast<EngineMask>(command_.engines | mask);
  }
}

/// What commands a level of an actuator.
double CraftPilot::commandOf(std::size_t id, double level) const {
  const EngineParameters& actuator = file_.actuators[id];
  return actuator.command.commandOf(level, actuator.min_thrust, actuator.max_thrust);
}

const Command& CraftPilot::decide(const ObservedMotion& motion) {
  const FloatingPointEnvironment environment;
  const PlanarMotion seen = watch_.see(toSeconds(motion.tick * step_ns_), motion.p_WB, motion.q_WB,
                                       motion.v_WB, motion.w_WB);
  const Levels& decided = pilot_.decide(seen);
  const Levels& levels = decided.empty() ? file_.idle : decided;
  command_.tick = motion.tick;
  for (const std::size_t id : file_.channels) command_.thrusts[id] = commandOf(id, levels[id]);
  if (pilot_.isDone() && flown_tick_ < 0) flown_tick_ = motion.tick;
  is_over_ = flown_tick_ >= 0 && motion.tick >= flown_tick_ + firstTickAt(kPilotSettleNs, step_ns_);
  return command_;
}

Tick CraftPilot::lastTick() const {
  const FloatingPointEnvironment environment;
  double longest = toSeconds(kPilotSettleNs) + 4.0 * file_.plan.period;
  for (const Manoeuvre& manoeuvre : file_.plan.manoeuvres) {
    longest += manoeuvre.approach + manoeuvre.longest + 2.0 * file_.plan.period;
  }
  return static_cast<Tick>(std::ceil(longest / toSeconds(step_ns_)));
}

}  // namespace hovercraft
