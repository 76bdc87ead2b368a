#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The actuators that a command is for: bit i stands for that of id i (rear 1, left 2, right 4,
/// then the others).
using EngineMask = std::uint16_t;
constexpr EngineMask kAllEngines = 7;  // rear, left and right
static_assert(kMaxActuators <= 16, "a mask has a bit for each actuator");
/// The mask of one.
constexpr EngineMask maskOf(ActuatorId actuator) {
  return static_cast<EngineMask>(1U << static_cast<unsigned>(actuator));
}
constexpr EngineMask maskOf(std::size_t id) {
  return static_cast<EngineMask>(1U << id);
}

/// What is demanded of one craft from a tick on, until the next command or the time-out.
struct Command {
  Tick tick = 0;                     // the first step that it acts in begins here
  std::size_t vehicle = 0;           // index into Scenario::vehicles
  EngineMask engines = kAllEngines;  // which of the thrusts count
  /// By id: rear, left, right in N, then the others; finite; counted only where the mask has it.
  ActuatorArray<double> thrusts;
};

/// Makes `held` what holds when `command` comes after it: its values for what the command is for.
/// The tick and the craft of `held` stay.
HOVERCRAFT_PUBLIC void hold(const Command& command, Command& held);

/// Commands that wait for their tick, in the order of ticks; of one tick, in the order in which
/// they came. One that a later command of its tick replaces for all its engines has no effect on
/// any state and does not wait: what comes without a step in between takes bounded memory.
class HOVERCRAFT_PUBLIC CommandLog {
 public:
  /// @param command its tick is not before that of the last one pushed.
  void push(const Command& command);

  /// The next command with tick <= `tick`, or null; it stays valid until the next push().
  const Command* takeDue(Tick tick);

  bool empty() const { return next_ == waiting_.size(); }  // whether none waits
  /// Of the next command; the greatest there is if none waits.
  Tick nextTick() const {
    return empty() ? std::numeric_limits<Tick>::max() : waiting_[next_].tick;
  }
  /// Those that takeDue() has not given yet, in their order.
  std::vector<Command> waiting() const;

 private:
  void dropReplacedBy(const Command& command);

  std::vector<Command>
      waiting_;  // the memory is kept from step to step: nothing is allocated once it has grown
  std::size_t next_ = 0;
};

}  // namespace hovercraft
