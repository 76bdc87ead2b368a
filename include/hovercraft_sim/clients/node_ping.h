#pragma once

#include <string>

namespace hovercraft_ros {

/// Whether a node answers, as `rosnode ping` asks it: one that was killed leaves its topics
/// registered at the master. False too if the master does not answer. Waits for the answer.
/// @param node its full name.
bool answers(const std::string& node);

}  // namespace hovercraft_ros
