#pragma once

#include <cstdint>
#include <optional>

#include <hovercraft_sim/Manoeuvre.h>
#include <hovercraft_sim/State.h>
#include <ros/time.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/pilot/pilot.h"
#include "hovercraft_sim/sim/craft_pilot.h"

namespace hovercraft_ros {

/// Topic of a craft's flown manoeuvres, relative to its namespace.
constexpr const char* kManoeuvresTopic = "manoeuvres";

/// @param stamp of the state at the end of the manoeuvre.
HOVERCRAFT_PUBLIC hovercraft_sim::Manoeuvre toMessage(const hovercraft::FlownManoeuvre& flown,
                                                      const ros::Time& stamp);

/// What a pilot is told of a state.
/// @param step_ns of the scenario. @returns nothing if no simulation has such a state: a number is
/// not finite, the orientation no unit quaternion, or the tick beyond those that its time can have.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<hovercraft::ObservedMotion> toObservedMotion(
    const hovercraft_sim::State& state, std::int64_t step_ns);

}  // namespace hovercraft_ros
