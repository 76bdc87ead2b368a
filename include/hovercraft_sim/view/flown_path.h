#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <geometry_msgs/Point.h>
#include <ros/time.h>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// The path of one craft as it is drawn, without a line across what was not flown: it begins anew
/// with each episode (a reset, a load) and where stamps go back (a bag is played again). Poses and
/// states come on topics of their own, so each may be heard before the other.
class HOVERCRAFT_PUBLIC FlownPath {
 public:
  /// A state was heard. @param stamp of the tick, which a pose of the same tick has too.
  void enter(std::uint32_t episode, const ros::Time& stamp);
  /// A pose was heard.
  void extend(const geometry_msgs::Point& here, const ros::Time& stamp);

  /// At least kSpacing apart; the older half is forgotten when there are kLongest.
  const std::vector<geometry_msgs::Point>& points() const { return points_; }

  static constexpr double kSpacing = 0.02;        // m
  static constexpr std::size_t kLongest = 10000;  // points

 private:
  void forget(std::size_t count);

  std::vector<geometry_msgs::Point> points_;
  std::vector<ros::Time> stamps_;  // of the points
  std::optional<std::uint32_t> episode_;
  ros::Time begin_;       // poses before it belong to another episode
  ros::Time last_state_;  // when it was, in ROS time
  ros::Time last_pose_;
};

}  // namespace hovercraft_ros
