#pragma once

#include "hovercraft_sim/scenario/key_table.h"
#include "hovercraft_sim/scenario/scenario_names.h"

/// The keys of a run, and of its craft besides actuators, cushion and sensors (key_table.h).

namespace hovercraft {

/// Of a Scenario, before its gusts.
inline constexpr auto kRunKeys = [](auto& scenario, auto&& visit) {
  visit(DurationKey("step_size", kPositive), scenario.step_ns);
  visit(optional(ChoiceKey("integrator", integratorNames())), scenario.integrator);
  visit(optional(ChoiceKey("orientation", orientationNames())), scenario.orientation);
  visit(optional(ChoiceKey("model", modelNames())), scenario.model);
  visit(optional(VectorKey("gravity", "m/s²")), scenario.gravity);
  visit(optional(VectorKey("wind", "m/s")), scenario.wind);
};

/// Of a Scenario, behind its gusts.
inline constexpr auto kSeedKeys = [](auto& scenario, auto&& visit) {
  visit(optional(WholeNumberKey("seed", "")), scenario.seed);
};

/// Of a tensor, whose other half is that of a symmetric one.
inline constexpr auto kInertiaKeys = [](auto& inertia, auto&& visit) {
  visit(NumberKey("ixx", "kg m²"), inertia(0, 0));
  visit(NumberKey("iyy", "kg m²"), inertia(1, 1));
  visit(NumberKey("izz", "kg m²"), inertia(2, 2));
  visit(optional(NumberKey("ixy", "kg m²")), inertia(0, 1));
  visit(optional(NumberKey("ixz", "kg m²")), inertia(0, 2));
  visit(optional(NumberKey("iyz", "kg m²")), inertia(1, 2));
};

/// Of the initial motion of a VehicleScenario.
inline constexpr auto kInitialKeys = [](auto& vehicle, auto&& visit) {
  visit(optional(VectorKey("position", "m", kCoordinate)), vehicle.initial_p_WB);
  visit(optional(VectorKey("rpy", "rad")), vehicle.initial_rpy);
  visit(optional(VectorKey("velocity", "m/s")), vehicle.initial_v_WB);
  visit(optional(VectorKey("angular_velocity", "rad/s")), vehicle.initial_w_WB);
};

/// Of Drag.
inline constexpr auto kDragKeys = [](auto& drag, auto&& visit) {
  visit(optional(VectorKey("linear", "N s/m", kNotNegative)), drag.linear);
  visit(optional(VectorKey("quadratic", "N s²/m²", kNotNegative)), drag.quadratic);
  visit(optional(VectorKey("angular_linear", "N m s", kNotNegative)), drag.angular_linear);
  visit(optional(VectorKey("angular_quadratic", "N m s²", kNotNegative)), drag.angular_quadratic);
};

/// Of a DragPolar, besides its terms and the length of its moment.
inline constexpr auto kPolarKeys = [](auto& polar, auto&& visit) {
  visit(optional(NumberKey("air_density", "kg/m³", kPositive)), polar.air_density);
  visit(NumberKey("area_x", "m²", kNotNegative), polar.area_x);
  visit(NumberKey("area_y", "m²", kNotNegative), polar.area_y);
};

}  // namespace hovercraft
