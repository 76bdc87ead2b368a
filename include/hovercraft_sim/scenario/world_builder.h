#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/world/world.h"

namespace hovercraft {

/// The corners of a hull in the frame that it is placed in, m.
HOVERCRAFT_PUBLIC std::vector<Vector3> hullPoints(const HullScenario& hull);

/// The convex bodies that an obstacle is made of, in W: one, or one for each straight part of a
/// wall, which have whole sides in common.
HOVERCRAFT_PUBLIC std::vector<HullScenario> piecesOf(const ObstacleScenario& obstacle);

/// The corners of all parts in H, m; balls and round solids as of HullScenario.
HOVERCRAFT_PUBLIC std::vector<Vector3> partPoints(const std::vector<PartScenario>& parts);

/// The body by which a craft meets others, in B. @throws std::invalid_argument if it is flat.
HOVERCRAFT_PUBLIC ConvexPolyhedron hullOf(const VehicleScenario& vehicle);

/// Limits, lags and time-outs of a craft's engines and its other actuators, by id.
HOVERCRAFT_PUBLIC ActuatorArray<EngineParameters> parametersOf(const VehicleScenario& vehicle);

/// Its engine "rear", or the actuator by its own name.
HOVERCRAFT_PUBLIC std::string actuatorName(const VehicleScenario& vehicle, std::size_t id);

/// Of an engine that the craft has, or of another actuator; nothing of another name.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<std::size_t> actuatorIdOf(
    const VehicleScenario& vehicle, const std::string& name);

/// What they are before the first command.
HOVERCRAFT_PUBLIC EngineStates initialActuators(const VehicleScenario& vehicle);

/// What acts on a craft or a loose body.
HOVERCRAFT_PUBLIC HovercraftModel modelOf(const Scenario& scenario, const VehicleScenario& vehicle);

/// The initial state of a craft or a loose body.
HOVERCRAFT_PUBLIC BodyState initialState(const Scenario& scenario, const VehicleScenario& vehicle,
                                         const Mobility& mobility);

/// What never moves in a world, by name.
std::vector<WorldObstacle> obstaclesOf(const WorldScenario& world);

/// The bodies of a scenario: its vehicles, then its loose bodies, both by name. Without `world:`
/// they pass through each other.
HOVERCRAFT_PUBLIC World worldOf(const Scenario& scenario);

}  // namespace hovercraft
