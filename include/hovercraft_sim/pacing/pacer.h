#pragma once

#include <cstdint>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"

namespace hovercraft {

/// When each step is due on a steady clock. Deadlines are counted from one origin, so that no error
/// adds up:
///   deadline(n) = origin + (n - first tick) · h / real-time factor.
/// A pure function of the clock readings that it is given (ns, any epoch). The step size never
/// changes: who falls behind by more than the bound lets wall time go instead.
class HOVERCRAFT_PUBLIC Pacer {
 public:
  /// Backlog (ns) that is caught up; what lies beyond is given up.
  static constexpr std::int64_t kMaxBacklogNs = 100000000;

  /// @param step_ns simulated time of a step, ns, > 0. @param real_time_factor simulated per wall
  /// time, > 0.
  Pacer(std::int64_t step_ns, double real_time_factor);

  /// Begins anew: `tick` is reached at `now_ns`.
  void restart(Tick tick, std::int64_t now_ns);

  /// Someone else, a controller, kept the simulation at `tick` until `now_ns`: backlog beyond half
  /// the bound is let go, so that what giveUpBacklog() finds next is the simulation's own.
  void forgiveWait(Tick tick, std::int64_t now_ns);

  /// When the simulation should have reached `tick`, ns.
  std::int64_t deadline(Tick tick) const;

  /// Wall time given up because the backlog at `now_ns` is beyond the bound, ns; mostly 0. `next`
  /// is the next tick to reach.
  std::int64_t giveUpBacklog(Tick next, std::int64_t now_ns);

 private:
  double wall_ns_per_step_;
  Tick first_tick_ = 0;
  std::int64_t origin_ns_ = 0;
};

}  // namespace hovercraft
