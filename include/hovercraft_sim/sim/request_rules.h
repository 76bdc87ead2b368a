#pragma once

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

/// What a request may ask of a craft while a run goes on: of the node's services and of Python
/// alike. A replay does not ask: it flies what was recorded.

namespace hovercraft {

/// Bound on the speed (m/s) and on the rate (rad/s) that a craft is set to, by component: the same
/// as of the wind (kFastestWind).
constexpr double kFastestSet = 1e6;

/// Bound on a force (N) and a torque (N m) that is applied, by component: far
/// beyond any engine.
constexpr double kStrongestApplied = 1e11;

/// What the two vectors of a request are called in errors.
struct RequestNames {
  const char* linear;
  const char* angular;
};

/// @throws std::invalid_argument with name and rule unless a craft may be set to move so.
HOVERCRAFT_PUBLIC void requireSettable(const Twist& twist, const RequestNames& names);

/// @throws std::invalid_argument with name and rule unless such a wrench may be applied: what the
/// planar model holds still cannot be pushed.
HOVERCRAFT_PUBLIC void requireApplicable(const Wrench& wrench, BodyModel model,
                                         const RequestNames& names);

}  // namespace hovercraft
