#pragma once

#include <array>

#include "hovercraft_sim/hovercraft/engines.h"

namespace hovercraft::testing {

using Engines = std::array<EngineParameters, kEngineCount>;

/// Three engines at general places off the centre of mass, which also push up and sideways.
inline Engines skewEngines() {
  Engines engines;
  engines[0].p_HE = {-0.25, 0.02, 0.05};
  engines[0].direction = {1.0, 0.0, 0.0};
  engines[1].p_HE = {0.2, 0.15, -0.03};
  engines[1].direction = {0.0, -0.6, 0.8};
  engines[2].p_HE = {0.21, -0.16, 0.04};
  engines[2].direction = {0.48, 0.64, -0.6};
  for (EngineParameters& engine : engines) engine.max_thrust = 5.0;
  return engines;
}

}  // namespace hovercraft::testing
