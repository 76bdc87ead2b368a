#include "hovercraft_sim/live/clock_source.h"

#include <cmath>
#include <utility>

#include "hovercraft_sim/live/node_config.h"
#include "hovercraft_sim/math/time.h"

namespace hovercraft_ros {
namespace {

constexpr double kNsPerSecond = static_cast<double>(hovercraft::kNanosecondsPerSecond);
constexpr auto kLeastWallPeriodNs =
    static_cast<std::int64_t>(kNsPerSecond / NodeConfig::kMaxClockRate);

}  // namespace

ClockSource::ClockSource(std::function<void(const ros::Time&)> publish, double rate)
    : publish_(std::move(publish)), period_ns_(std::llround(kNsPerSecond / rate)) {}

void ClockSource::publishIfDue(const ros::Time& stamp, std::int64_t now_ns, bool is_idle) {
  if (stamp.isZero() || now_ns - last_wall_ns_ < kLeastWallPeriodNs) return;
  if (stamp == last_stamp_ || (!is_idle && untilDueNs(stamp) > 0)) return;
  publish_(stamp);
  last_stamp_ = stamp;
  last_wall_ns_ = now_ns;
}

std::int64_t ClockSource::untilDueNs(const ros::Time& stamp) const {
  return period_ns_ - (stamp - last_stamp_).toNSec();
}

}  // namespace hovercraft_ros
