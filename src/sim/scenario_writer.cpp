#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <sstream>
#include <string>
#include <variant>

#include "hovercraft_sim/sim/mesh_parser.h"
#include "hovercraft_sim/sim/scenario_names.h"
#include "hovercraft_sim/sim/scenario_parser.h"
#include "hovercraft_sim/sim/world_parser.h"

namespace hovercraft {
namespace {

std::string text(double number) {
  return fmt::format("{:.17g}", number);
}

std::string text(const Vector3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}

struct ShapeWriter {
  std::string operator()(const BoxShape& box) const {
    return "box: {size: " + text(box.size) + "}";
  }
  std::string operator()(const SphereShape& sphere) const {
    return "sphere: {radius: " + text(sphere.radius) + "}";
  }
  std::string operator()(const CylinderShape& cylinder) const {
    return "cylinder: {radius: " + text(cylinder.radius) + ", length: " + text(cylinder.length) +
           "}";
  }
  std::string operator()(const ConeShape& cone) const {
    return "cone: {radius: " + text(cone.radius) + ", length: " + text(cone.length) + "}";
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
    const Matrix3& I = vehicle.mass_properties.I_BBo_B;
    return fmt::format(
        "    mass: {:.17g}\n    center_of_mass: {}\n    inertia: {{ixx: {:.17g}, iyy: {:.17g}, "
        "izz: {:.17g}, ixy: {:.17g}, ixz: {:.17g}, iyz: {:.17g}}}\n",
        vehicle.mass_properties.mass, text(vehicle.mass_properties.p_HB), I(0, 0), I(1, 1), I(2, 2),
        I(0, 1), I(0, 2), I(1, 2));
  }
  std::string parts = "    parts:\n";
  for (const PartScenario& part : vehicle.parts) {
    parts += fmt::format("      - {{{}, mass: {:.17g}, position: {}, rpy: {}}}\n",
                         std::visit(ShapeWriter(), part.shape), part.mass, text(part.p_HP),
                         text(part.rpy));
  }
  return parts;
}

std::string engineText(const VehicleScenario& vehicle) {
  std::string yaml = "    engines:\n";
  for (std::size_t i = 0; i < kEngineNames.size(); ++i) {
    const EngineParameters& engine = vehicle.engines[i];
    yaml += fmt::format(
        "      {}: {{position: {}, direction: {}, min_thrust: {:.17g}, max_thrust: {:.17g}, "
        "time_constant: {:.17g}, timeout: {:.17g}}}\n",
        kEngineNames[i], text(engine.p_HE), text(engine.direction), engine.min_thrust,
        engine.max_thrust, engine.time_constant, toSeconds(engine.timeout_ns));
  }
  return yaml;
}

/// A craft, or a loose body, which has no engines to write.
std::string vehicleText(const VehicleScenario& vehicle, const Scenario& scenario,
                        bool has_engines) {
  std::string yaml = fmt::format("  {}:\n{}", vehicle.name, massText(vehicle));
  if (has_engines) yaml += engineText(vehicle);
  yaml += surfaceYaml(vehicle, scenario);
  if (vehicle.visual) yaml += "    " + visualText(*vehicle.visual) + "\n";
  yaml += fmt::format(
      "    drag: {{linear: {}, quadratic: {}, angular_linear: {}, angular_quadratic: {}}}\n",
      text(vehicle.drag.linear), text(vehicle.drag.quadratic), text(vehicle.drag.angular_linear),
      text(vehicle.drag.angular_quadratic));
  yaml +=
      fmt::format("    initial: {{position: {}, rpy: {}, velocity: {}, angular_velocity: {}}}\n",
                  text(vehicle.initial_p_WB), text(vehicle.initial_rpy), text(vehicle.initial_v_WB),
                  text(vehicle.initial_w_WB));
  return yaml;
}

}  // namespace

std::string toYaml(const Scenario& scenario) {
  std::string yaml = fmt::format(
      "step_size: {:.17g}\nintegrator: {}\norientation: {}\nmodel: {}\ngravity: {}\nwind: {}\n"
      "seed: {}\nvehicles:\n",
      scenario.stepSize(), kIntegratorNames[static_cast<std::size_t>(scenario.integrator)],
      kOrientationNames[static_cast<std::size_t>(scenario.orientation)],
      kModelNames[static_cast<std::size_t>(scenario.model)], text(scenario.gravity),
      text(scenario.wind), scenario.seed);
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    yaml += vehicleText(vehicle, scenario, true);
  }
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
