#pragma once

#include <optional>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sensors/sensor_suite.h"

namespace hovercraft {

/// The sensors of a scenario; none if no craft has any.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<SensorSuite> sensorSuiteOf(const Scenario& scenario);

/// What lasers see: of a scenario with a world the hulls of craft and loose bodies, and the
/// obstacles.
HOVERCRAFT_PUBLIC std::vector<RayTarget> rayTargetsOf(const Scenario& scenario);

}  // namespace hovercraft
