#pragma once

#include <cstdint>

#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/scenario/ground_keys.h"
#include "hovercraft_sim/scenario/key_table.h"

/// The keys of a cushion (key_table.h).

namespace hovercraft {

inline constexpr NumberRule kDischarge = {[](double x) { return x > 0.0 && x <= 1.0; },
                                          "must be greater than 0 and at most 1"};

/// Of CushionParameters alone, besides fans, cells and skirt.
inline constexpr auto kCushionKeys = [](auto& cushion, auto&& visit) {
  visit(optional(NumberKey("discharge", "", kDischarge)), cushion.discharge);
  visit(optional(LengthKey("residual_gap", "m")), cushion.residual_gap);
  visit(optional(NumberKey("air_density", "kg/m³", kPositive)), cushion.air_density);
};

/// Of a CushionFan, besides its speed.
inline constexpr auto kCushionFanKeys = [](auto& fan, auto&& visit) {
  visit(NumberKey("shutoff", "Pa", kPositive), fan.curve.shutoff);
  visit(optional(NumberKey("slope", "Pa s/m³", kNotPositive)), fan.curve.slope);
  visit(optional(NumberKey("curve", "Pa s²/m⁶", kNotNegative)), fan.curve.curve);
  visit(optional(VectorKey("intake", "m", kCoordinate)), fan.p_HI);
};

/// Of a FanSpeedPoint.
inline constexpr auto kFanSpeedKeys = [](auto& point, auto&& visit) {
  visit(NumberKey("time", "s", kNotNegative), point.time);
  visit(NumberKey("speed", "", kNotNegative), point.speed);
};

/// Of a CushionCell, besides its fan and its hem.
inline constexpr auto kCellKeys = [](auto& cell, auto&& visit) {
  visit(VectorKey("center", "m", kCoordinate), cell.p_HC);
  visit(LengthKey("area", "m²"), cell.area);
  visit(LengthKey("height", "m"), cell.height);
};

/// Of a HemPoint.
inline constexpr auto kHemKeys = [](auto& point, auto&& visit) {
  visit(VectorKey("p", "m", kCoordinate), point.p_HK);
  visit(LengthKey("length", "m"), point.length);
};

/// A rectangle with its hem around it, to be divided into equal cells. It is written as those.
struct CellRectangle {
  double length = 0.0;                 // m, along x
  double width = 0.0;                  // m, along y
  std::int64_t columns = 1;            // of cells, along x
  std::int64_t rows = 1;               // of cells, along y
  std::int64_t points = 1;             // of hem, on each side of a cell
  Vector3 position = Vector3::Zero();  // m, of its middle, in H
  double height = 0.0;                 // m, of each cell
};
/// Of a CellRectangle, besides the fan.
inline constexpr auto kRectangleKeys = [](auto& rectangle, auto&& visit) {
  visit(LengthKey("length", "m"), rectangle.length);
  visit(LengthKey("width", "m"), rectangle.width);
  visit(optional(WholeNumberKey("columns", "")), rectangle.columns);
  visit(optional(WholeNumberKey("rows", "")), rectangle.rows);
  visit(optional(WholeNumberKey("points_per_side", "")), rectangle.points);
  visit(optional(VectorKey("position", "m", kCoordinate)), rectangle.position);
  visit(LengthKey("height", "m"), rectangle.height);
};

/// Of a Skirt.
inline constexpr auto kSkirtKeys = [](auto& skirt, auto&& visit) {
  visit(optional(NumberKey("stiffness", "N/m²", kNotNegative)), skirt.stiffness);
  kGroundSpringKeys(skirt.spring, visit);
};

}  // namespace hovercraft
