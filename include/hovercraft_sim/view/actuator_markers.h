#pragma once

#include <vector>
#include <visualization_msgs/Marker.h>

#include <hovercraft_sim/ActuatorStatusArray.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft_ros {

/// What RViz shows of a craft's actuators besides its engines, in base_link: a disc for each fan,
/// propeller and lift fan, with an arrow along its thrust that grows with its level as a share of
/// the greater limit; for each rudder a plate of its area at its angle. An arrow or plate is red
/// while the command is saturated, violet while the actuator has a fault.
/// @param status of the actuators by their ids; where it lacks one, that is drawn at level 0.
HOVERCRAFT_PUBLIC std::vector<visualization_msgs::Marker> actuatorMarkers(
    const hovercraft::VehicleScenario& craft, const hovercraft_sim::ActuatorStatusArray& status);

}  // namespace hovercraft_ros
