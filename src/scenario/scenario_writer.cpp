#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <sstream>
#include <string>
#include <variant>

#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/actuator_parser.h"
#include "hovercraft_sim/scenario/air_parser.h"
#include "hovercraft_sim/scenario/craft_keys.h"
#include "hovercraft_sim/scenario/cushion_parser.h"
#include "hovercraft_sim/scenario/drag_parser.h"
#include "hovercraft_sim/scenario/ground_parser.h"
#include "hovercraft_sim/scenario/mesh_parser.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/sensor_parser.h"
#include "hovercraft_sim/scenario/version.h"
#include "hovercraft_sim/scenario/world_parser.h"

namespace hovercraft {
namespace {

struct ShapeWriter {
  std::string operator()(const BoxShape& box) const {
    return "box: {size: " + yamlVector(box.size) + "}";
  }
  std::string operator()(const SphereShape& sphere) const {
    return "sphere: {radius: " + yamlNumber(sphere.radius) + "}";
  }
  std::string operator()(const CylinderShape& cylinder) const {
    return "cylinder: {radius: " + yamlNumber(cylinder.radius) +
           ", length: " + yamlNumber(cylinder.length) + "}";
  }
  std::string operator()(const ConeShape& cone) const {
    return "cone: {radius: " + yamlNumber(cone.radius) + ", length: " + yamlNumber(cone.length) +
           "}";
  }
  /// A craft with such a part is written by numbers.
  std::string operator()(const MeshShape& /*mesh*/) const { return ""; }
};

std::string massText(const VehicleScenario& vehicle) {
  const bool by_numbers =
      vehicle.parts.empty() ||
      std::any_of(vehicle.parts.begin(), vehicle.parts.end(), [](const PartScenario& part) {
        return std::holds_alternative<MeshShape>(part.shape);
      });
  if (by_numbers) {
    return fmt::format("    mass: {}\n    center_of_mass: {}\n    inertia: {{{}}}\n",
                       yamlNumber(vehicle.mass_properties.mass),
                       yamlVector(vehicle.mass_properties.p_HB),
                       keysText(kInertiaKeys, vehicle.mass_properties.I_BBo_B));
  }
  std::string parts = "    parts:\n";
  for (const PartScenario& part : vehicle.parts) {
    parts += fmt::format("      - {{{}, mass: {}, position: {}, rpy: {}}}\n",
                         std::visit(ShapeWriter(), part.shape), yamlNumber(part.mass),
                         yamlVector(part.p_HP), yamlVector(part.rpy));
  }
  return parts;
}

/// A craft, or a loose body, which has no engines to write.
std::string vehicleText(const VehicleScenario& vehicle, const Scenario& scenario,
                        bool has_engines) {
  std::string yaml = fmt::format("  {}:\n{}", yamlText(vehicle.name), massText(vehicle));
  if (has_engines) yaml += enginesYaml(vehicle) + actuatorsYaml(vehicle) + sensorsYaml(vehicle);
  yaml += surfaceYaml(vehicle, scenario);
  yaml += cushionYaml(vehicle);
  if (vehicle.visual) yaml += "    " + visualText(*vehicle.visual) + "\n";
  yaml += dragYaml(vehicle);
  yaml += "    initial: {" + keysText(kInitialKeys, vehicle) + "}\n";
  return yaml;
}

}  // namespace

std::string toYaml(const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  std::string yaml =
      fmt::format("physics_version: {}\nsoftware: {}\n{}\n{}{}\nvehicles:\n", kPhysicsVersion,
                  yamlText(softwareText()), keysText(kRunKeys, scenario, "", "\n"),
                  gustsYaml(scenario), keysText(kSeedKeys, scenario));
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    yaml += vehicleText(vehicle, scenario, true);
  }
  yaml += groundYaml(scenario);
  yaml += worldYaml(scenario);
  if (!scenario.world || scenario.world->bodies.empty()) return yaml;
  yaml += "  bodies:\n";
  for (const VehicleScenario& body : scenario.world->bodies) {
    std::istringstream lines(vehicleText(body, scenario, false));
    for (std::string line; std::getline(lines, line);) yaml += "  " + line + "\n";
  }
  return yaml;
}

}  // namespace hovercraft
