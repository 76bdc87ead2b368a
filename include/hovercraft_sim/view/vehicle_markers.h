#pragma once

#include <cstddef>
#include <string>
#include <vector>
#include <visualization_msgs/Marker.h>

#include <geometry_msgs/Point.h>
#include <hovercraft_sim/EngineStatus.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft_ros {

/// What RViz shows of one craft, made from its scenario. Markers in base_link are locked to that
/// frame: tf moves them.

/// A marker that is to be filled: without scale, colour and lifetime, at the origin of its frame.
visualization_msgs::Marker markerOf(const std::string& frame, const std::string& space, int id,
                                    int type);

/// The box of uniform density that has the mass and the inertia of a craft described by numbers;
/// edges in m.
HOVERCRAFT_PUBLIC hovercraft::Vector3 equivalentBox(const hovercraft::MassProperties& body);

/// Hull (its parts, or the equivalent box), bow and engines, in base_link.
/// @param index of the craft in its scenario: each has a colour, after kCraftColors they repeat.
HOVERCRAFT_PUBLIC std::vector<visualization_msgs::Marker> craftMarkers(
    const hovercraft::VehicleScenario& craft, std::size_t index = 0);
constexpr std::size_t kCraftColors = 6;

/// The name of a craft above it, in base_link.
HOVERCRAFT_PUBLIC visualization_msgs::Marker nameMarker(const hovercraft::VehicleScenario& craft);

/// An arrow per engine along the force that it exerts on the craft; its length grows with the
/// applied thrust. Red while the command is saturated, else orange.
HOVERCRAFT_PUBLIC std::vector<visualization_msgs::Marker> thrustMarkers(
    const hovercraft::VehicleScenario& craft, const hovercraft_sim::EngineStatus& engines);

/// The hull of a loose body, locked to `<name>/base_link`.
HOVERCRAFT_PUBLIC visualization_msgs::Marker bodyMarker(const hovercraft::VehicleScenario& body);

/// The fixed obstacles of a scenario, in the world frame.
HOVERCRAFT_PUBLIC std::vector<visualization_msgs::Marker> obstacleMarkers(
    const hovercraft::Scenario& scenario, const std::string& world_frame);

/// Puts the prefix of tf frames (TfFrames) before the frame of each.
void addPrefix(const std::string& prefix, std::vector<visualization_msgs::Marker>& markers);

/// The way that base_link came, a line in the world frame.
HOVERCRAFT_PUBLIC visualization_msgs::Marker pathMarker(
    const hovercraft::VehicleScenario& craft, const std::string& world_frame,
    const std::vector<geometry_msgs::Point>& path);

}  // namespace hovercraft_ros
