#include "hovercraft_sim/sim/nearest_pair.h"

#include <algorithm>
#include <utility>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/sim/world_builder.h"

namespace hovercraft {
NearestPairFinder::NearestPairFinder(const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  if (!scenario.world) return;
  const auto move = [this](const VehicleScenario& body) {
    moving_.push_back(body.name);
    add(body.name, hullOf(body), body.mass_properties.p_HB);
  };
  for (const VehicleScenario& craft : scenario.vehicles) move(craft);
  for (const VehicleScenario& body : scenario.world->bodies) move(body);
  for (const ObstacleScenario& obstacle : scenario.world->obstacles) {
    add(obstacle.name, convexHull(hullPoints(obstacle.hull), obstacle.name), Vector3::Zero());
  }
  pairs_.resize(moving_.size() * solids_.size());
}

void NearestPairFinder::add(const std::string& name, ConvexPolyhedron hull, const Vector3& p_HB) {
  Solid solid = {name, std::move(hull), p_HB};
  const int count = solid.hull.vertexCount();
  for (int i = 0; i < count; ++i) solid.center += (1.0 / count) * solid.hull.vertex(i);
  for (int i = 0; i < count; ++i) {
    solid.radius = std::max(solid.radius, norm(solid.hull.vertex(i) - solid.center));
  }
  solids_.push_back(std::move(solid));
}

std::optional<NearestPair> NearestPairFinder::find(const std::vector<std::optional<Pose>>& X_WH) {
  const FloatingPointEnvironment environment;
  const auto pose_of = [&](std::size_t i) -> std::optional<Pose> {
    if (i >= moving_.size()) return Pose();
    if (i >= X_WH.size() || !X_WH[i]) return std::nullopt;
    return Pose{X_WH[i]->R_AB, transform(*X_WH[i], solids_[i].p_HB)};
  };
  std::optional<NearestPair> nearest;
  for (std::size_t a = 0; a < moving_.size(); ++a) {
    const auto X_WA = pose_of(a);
    for (std::size_t b = a + 1; X_WA && b < solids_.size(); ++b) {
      const auto X_WB = pose_of(b);
      if (!X_WB) continue;
      const double gap =
          norm(transform(*X_WA, solids_[a].center) - transform(*X_WB, solids_[b].center)) -
          solids_[a].radius - solids_[b].radius;
      if (nearest && gap > nearest->distance) continue;
      const ClosestFeatures closest = closestFeatures(solids_[a].hull, *X_WA, solids_[b].hull,
                                                      *X_WB, pairs_[a * solids_.size() + b]);
      if (closest.status == Proximity::kStepLimit) continue;
      if (nearest && closest.distance >= nearest->distance) continue;
      nearest = {solids_[a].name, solids_[b].name, closest.distance, closest.p_WCa, closest.p_WCb};
    }
  }
  return nearest;
}

}  // namespace hovercraft
