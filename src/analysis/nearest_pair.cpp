#include "hovercraft_sim/analysis/nearest_pair.h"

#include <algorithm>
#include <utility>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/world_builder.h"

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
    for (const HullScenario& piece : piecesOf(obstacle)) {
      add(obstacle.name, convexHull(hullPoints(piece), obstacle.name), Vector3::Zero());
    }
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
  std::optional<NearestPair> nearest;
  for (std::size_t a = 0; a < moving_.size(); ++a) {
    const auto X_WA = poseOf(a, X_WH);
    for (std::size_t b = a + 1; X_WA && b < solids_.size(); ++b) {
      const auto X_WB = poseOf(b, X_WH);
      if (X_WB) compare(a, *X_WA, b, *X_WB, nearest);
    }
  }
  return nearest;
}

std::optional<double> NearestPairFinder::clearance(std::size_t a,
                                                   const std::set<std::string>& names,
                                                   const std::vector<std::optional<Pose>>& X_WH) {
  const FloatingPointEnvironment environment;
  if (a >= moving_.size()) return std::nullopt;
  std::optional<NearestPair> nearest;
  const auto X_WA = poseOf(a, X_WH);
  for (std::size_t b = 0; X_WA && b < solids_.size(); ++b) {
    if (b == a || (!names.empty() && names.count(solids_[b].name) == 0)) continue;
    const auto X_WB = poseOf(b, X_WH);
    if (X_WB) compare(a, *X_WA, b, *X_WB, nearest);
  }
  if (!nearest) return std::nullopt;
  return nearest->distance;
}

std::optional<Pose> NearestPairFinder::poseOf(std::size_t solid,
                                              const std::vector<std::optional<Pose>>& X_WH) const {
  if (solid >= moving_.size()) return Pose();
  if (solid >= X_WH.size() || !X_WH[solid]) return std::nullopt;
  return Pose{X_WH[solid]->R_AB, transform(*X_WH[solid], solids_[solid].p_HB)};
}

void NearestPairFinder::compare(std::size_t a, const Pose& X_WA, std::size_t b, const Pose& X_WB,
                                std::optional<NearestPair>& nearest) {
  const Solid& A = solids_[a];
  const Solid& B = solids_[b];
  const double apart = norm(transform(X_WA, A.center) - transform(X_WB, B.center));
  if (nearest && apart - A.radius - B.radius > nearest->distance) return;
  const ClosestFeatures closest =
      closestFeatures(A.hull, X_WA, B.hull, X_WB, pairs_[a * solids_.size() + b]);
  if (closest.status == Proximity::kStepLimit) return;
  if (nearest && closest.distance >= nearest->distance) return;
  nearest = {A.name, B.name, closest.distance, closest.p_WCa, closest.p_WCb};
}

}  // namespace hovercraft
