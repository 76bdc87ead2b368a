#include "wait_until.h"

#include <chrono>
#include <stdexcept>

#include <ros/callback_queue.h>
#include <ros/init.h>

namespace hovercraft_ros::testing {

void waitUntil(const std::string& what, const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!condition()) {
    if (!ros::ok()) throw std::runtime_error("ROS was shut down while waiting until " + what);
    if (std::chrono::steady_clock::now() > deadline) {
      throw std::runtime_error("waited in vain until " + what);
    }
    ros::getGlobalCallbackQueue()->callOne(ros::WallDuration(0.01));
  }
}

}  // namespace hovercraft_ros::testing
