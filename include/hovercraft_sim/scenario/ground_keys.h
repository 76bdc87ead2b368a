#pragma once

#include <type_traits>

#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/scenario/key_table.h"

/// The keys of the ground (key_table.h).

namespace hovercraft {

/// Of a GroundSpring.
inline constexpr auto kGroundSpringKeys = [](auto& spring, auto&& visit) {
  visit(optional(NumberKey("damping", "s/m", kNotNegative)), spring.damping);
  visit(optional(NumberKey("friction", "", kNotNegative)), spring.friction);
  visit(optional(NumberKey("slip_speed", "m/s", kPositive)), spring.slip_speed);
};

/// Of PadParameters.
inline constexpr auto kPadKeys = [](auto& pads, auto&& visit) {
  visit(optional(LengthKey("sink", "m")), pads.sink);
  kGroundSpringKeys(pads.spring, visit);
};

/// Of a PlaneScenario.
inline constexpr auto kPlaneKeys = [](auto& plane, auto&& visit) {
  visit(optional(NumberKey("height", "m", kCoordinate)), plane.height);
  visit(optional(VectorKey("normal", "")), plane.normal);
};

/// x, y and yaw of a lower left corner, as in the YAML of map_server.
struct OriginKey : ThreeNumbersKey {
  explicit OriginKey(const char* its_name) : ThreeNumbersKey(its_name, "m", kCoordinate) {}
  void read(const ConfigReader& reader, const char* full_name, Vector3& value) const {
    value = reader.vector(full_name, rule);
    if (value.z() == 0.0) return;
    reader.fail(full_name, "must have yaw 0: a height map lies along x and y");
  }
};

/// Of a HeightMapScenario, besides its image.
inline constexpr auto kHeightMapKeys = [](auto& map, auto&& visit) {
  visit(LengthKey("resolution", "m"), map.resolution);
  Vector3 origin(map.x, map.y, 0.0);
  visit(optional(OriginKey("origin")), origin);
  if constexpr (!std::is_const_v<std::remove_reference_t<decltype(map)>>) {
    map.x = origin.x();
    map.y = origin.y();
  }
  visit(NumberKey("z_min", "m", kCoordinate), map.z_min);
  visit(NumberKey("z_max", "m", kCoordinate), map.z_max);
};

}  // namespace hovercraft
