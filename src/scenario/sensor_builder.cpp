#include "hovercraft_sim/scenario/sensor_builder.h"

#include <algorithm>
#include <utility>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft {

std::vector<RayTarget> rayTargetsOf(const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  std::vector<RayTarget> targets;
  if (!scenario.world) return targets;
  const World world = worldOf(scenario);
  std::int32_t index = 0;
  for (const WorldBody& body : world.scene().bodies()) {
    if (body.hull) targets.emplace_back(*body.hull, index);
    ++index;
  }
  for (const WorldObstacle& obstacle : world.scene().obstacles()) {
    targets.emplace_back(obstacle.hull, RayTarget::kFixed, obstacle.X_WO);
  }
  return targets;
}

namespace {

struct GroundMaker {
  RayGround operator()(const PlaneScenario& plane) const {
    return RayGround(GroundPlane{plane.normal, plane.normal.z() * plane.height});
  }
  RayGround operator()(const HeightMapScenario& map) const { return RayGround(map.surface); }
};

std::optional<RayGround> rayGroundOf(const Scenario& scenario) {
  if (!scenario.ground) return std::nullopt;
  return std::visit(GroundMaker(), scenario.ground->surface);
}

}  // namespace

std::optional<SensorSuite> sensorSuiteOf(const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  std::vector<SensorCarrier> carriers;
  bool any = false;
  bool any_laser = false;
  for (const VehicleScenario& vehicle : scenario.vehicles) {
    carriers.push_back({vehicle.name, modelOf(scenario, vehicle).mobility,
                        vehicle.mass_properties.p_HB, vehicle.sensors});
    for (const SensorParameters& sensor : vehicle.sensors) {
      any = true;
      any_laser = any_laser || sensor.kind() == SensorKind::kLaser;
    }
  }
  if (!any) return std::nullopt;
  SensorSurroundings surroundings;
  if (any_laser) surroundings = {rayTargetsOf(scenario), rayGroundOf(scenario)};
  return SensorSuite(std::move(carriers), std::move(surroundings), scenario.step_ns);
}

}  // namespace hovercraft
