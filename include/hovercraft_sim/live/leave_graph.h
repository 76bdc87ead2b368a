#pragma once

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// Takes what this node publishes, subscribes to and serves out of the master's lists: all topics
/// by one call (system.multicall), where roscpp at its shutdown makes one for each, seconds with
/// many craft. The process is to end after it, without ros::shutdown(), which would make them
/// again. A master that does not answer is left as it is.
HOVERCRAFT_PUBLIC void leaveGraph();

}  // namespace hovercraft_ros
