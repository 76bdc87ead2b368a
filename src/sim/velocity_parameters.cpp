#include "hovercraft_sim/sim/velocity_parameters.h"

#include <algorithm>
#include <fmt/format.h>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/sim/yaml_text.h"

namespace hovercraft {
namespace {

/// Surge, sway and yaw of a law by axes of B.
Vector3 planarPart(const Vector3& linear, const Vector3& angular) {
  return {linear.x(), linear.y(), angular.z()};
}

VelocityPlant::Actuator parsePlantActuator(const std::string& name, const ConfigReader& reader) {
  reader.allowOnly({"x", "y", "direction_x", "direction_y", "min_thrust", "max_thrust"});
  VelocityPlant::Actuator actuator;
  actuator.name = name;
  actuator.x = reader.number("x", kCoordinate);
  actuator.y = reader.number("y", kCoordinate);
  actuator.direction_x = reader.number("direction_x", kCoordinate);
  actuator.direction_y = reader.number("direction_y", kCoordinate);
  actuator.min_thrust = reader.number("min_thrust", kNotPositive);
  actuator.max_thrust = reader.number("max_thrust", kNotNegative);
  return actuator;
}

}  // namespace

VelocityParameters velocityParametersOf(const VehicleScenario& vehicle) {
  const FloatingPointEnvironment environment;
  const MassProperties& body = vehicle.mass_properties;
  VelocityParameters parameters;
  VelocityPlant& plant = parameters.plant;
  plant.mass = body.mass;
  plant.yaw_inertia = body.I_BBo_B(2, 2);
  plant.center_x = body.p_HB.x();
  plant.center_y = body.p_HB.y();
  plant.linear_drag = planarPart(vehicle.drag.linear, vehicle.drag.angular_linear);
  plant.quadratic_drag = planarPart(vehicle.drag.quadratic, vehicle.drag.angular_quadratic);
  double lag = 0.0;
  for (std::size_t i = 0; i < vehicle.engines.size(); ++i) {
    const EngineParameters& engine = vehicle.engines[i];
    const Vector3 arm = engine.p_HE - body.p_HB;
    plant.actuators.push_back({kEngineNames[i], arm.x(), arm.y(), engine.direction.x(),
                               engine.direction.y(), engine.min_thrust, engine.max_thrust});
    lag = std::max(lag, engine.time_constant);
  }
  parameters.gains = velocityGainsOf(plant, lag);
  return parameters;
}

std::string velocityYaml(const VelocityParameters& parameters, const std::string& origin) {
  const VelocityPlant& plant = parameters.plant;
  std::string yaml = fmt::format(
      "# Made by `velocity_gains {}`; SI units. Three numbers are of surge, sway and yaw.\n"
      "mass: {}\nyaw_inertia: {}\ncenter_x: {}\ncenter_y: {}\nlinear_drag: {}\n"
      "quadratic_drag: {}\nactuators:\n",
      origin, yamlNumber(plant.mass), yamlNumber(plant.yaw_inertia), yamlNumber(plant.center_x),
      yamlNumber(plant.center_y), yamlVector(plant.linear_drag), yamlVector(plant.quadratic_drag));
  for (const VelocityPlant::Actuator& actuator : plant.actuators) {
    yaml += fmt::format(
        "  {}: {{x: {}, y: {}, direction_x: {}, direction_y: {}, min_thrust: {}, max_thrust: "
        "{}}}\n",
        actuator.name, yamlNumber(actuator.x), yamlNumber(actuator.y),
        yamlNumber(actuator.direction_x), yamlNumber(actuator.direction_y),
        yamlNumber(actuator.min_thrust), yamlNumber(actuator.max_thrust));
  }
  return yaml + fmt::format("response_time: {}\nproportional: {}\nintegral: {}\n",
                            yamlVector(parameters.gains.response_time),
                            yamlVector(parameters.gains.proportional),
                            yamlVector(parameters.gains.integral));
}

VelocityParameters parseVelocityParameters(const ConfigReader& reader) {
  const FloatingPointEnvironment environment;
  reader.allowOnly({"mass", "yaw_inertia", "center_x", "center_y", "linear_drag", "quadratic_drag",
                    "actuators", "response_time", "proportional", "integral"});
  VelocityParameters parameters;
  VelocityPlant& plant = parameters.plant;
  plant.mass = reader.number("mass", kPositive);
  plant.yaw_inertia = reader.number("yaw_inertia", kPositive);
  plant.center_x = reader.numberOr(0.0, "center_x", kCoordinate);
  plant.center_y = reader.numberOr(0.0, "center_y", kCoordinate);
  plant.linear_drag = reader.vectorOr(Vector3::Zero(), "linear_drag", kNotNegative);
  plant.quadratic_drag = reader.vectorOr(Vector3::Zero(), "quadratic_drag", kNotNegative);
  const ConfigReader actuators = reader.map("actuators");
  for (const char* name : kEngineNames) {
    plant.actuators.push_back(parsePlantActuator(name, actuators.map(name)));
  }
  actuators.allowOnly(std::vector<std::string>(kEngineNames.begin(), kEngineNames.end()));
  parameters.gains.response_time = reader.vector("response_time", kPositive);
  parameters.gains.proportional = reader.vector("proportional", kNotNegative);
  parameters.gains.integral = reader.vector("integral", kNotNegative);
  return parameters;
}

}  // namespace hovercraft
