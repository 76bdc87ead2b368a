#pragma once

#include "hovercraft_sim/cushion/ground.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// 15 °C at sea level, kg/m³.
constexpr double kStandardAirDensity = 1.225;

/// What surrounds a body during a step.
struct Environment {
  Vector3 wind_W = Vector3::Zero();     // velocity of the air, m/s
  const Ground* ground = nullptr;       // what cushions blow on; none; must outlive the step
  const Ground* bare_ground = nullptr;  // of it what is no polyhedron, for pads; likewise
};

}  // namespace hovercraft
