#include "hovercraft_sim/scenario/velocity_parameters.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <stdexcept>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/command_parser.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

/// Surge, sway and yaw of a law by axes of B.
Vector3 planarPart(const Vector3& linear, const Vector3& angular) {
  return {linear.x(), linear.y(), angular.z()};
}

const std::vector<std::string>& plantKindNames() {
  static const std::vector<std::string> names = {"thrust", "propeller", "rudder"};
  return names;
}

/// The keys of the limits of a level, by PlantActuator::Kind.
constexpr std::array<std::array<const char*, 2>, 3> kLimits = {
    {{"min_thrust", "max_thrust"}, {"min_speed", "max_speed"}, {"min_angle", "max_angle"}}};

void parsePropellerOfPlant(const ConfigReader& reader, PlantActuator& propeller) {
  reader.allowOnly({"kind", "x", "y", "direction_x", "direction_y", "min_speed", "max_speed",
                    "air_density", "diameter", "thrust_coefficients", "command"});
  propeller.air_density = reader.number("air_density", kPositive);
  propeller.diameter = reader.length("diameter");
  propeller.thrust_coefficients = reader.vector("thrust_coefficients");
  if (!(propeller.thrust_coefficients[0] > 0.0)) {
    reader.fail("thrust_coefficients", "the first one must be greater than 0");
  }
}

void parseRudderOfPlant(const ConfigReader& reader, PlantActuator& rudder) {
  reader.allowOnly({"kind", "x", "y", "direction_x", "direction_y", "across_x", "across_y",
                    "min_angle", "max_angle", "air_density", "area", "lift_slope", "fan",
                    "disc_diameter", "command"});
  rudder.across_x = reader.number("across_x", kCoordinate);
  rudder.across_y = reader.number("across_y", kCoordinate);
  rudder.air_density = reader.number("air_density", kPositive);
  rudder.area = reader.number("area", kPositive);
  rudder.lift_slope = reader.number("lift_slope", kNotNegative);
  if (!reader.has("fan")) return;
  rudder.fan = reader.text("fan");
  rudder.diameter = reader.length("disc_diameter");
}

PlantActuator parsePlantActuator(const std::string& name, const ConfigReader& reader) {
  PlantActuator actuator;
  actuator.name = name;
  actuator.kind = static_cast<PlantActuator::Kind>(reader.choiceOr(0, "kind", plantKindNames()));
  if (actuator.kind == PlantActuator::Kind::kPropeller) {
    parsePropellerOfPlant(reader, actuator);
  } else if (actuator.kind == PlantActuator::Kind::kRudder) {
    parseRudderOfPlant(reader, actuator);
  } else {
    reader.allowOnly({"kind", "x", "y", "direction_x", "direction_y", "min_thrust", "max_thrust",
                      "free_speed", "command", "thrust_table"});
    actuator.free_speed = reader.numberOr(0.0, "free_speed", kNotNegative);
  }
  actuator.x = reader.number("x", kCoordinate);
  actuator.y = reader.number("y", kCoordinate);
  actuator.direction_x = reader.number("direction_x", kCoordinate);
  actuator.direction_y = reader.number("direction_y", kCoordinate);
  const auto& limits = kLimits[static_cast<std::size_t>(actuator.kind)];
  actuator.min_thrust = reader.number(limits[0], kNotPositive);
  actuator.max_thrust = reader.number(limits[1], kNotNegative);
  return actuator;
}

/// What the plant knows of one; none of what does not push.
std::optional<PlantActuator> plantActuatorOf(const ActuatorScenario& actuator,
                                             const VehicleScenario& vehicle) {
  if (traitsOf(actuator.kind).push == ActuatorPush::kNone) return std::nullopt;
  const Vector3 arm = actuator.motion.p_HE - vehicle.mass_properties.p_HB;
  const Vector3& direction = actuator.motion.direction;
  PlantActuator known;
  known.name = actuator.name;
  known.x = arm.x();
  known.y = arm.y();
  known.direction_x = direction.x();
  known.direction_y = direction.y();
  known.min_thrust = actuator.motion.min_thrust;
  known.max_thrust = actuator.motion.max_thrust;
  known.free_speed = actuator.free_speed;
  known.air_density = actuator.air_density;
  known.diameter = actuator.diameter;
  if (actuator.kind == ActuatorKind::kPropeller) {
    known.kind = PlantActuator::Kind::kPropeller;
    known.thrust_coefficients = actuator.thrust_coefficients;
    if (!(actuator.thrust_coefficients[0] > 0.0)) {
      throw std::invalid_argument(
          fmt::format("vehicles.{}.actuators.{}.thrust_coefficients: the first one must be greater "
                      "than 0: the velocity controller cannot tell which speed makes a thrust",
                      vehicle.name, actuator.name));
    }
  }
  if (actuator.kind == ActuatorKind::kRudder) {
    const Vector3 across = cross(actuator.hinge, direction);
    known.kind = PlantActuator::Kind::kRudder;
    known.across_x = across.x();
    known.across_y = across.y();
    known.area = actuator.area;
    known.lift_slope = actuator.lift_slope;
    known.fan = actuator.fan;
  }
  return known;
}

