#pragma once

#include <functional>
#include <string>

namespace hovercraft_ros::testing {

/// Handles ROS callbacks until the condition holds; it is asked after every callback, and at least
/// every 10 ms.
/// @param what is awaited, for the error.
/// @throws std::runtime_error if it does not hold after half a minute of wall time.
void waitUntil(const std::string& what, const std::function<bool()>& condition);

}  // namespace hovercraft_ros::testing
