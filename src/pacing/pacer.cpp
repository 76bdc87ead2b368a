#include "hovercraft_sim/pacing/pacer.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/demand.h"

namespace hovercraft {

Pacer::Pacer(std::int64_t step_ns, double real_time_factor)
    : wall_ns_per_step_(static_cast<double>(step_ns) / real_time_factor) {
  demand(wall_ns_per_step_ > 0.0 && std::isfinite(wall_ns_per_step_),
         "step size and real-time factor must be checked before");
}

void Pacer::restart(Tick tick, std::int64_t now_ns) {
  first_tick_ = tick;
  origin_ns_ = now_ns;
}

void Pacer::forgiveWait(Tick tick, std::int64_t now_ns) {
  origin_ns_ += std::max<std::int64_t>(now_ns - deadline(tick) - kMaxBacklogNs / 2, 0);
}

std::int64_t Pacer::deadline(Tick tick) const {
  return origin_ns_ + std::llround(static_cast<double>(tick - first_tick_) * wall_ns_per_step_);
}

std::int64_t Pacer::giveUpBacklog(Tick next, std::int64_t now_ns) {
  const std::int64_t excess = now_ns - deadline(next) - kMaxBacklogNs;
  if (excess <= 0) return 0;
  origin_ns_ += excess;
  return excess;
}

}  // namespace hovercraft
