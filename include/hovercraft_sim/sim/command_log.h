#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The engines that a command is for: bit i stands for engine i (rear 1, left 2, right 4).
using EngineMask = std::uint8_t;
constexpr EngineMask kAllEngines = 7;
constexpr EngineMask maskOf(EngineId engine) {
  return static_cast<EngineMask>(1U << static_cast<unsigned>(engine));
}

/// Thrusts demanded of one craft from a tick on, until the next command or the time-out.
struct Command {
  Tick tick = 0;            // the first step that it acts in begins here
  std::size_t vehicle = 0;  // index into Scenario::vehicles
  EngineMask engines = kAllEngines;
  Vector3 thrusts =
      Vector3::Zero();  // rear, left, right, N, finite; counted only where the mask has the engine
};

/// Commands that wait for their tick, in the order of ticks; of one tick, in the order in which
/// they came. One that a later command of its tick replaces for all its engines has no effect on
/// any state and does not wait: what comes without a step in between takes bounded memory.
class HOVERCRAFT_PUBLIC CommandLog {
 public:
  /// @param command its tick is not before that of the last one pushed.
  void push(const Command& command);

  /// The next command with tick <= `tick`, or null; it stays valid until the next push().
  const Command* takeDue(Tick tick);

  bool empty() const { return next_ == waiting_.size(); }
  /// Those that takeDue() has not given yet, in their order.
  std::vector<Command> waiting() const;

 private:
  void dropReplacedBy(const Command& command);

  std::vector<Command>
      waiting_;  // the memory is kept from step to step: nothing is allocated once it has grown
  std::size_t next_ = 0;
};

}  // namespace hovercraft
