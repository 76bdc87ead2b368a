#pragma once

#include "hovercraft_sim/scenario/key_table.h"

/// The keys of a world (key_table.h).

namespace hovercraft {

inline constexpr NumberRule kShare = {[](double x) { return x >= 0.0 && x <= 1.0; },
                                      "must be from 0 to 1"};

/// Of a ContactMaterial.
inline constexpr auto kMaterialKeys = [](auto& material, auto&& visit) {
  visit(optional(NumberKey("restitution", "", kShare)), material.restitution);
  visit(optional(NumberKey("friction", "", kNotNegative)), material.friction);
  visit(optional(FlagKey("stick")), material.stick);
};

/// Of a WorldScenario alone, besides materials, obstacles and bodies.
inline constexpr auto kWorldKeys = [](auto& world, auto&& visit) {
  visit(optional(NumberKey("tolerance", "m", kPositive)), world.tolerance);
  visit(optional(NumberKey("rest_speed", "m/s", kNotNegative)), world.rest_speed);
};

}  // namespace hovercraft
