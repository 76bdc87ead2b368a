#pragma once

#include <string>

#include <ros/node_handle.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft_ros {

/// The scenario that a simulation publishes (its ~scenario, latched); waits for it for 30 s of wall
/// time. @param topic relative to the handle, as it is remapped.
/// @throws std::runtime_error that names the topic if none comes, std::invalid_argument if it
/// cannot be read.
HOVERCRAFT_PUBLIC hovercraft::Scenario receiveScenario(const ros::NodeHandle& handle,
                                                       const std::string& topic);

/// Interrupts the roslaunch that started this node, as Ctrl-C does, and waits to be stopped with
/// everything else that it launched. (It would report a required node that ends as dead.)
HOVERCRAFT_PUBLIC void endLaunch();

}  // namespace hovercraft_ros
