#include "hovercraft_sim/scenario/cushion_builder.h"

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/scenario/ground_parser.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/world/roof_ground.h"

namespace hovercraft {

std::optional<Cushion> cushionOf(const VehicleScenario& vehicle) {
  const FloatingPointEnvironment environment;
  if (!vehicle.cushion) return std::nullopt;
  return Cushion(*vehicle.cushion, vehicle.mass_properties.p_HB);
}

Pads padsOf(const Scenario& scenario, const VehicleScenario& body) {
  const FloatingPointEnvironment environment;
  const bool has_hull = body.hull || !body.parts.empty();
  if (!scenario.ground || scenario.model != BodyModel::kSpatial || !has_hull) return {};
  const double weight = body.mass_properties.mass * -scenario.gravity.z();
  if (!(weight > 0.0)) return {};  // nothing stands
  return {hullOf(body).vertices(), weight, scenario.ground->pads};
}

std::shared_ptr<const GroundForces> groundForcesOf(const Scenario& scenario,
                                                   const VehicleScenario& body) {
  std::optional<Cushion> cushion = cushionOf(body);
  Pads pads = padsOf(scenario, body);
  if (!cushion && pads.empty()) return nullptr;
  std::optional<double> planar_load;
  if (scenario.model == BodyModel::kPlanar) {
    planar_load = body.mass_properties.mass * -scenario.gravity.z();
  }
  return std::make_shared<GroundForces>(std::move(cushion), std::move(pads), planar_load);
}

std::shared_ptr<const Ground> bareGroundOf(const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  return scenario.ground ? surfaceOf(*scenario.ground) : nullptr;
}

std::shared_ptr<const Ground> groundOf(const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  std::shared_ptr<const Ground> bare = bareGroundOf(scenario);
  if (!scenario.world || scenario.world->obstacles.empty()) return bare;
  auto roofs = std::make_shared<RoofGround>(std::move(bare));
  for (const WorldObstacle& obstacle : obstaclesOf(*scenario.world)) {
    roofs->add(obstacle.hull, obstacle.X_WO);
  }
  return roofs;
}

HoverBody hoverBodyOf(const Scenario& scenario, const VehicleScenario& vehicle) {
  return {vehicle.mass_properties.mass, vehicle.mass_properties.I_BBo_B, -scenario.gravity.z()};
}

}  // namespace hovercraft
