#pragma once

#include <string>

#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/RunEvent.h>
#include <hovercraft_sim/State.h>
#include <hovercraft_sim/States.h>
#include <rosbag/message_instance.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft_ros {

/// Whether a name of a topic or frame ends so.
inline bool endsWith(const std::string& name, const std::string& end) {
  return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
}

/// Messages of a recording, checked as they are read: a bag is input of a user, whatever wrote it.
/// Each throws std::invalid_argument that names file, topic, time and rule.

/// Its tick fits hovercraft::Tick, it is for engines and actuators that the craft has, its thrusts
/// and values are finite.
HOVERCRAFT_PUBLIC boost::shared_ptr<const hovercraft_sim::AppliedCommand> readAppliedCommand(
    const std::string& path, const rosbag::MessageInstance& instance,
    const hovercraft::VehicleScenario& craft);

/// Its ticks fit hovercraft::Tick, its kind is known, and what that kind uses is finite, its
/// quaternion of length 1. Whether vehicle and snapshot fit the scenario is seen by applyEvent().
HOVERCRAFT_PUBLIC boost::shared_ptr<const hovercraft_sim::RunEvent> readRunEvent(
    const std::string& path, const rosbag::MessageInstance& instance);

/// Its tick fits hovercraft::Tick. Its numbers are what a replay compares: they may be any.
HOVERCRAFT_PUBLIC boost::shared_ptr<const hovercraft_sim::State> readState(
    const std::string& path, const rosbag::MessageInstance& instance);

/// Likewise of each, and there is a name for each.
HOVERCRAFT_PUBLIC boost::shared_ptr<const hovercraft_sim::States> readStates(
    const std::string& path, const rosbag::MessageInstance& instance);

}  // namespace hovercraft_ros
