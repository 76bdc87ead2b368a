#pragma once

#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"

namespace hovercraft {

/// What is said where the motion of a body is not finite after the step from a tick.
/// @param body its key, such as vehicles.NAME. @param step s.
HOVERCRAFT_PUBLIC std::string divergenceText(const std::string& body, Tick tick, double step);

}  // namespace hovercraft
