#include "hovercraft_sim/scenario/world_builder.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/geometry/mesh_file.h"
#include "hovercraft_sim/geometry/polyhedron_shapes.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/rotation.h"
#include "hovercraft_sim/scenario/actuator_forces.h"
#include "hovercraft_sim/scenario/cushion_builder.h"
#include "hovercraft_sim/scenario/wall.h"

namespace hovercraft {
namespace {

constexpr int kRoundSides = 24;
constexpr int kBallHalvings = 2;  // of the edges of an icosahedron: 12, 42, 162 vertices

/// The vertices of an icosahedron and, twice over, the middles of the edges, on the sphere. Two of
/// its vertices are joined if they are nearest: that is how edges are told.
std::vector<Vector3> ballPoints(double radius) {
  const double golden = 0.5 * (1.0 + std::sqrt(5.0));
  std::vector<Vector3> points;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-golden, golden}) {
      points.emplace_back(0.0, a, b);
      points.emplace_back(a, b, 0.0);
      points.emplace_back(b, 0.0, a);
    }
  }
  for (Vector3& p : points) p = p / norm(p);
  double reach = 1.2;  // longer than an edge, 1.05, shorter than the next distance, 1.70
  for (int halving = 0; halving < kBallHalvings; ++halving) {
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = i + 1; j < count; ++j) {
        if (norm(points[i] - points[j]) > reach) continue;
        const Vector3 middle = points[i] + points[j];
        points.push_back(middle / norm(middle));
      }
    }
    reach = 0.7;  // edges are 0.55 and 0.62 then, other distances 1 and more
  }
  for (Vector3& p : points) p = radius * p;
  return points;
}

struct HullCorners {
  std::vector<Vector3> operator()(const BoxShape& box) const {
    return boxPolyhedron(box.size).vertices();
  }
  std::vector<Vector3> operator()(const SphereShape& ball) const { return ballPoints(ball.radius); }
  std::vector<Vector3> operator()(const CylinderShape& cylinder) const {
    return cylinderPolyhedron(cylinder.radius, cylinder.length, kRoundSides).vertices();
  }
  std::vector<Vector3> operator()(const PointsShape& cloud) const { return cloud.points; }
  std::vector<Vector3> operator()(const ConeShape& cone) const {
    auto points = cylinderPolyhedron(cone.radius, cone.length, kRoundSides).vertices();
    points.resize(kRoundSides);  // the lower rim
    points.emplace_back(0.0, 0.0, 0.5 * cone.length);
    return points;
  }
  std::vector<Vector3> operator()(const MeshShape& mesh) const {
    return loadClosedMesh(mesh.file, mesh.scale).mesh.vertices;
  }
};

/// How the bodies of a world meet.
WorldConfig configOf(const WorldScenario& world) {
  WorldConfig config;
  config.tolerance = world.tolerance;
  config.rest_speed = world.rest_speed;
  const std::size_t count = world.materials.size();
  config.material_count = count;
  config.pairs.clear();
  for (const MaterialScenario& a : world.materials) {
    for (const MaterialScenario& b : world.materials) {
      config.pairs.push_back(combined(a.surface, b.surface));
    }
  }
  for (const MaterialPairScenario& pair : world.material_pairs) {
    config.pairs[pair.first * count + pair.second] = pair.law;
    config.pairs[pair.second * count + pair.first] = pair.law;
  }
  return config;
}

std::vector<Vector3> placedPoints(std::vector<Vector3> points, const Vector3& p,
                                  const Vector3& rpy) {
  const Matrix3 R = rotationFromRpy(rpy);
  for (Vector3& point : points) point = times(R, point) + p;
  return points;
}

}  // namespace

std::vector<Vector3> hullPoints(const HullScenario& hull) {
  const FloatingPointEnvironment environment;
  return placedPoints(std::visit(HullCorners(), hull.shape), hull.p_HS, hull.rpy);
}

std::vector<HullScenario> piecesOf(const ObstacleScenario& obstacle) {
  if (!obstacle.wall) return {obstacle.hull};
  std::vector<HullScenario> pieces;
  for (PointsShape& part : straightParts(*obstacle.wall)) {
    pieces.push_back({std::move(part), obstacle.hull.p_HS, obstacle.hull.rpy});
  }
  return pieces;
}

std::vector<Vector3> partPoints(const std::vector<PartScenario>& parts) {
  const FloatingPointEnvironment environment;
  std::vector<Vector3> all;
  for (const PartScenario& part : parts) {
    const auto points = placedPoints(std::visit(HullCorners(), part.shape), part.p_HP, part.rpy);
    all.insert(all.end(), points.begin(), points.end());
  }
  return all;
}

