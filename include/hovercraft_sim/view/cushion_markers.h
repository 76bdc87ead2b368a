#pragma once

#include <string>
#include <vector>
#include <visualization_msgs/Marker.h>

#include <hovercraft_sim/Cushion.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft_ros {

/// What RViz shows of a cushion, in base_link: a point for each point of the hem and, for each
/// cell, a pillar of pressure (as long as the cell is wide at the pressure that carries the craft)
/// and its gap as text, mm. None of a craft without a cushion; without a message yet, the hem
/// alone.
HOVERCRAFT_PUBLIC std::vector<visualization_msgs::Marker> cushionMarkers(
    const hovercraft::VehicleScenario& craft, const hovercraft_sim::Cushion& cushion);

/// The ground of a scenario besides obstacles, in the world frame: a height map as triangles, a
/// plane as a sheet of 20 m. None without it.
HOVERCRAFT_PUBLIC std::vector<visualization_msgs::Marker> groundMarkers(
    const hovercraft::Scenario& scenario, const std::string& world_frame);

}  // namespace hovercraft_ros
