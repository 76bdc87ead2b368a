#include "hovercraft_sim/view/flown_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace hovercraft_ros {

void FlownPath::forget(std::size_t count) {
  const auto end = static_cast<std::ptrdiff_t>(count);
  points_.erase(points_.begin(), points_.begin() + end);
  stamps_.erase(stamps_.begin(), stamps_.begin() + end);
}

void FlownPath::enter(std::uint32_t episode, const ros::Time& stamp) {
  const bool is_new = episode_.value_or(episode) != episode;
  const bool goes_back = stamp < last_state_;
  episode_ = episode;
  last_state_ = stamp;
  if (!is_new && !goes_back) return;
  begin_ = stamp;
  // Those of this tick may have been heard already; of a bag that begins again, all that is left.
  if (goes_back && last_pose_ > stamp) forget(points_.size());
  const auto first = std::lower_bound(stamps_.begin(), stamps_.end(), begin_);
  forget(static_cast<std::size_t>(first - stamps_.begin()));
}

void FlownPath::extend(const geometry_msgs::Point& here, const ros::Time& stamp) {
  if (stamp < begin_) return;
  if (stamp < last_pose_) forget(points_.size());
  last_pose_ = stamp;
  if (!points_.empty()) {
    const geometry_msgs::Point& last = points_.back();
    if (std::hypot(here.x - last.x, here.y - last.y, here.z - last.z) < kSpacing) return;
  }
  if (points_.size() == kLongest) forget(kLongest / 2);
  points_.push_back(here);
  stamps_.push_back(stamp);
}

}  // namespace hovercraft_ros