ConvexPolyhedron hullOf(const VehicleScenario& vehicle) {
  const FloatingPointEnvironment environment;
  std::vector<Vector3> points =
      vehicle.hull ? hullPoints(*vehicle.hull) : partPoints(vehicle.parts);
  for (Vector3& p : points) p -= vehicle.mass_properties.p_HB;
  return convexHull(points, vehicle.name + ": hull");
}

ActuatorArray<EngineParameters> parametersOf(const VehicleScenario& vehicle) {
  ActuatorArray<EngineParameters> parameters(vehicle.engines);
  for (const ActuatorScenario& actuator : vehicle.actuators) parameters.append(actuator.motion);
  return parameters;
}

std::string actuatorName(const VehicleScenario& vehicle, std::size_t id) {
  return id < kFirstActuator ? kEngineNames[id] : vehicle.actuators[id - kFirstActuator].name;
}

std::optional<std::size_t> actuatorIdOf(const VehicleScenario& vehicle, const std::string& name) {
  for (std::size_t id = 0; id < kFirstActuator + vehicle.actuators.size(); ++id) {
    const bool is_there = id >= kFirstActuator || vehicle.has_engine[id];
    if (is_there && actuatorName(vehicle, id) == name) return id;
  }
  return std::nullopt;
}

EngineStates initialActuators(const VehicleScenario& vehicle) {
  EngineStates states;
  for (const ActuatorScenario& actuator : vehicle.actuators) {
    states.append({actuator.initial, actuator.initial, EngineState::kNever});
  }
  return states;
}

HovercraftModel modelOf(const Scenario& scenario, const VehicleScenario& vehicle) {
  const FloatingPointEnvironment environment;
  const MassProperties& body = vehicle.mass_properties;
  const Mobility mobility = scenario.model == BodyModel::kPlanar
                                ? Mobility::planar(body.mass, body.I_BBo_B)
                                : Mobility::spatial(body.mass, body.I_BBo_B);
  return {mobility,
          EngineGeometry(vehicle.engines, body.p_HB),
          vehicle.drag,
          body.mass * scenario.gravity,
          groundForcesOf(scenario, vehicle),
          forcesOf(vehicle),
          rotorsOf(vehicle)};
}

BodyState initialState(const Scenario& scenario, const VehicleScenario& vehicle,
                       const Mobility& mobility) {
  const FloatingPointEnvironment environment;
  const Twist twist = {vehicle.initial_v_WB, vehicle.initial_w_WB};
  const std::vector<Rotor> rotors = rotorsOf(vehicle);
  const auto at = [&](const auto& orientation) -> BodyState {
    const Vector3& p_WB = vehicle.initial_p_WB;
    if (rotors.empty()) return mobility.stateOfMotion(p_WB, orientation, twist);
    return mobility.stateOfMotion(p_WB, orientation, twist,
                                  rotorMomentum(rotors, levelsOf(initialActuators(vehicle))));
  };
  if (scenario.orientation == OrientationKind::kQuaternion) {
    return at(quaternionFromRpy(vehicle.initial_rpy));
  }
  return at(rotationFromRpy(vehicle.initial_rpy));
}

std::vector<WorldObstacle> obstaclesOf(const WorldScenario& world) {
  const FloatingPointEnvironment environment;
  std::vector<WorldObstacle> obstacles;
  for (const ObstacleScenario& obstacle : world.obstacles) {
    const Pose X_WO = {rotationFromRpy(obstacle.hull.rpy), obstacle.hull.p_HS};
    const auto whole = static_cast<std::int32_t>(obstacles.size());
    for (const HullScenario& piece : piecesOf(obstacle)) {
      const HullScenario in_place = {piece.shape, Vector3::Zero(), Vector3::Zero()};
      obstacles.push_back({obstacle.name, convexHull(hullPoints(in_place), obstacle.name), X_WO,
                           static_cast<int>(obstacle.material), whole});
    }
  }
  return obstacles;
}

World worldOf(const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  WorldConfig config = scenario.world ? configOf(*scenario.world) : WorldConfig();
  config.bodies_meet = scenario.world.has_value();
  config.integrator = scenario.integrator;
  config.step = scenario.stepSize();
  std::vector<WorldBody> bodies;
  const auto add = [&](const VehicleScenario& body) {
    bodies.push_back({body.name, modelOf(scenario, body),
                      scenario.world ? std::optional(hullOf(body)) : std::nullopt,
                      static_cast<int>(body.material)});
  };
  for (const VehicleScenario& vehicle : scenario.vehicles) add(vehicle);
  if (scenario.world) {
    for (const VehicleScenario& body : scenario.world->bodies) add(body);
  }
  return {std::move(config), std::move(bodies),
          scenario.world ? obstaclesOf(*scenario.world) : std::vector<WorldObstacle>()};
}

}  // namespace hovercraft