PlantActuator plantEngineOf(std::size_t id, const VehicleScenario& vehicle) {
  const EngineParameters& engine = vehicle.engines[id];
  const Vector3 arm = engine.p_HE - vehicle.mass_properties.p_HB;
  PlantActuator known;
  known.name = kEngineNames[id];
  known.x = arm.x();
  known.y = arm.y();
  known.direction_x = engine.direction.x();
  known.direction_y = engine.direction.y();
  known.min_thrust = engine.min_thrust;
  known.max_thrust = engine.max_thrust;
  return known;
}

/// Its fan is there.
void checkFans(const ConfigReader& actuators, const VelocityPlant& plant) {
  for (const PlantActuator& rudder : plant.actuators) {
    if (rudder.fan.empty()) continue;
    const bool is_there =
        std::any_of(plant.actuators.begin(), plant.actuators.end(), [&](const PlantActuator& fan) {
          return fan.name == rudder.fan && fan.kind != PlantActuator::Kind::kRudder;
        });
    if (!is_there) actuators.map(rudder.name).fail("fan", "must be another actuator, no rudder");
  }
}

/// The word for a command that is the level itself.
constexpr const char* kLevelWord = "level";

std::string plantActuatorText(const PlantActuator& a, const CommandMap& command) {
  const auto& limits = kLimits[static_cast<std::size_t>(a.kind)];
  std::string text = fmt::format(
      "  {}: {{{}x: {}, y: {}, direction_x: {}, direction_y: {}, {}: {}, {}: {}", a.name,
      a.kind == PlantActuator::Kind::kThrust
          ? ""
          : fmt::format("kind: {}, ", plantKindNames()[static_cast<std::size_t>(a.kind)]),
      yamlNumber(a.x), yamlNumber(a.y), yamlNumber(a.direction_x), yamlNumber(a.direction_y),
      limits[0], yamlNumber(a.min_thrust), limits[1], yamlNumber(a.max_thrust));
  if (a.free_speed > 0.0) text += ", free_speed: " + yamlNumber(a.free_speed);
  if (a.kind == PlantActuator::Kind::kPropeller) {
    text += fmt::format(", air_density: {}, diameter: {}, thrust_coefficients: {}",
                        yamlNumber(a.air_density), yamlNumber(a.diameter),
                        yamlVector(a.thrust_coefficients));
  }
  if (a.kind == PlantActuator::Kind::kRudder) {
    text += fmt::format(", across_x: {}, across_y: {}, air_density: {}, area: {}, lift_slope: {}",
                        yamlNumber(a.across_x), yamlNumber(a.across_y), yamlNumber(a.air_density),
                        yamlNumber(a.area), yamlNumber(a.lift_slope));
    if (!a.fan.empty()) {
      text += fmt::format(", fan: {}, disc_diameter: {}", yamlText(a.fan), yamlNumber(a.diameter));
    }
  }
  if (!command.isPlain()) text += commandMapYaml(command, kLevelWord);
  return text + "}\n";
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
  for (const DragLaw& law : vehicle.drag_laws) plant.quadratic_drag += quadraticDrag(law);
  double lag = 0.0;
  for (std::size_t i = 0; i < vehicle.engines.size(); ++i) {
    if (!vehicle.has_engine[i]) continue;
    plant.actuators.push_back(plantEngineOf(i, vehicle));
    parameters.commands.push_back(vehicle.engines[i].command);
    lag = std::max(lag, vehicle.engines[i].time_constant);
  }
  for (const ActuatorScenario& actuator : vehicle.actuators) {
    const auto known = plantActuatorOf(actuator, vehicle);
    if (!known) continue;
    plant.actuators.push_back(*known);
    parameters.commands.push_back(actuator.motion.command);
    lag = std::max(lag, actuator.motion.time_constant);
  }
  if (plant.actuators.empty()) {
    throw std::invalid_argument(
        fmt::format("vehicles.{}: the velocity controller needs an engine, a fan, a propeller or a "
                    "rudder",
                    vehicle.name));
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
  for (std::size_t i = 0; i < plant.actuators.size(); ++i) {
    yaml += plantActuatorText(plant.actuators[i], parameters.commands[i]);
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
  const auto add = [&](const std::string& name, const ConfigReader& actuator) {
    plant.actuators.push_back(parsePlantActuator(name, actuator));
    const bool has_thrust = plant.actuators.back().kind == PlantActuator::Kind::kThrust;
    parameters.commands.push_back(parseCommandMap(actuator, kLevelWord, has_thrust));
  };
  for (const char* name : kEngineNames) {
    if (actuators.has(name)) add(name, actuators.map(name));
  }
  for (const auto& [name, actuator] : actuators.maps()) {
    if (std::find(kEngineNames.begin(), kEngineNames.end(), name) != kEngineNames.end()) continue;
    add(name, actuator);
  }
  if (plant.actuators.empty() || plant.actuators.size() > kMostActuators) {
    reader.fail("actuators", fmt::format("must be 1 to {}", kMostActuators));
  }
  checkFans(actuators, plant);
  parameters.gains.response_time = reader.vector("response_time", kPositive);
  parameters.gains.proportional = reader.vector("proportional", kNotNegative);
  parameters.gains.integral = reader.vector("integral", kNotNegative);
  return parameters;
}

}  // namespace hovercraft
