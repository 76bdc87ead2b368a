#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/pilot/pilot.h"
#include "hovercraft_sim/pilot/turning.h"
#include "hovercraft_sim/scenario/pilot_parser.h"
#include "hovercraft_sim/sim/command_log.h"

namespace hovercraft {

/// How the body of a craft moves: B at the centre of mass, velocities in W.
struct ObservedMotion {
  Tick tick = 0;
  Vector3 p_WB = Vector3::Zero();  // m
  Quaternion q_WB;                 // B -> W
  Vector3 v_WB = Vector3::Zero();  // m/s
  Vector3 w_WB = Vector3::Zero();  // rad/s
};

/// A pilot at the actuators of a craft: from motions to commands, the same live (PilotNode) and in
/// `simulate`. It decides at the ticks that are multiples of its period, tick 0 left out, as in
/// lockstep the first state comes at the end of a period. When its plan is flown it commands the
/// levels that there were before, for kPilotSettleNs of simulated time.
class HOVERCRAFT_PUBLIC CraftPilot {
 public:
  /// @param step_ns of the scenario.
  CraftPilot(PilotFile file, std::int64_t step_ns);

  std::size_t vehicle() const { return file_.vehicle; }
  /// Whether it decides at a tick.
  bool isDue(Tick tick) const { return tick > 0 && tick % file_.period_ticks == 0; }
  /// Whether it decides at `now`, where it last saw a motion at `last`, both 0 or greater: a tick
  /// at which it should have decided has come since.
  bool isDueSince(Tick last, Tick now) const {
    return now / file_.period_ticks > last / file_.period_ticks;
  }
  /// Whether one of those ticks lies between the two: the flight is another one than in `simulate`.
  bool hasMissed(Tick last, Tick now) const { return now > last && isDueSince(last, now - 1); }
  Tick periodTicks() const { return file_.period_ticks; }
  /// The command for the tick of the motion. @param motion at a tick after that of the last one.
  const Command& decide(const ObservedMotion& motion);
  /// The last one; before the first, at tick 0, the levels that there are then.
  const Command& command() const { return command_; }

  /// The plan is flown, and the time after it is over.
  bool isOver() const { return is_over_; }
  bool isFlown() const { return pilot_.isDone(); }
  const std::vector<FlownManoeuvre>& flown() const { return pilot_.flown(); }
  void giveUp(const std::string& reason) { pilot_.giveUp(reason); }
  /// An upper bound of the tick at which it is over, if it begins at tick 0.
  Tick lastTick() const;

 private:
  double commandOf(std::size_t id, double level) const;

  PilotFile file_;
  std::int64_t step_ns_;
  Pilot pilot_;
  MotionWatch watch_;
  Command command_;
  Tick flown_tick_ = -1;  // at which its plan was flown
  bool is_over_ = false;
};
constexpr std::int64_t kPilotSettleNs = 1000000000;

}  // namespace hovercraft
