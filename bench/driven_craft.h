#pragma once

#include "hovercraft_sim/hovercraft/hovercraft_model.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft::bench {

/// The craft whose step is timed: three engines with lag and limits, every term of the drag, wind,
/// products of inertia; the rear engine tilted, so that the spatial model pitches. 1 kHz.
Scenario drivenCraft(Integrator integrator, OrientationKind orientation, BodyModel model);

/// Thrusts (rear, left, right; N) demanded of it; the first lies beyond its engine's limit.
Vector3 demandedThrusts();

}  // namespace hovercraft::bench
