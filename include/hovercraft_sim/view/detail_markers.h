#pragma once

#include <optional>
#include <string>
#include <vector>
#include <visualization_msgs/Marker.h>

#include <hovercraft_sim/Contact.h>
#include <hovercraft_sim/State.h>

#include "hovercraft_sim/analysis/nearest_pair.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

/// What RViz shows only if it is asked to (topic ~details of markers_node): forces, wind, contacts,
/// the nearest pair. All in the world frame.
namespace hovercraft_ros {

/// What is known of a craft's motion, as messages.
struct CraftMotion {
  hovercraft_sim::State state;
  std::optional<hovercraft_sim::State> before;  // of the same episode
  std::optional<hovercraft::Vector3> wind;      // m/s, in W, gusts included; none: not known
};

/// The force that a craft's drag exerts, its other laws included, N, in W. @param wind m/s, in W.
HOVERCRAFT_PUBLIC hovercraft::Vector3 dragOf(const hovercraft::VehicleScenario& craft,
                                             const hovercraft::Vector3& wind,
                                             const hovercraft_sim::State& state);

/// The mean of all forces on a craft between two states, N, in W: the change of its momentum over
/// the time. Nothing where there is no state before.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<hovercraft::Vector3> resultantOf(
    const CraftMotion& motion);

/// Arrows 0.3 m above the centre of mass: `NAME/drag`, `NAME/resultant`, as long as those of
/// thrusts: 0.8 m for the greatest thrust of an engine (of a craft without, for its mass times 1
/// m/s²), at most 4 m. `NAME/wind`: 0.2 m for 1 m/s, with its speed as text. What is 0 is deleted.
/// @param steady_wind m/s, in W, where that of the motion is not known.
HOVERCRAFT_PUBLIC std::vector<visualization_msgs::Marker> forceMarkers(
    const hovercraft::VehicleScenario& craft, const hovercraft::Vector3& steady_wind,
    const CraftMotion& motion);

/// `contacts`: 0.3 m above each contact an arrow along the impulse on b, 0.3 m for 1 N s (0.1 to 2
/// m), with its size as text. They go by themselves after kContactShown.
/// @param id of the contact; every one has markers of its own.
HOVERCRAFT_PUBLIC std::vector<visualization_msgs::Marker> contactMarkers(
    const hovercraft_sim::Contact& contact, int id);
constexpr double kContactShown = 1.0;  // s

/// `nearest`: the closest points of the nearest pair, the line between them, names and distance.
/// Without a pair they are deleted.
HOVERCRAFT_PUBLIC std::vector<visualization_msgs::Marker> nearestMarkers(
    const std::optional<hovercraft::NearestPair>& pair, const std::string& world_frame);

}  // namespace hovercraft_ros
