#pragma once

#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/tf_frames.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft_ros {

/// Where a node puts the description of a craft, relative to the namespace of the craft.
constexpr const char* kRobotDescription = "robot_description";

/// A craft as URDF, for RViz's RobotModel: one link, named as its frame in tf, with its parts (or
/// the mesh of `visual`, or the equivalent box), a cylinder for each engine that is built in, and a
/// ball at each point of its skirt's hem. Inertia is that of the scenario. A cone, which URDF does
/// not know, is a stack of cylinders.
HOVERCRAFT_PUBLIC std::string urdfOf(const hovercraft::VehicleScenario& craft,
                                     const TfFrames& frames);

}  // namespace hovercraft_ros
