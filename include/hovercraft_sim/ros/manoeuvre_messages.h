#pragma once

#include <hovercraft_sim/Manoeuvre.h>
#include <ros/time.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/pilot/pilot.h"

namespace hovercraft_ros {

/// Topic of a craft's flown manoeuvres, relative to its namespace.
constexpr const char* kManoeuvresTopic = "manoeuvres";

/// @param stamp of the state at the end of the manoeuvre.
HOVERCRAFT_PUBLIC hovercraft_sim::Manoeuvre toMessage(const hovercraft::FlownManoeuvre& flown,
                                                      const ros::Time& stamp);

}  // namespace hovercraft_ros
