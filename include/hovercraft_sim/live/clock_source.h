#pragma once

#include <cstdint>
#include <functional>

#include <ros/time.h>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// Publishes simulated time on /clock, seldom enough for Python nodes: once per period of simulated
/// time, and never more often than NodeConfig::kMaxClockRate of wall time. Never time 0, which ROS
/// takes for "no time".
class HOVERCRAFT_PUBLIC ClockSource {
 public:
  /// @param publish sends a time on /clock. @param rate Hz of simulated time, checked.
  ClockSource(std::function<void(const ros::Time&)> publish, double rate);

  /// @param now_ns reading of a steady clock. @param is_idle the simulation waits: whoever sleeps
  /// on simulated time must see where it stands.
  void publishIfDue(const ros::Time& stamp, std::int64_t now_ns, bool is_idle);
  /// Simulated time from `stamp` until the next message, ns; 0 or less: it is due.
  std::int64_t untilDueNs(const ros::Time& stamp) const;

 private:
  std::function<void(const ros::Time&)> publish_;
  std::int64_t period_ns_;
  ros::Time last_stamp_;
  std::int64_t last_wall_ns_ = 0;
};

}  // namespace hovercraft_ros
