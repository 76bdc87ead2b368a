#pragma once

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/report/recorded_topics.h"
#include "hovercraft_sim/report/run_data.h"

namespace hovercraft_ros {

/// Makes of what was recorded what a page shows. A bag of this package has states, engines,
/// contacts and its scenario; of any other bag, poses or odometry of any topic give the way and the
/// speeds, and whatever else has numbers gives curves.
/// @throws std::invalid_argument with the file if nothing in it tells where something was.
HOVERCRAFT_PUBLIC RunData runDataOf(const RecordedTopics& recorded);

}  // namespace hovercraft_ros
