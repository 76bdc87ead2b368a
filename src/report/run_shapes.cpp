#include <algorithm>
#include <limits>
#include <stdexcept>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/report/run_parts.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/view/vehicle_markers.h"

namespace hovercraft_ros {

using hovercraft::Vector3;

namespace {

constexpr double kLeastEdge = 0.02;        // m: a flat plate is still seen
constexpr double kLeastSkirt = 0.01;       // m, height of a skirt as it is drawn
constexpr std::size_t kMostHeights = 200;  // along a side of a height map, as it is drawn

RunShape facesOf(const hovercraft::ConvexPolyhedron& hull, const Vector3& shift) {
  RunShape shape;
  shape.kind = RunShape::Kind::kFaces;
  for (int i = 0; i < hull.vertexCount(); ++i) shape.vertices.push_back(hull.vertex(i) + shift);
  for (int face = 0; face < hull.faceCount(); ++face) {
    const auto ring = hull.verticesOf({hovercraft::FeatureKind::kFace, face});
    shape.faces.emplace_back(ring.begin(), ring.end());
  }
  return shape;
}

/// The solid of a part or a hull.
struct ShapeMaker {
  RunShape operator()(const hovercraft::BoxShape& box) const {
    return solid(RunShape::Kind::kBox, box.size);
  }
  RunShape operator()(const hovercraft::CylinderShape& cylinder) const {
    return solid(RunShape::Kind::kCylinder, {cylinder.radius, cylinder.length, 0.0});
  }
  RunShape operator()(const hovercraft::ConeShape& cone) const {
    return solid(RunShape::Kind::kCone, {cone.radius, cone.length, 0.0});
  }
  RunShape operator()(const hovercraft::SphereShape& sphere) const {
    return solid(RunShape::Kind::kSphere, {sphere.radius, 0.0, 0.0});
  }
  RunShape operator()(const hovercraft::PointsShape& cloud) const {
    return facesOf(hovercraft::convexHull(cloud.points, "hull"), Vector3::Zero());
  }
  /// A scenario in a bag has no mesh file any more; one whose file is there is drawn as its hull.
  RunShape operator()(const hovercraft::MeshShape& mesh) const {
    hovercraft::PartScenario part;
    part.shape = mesh;
    return facesOf(hovercraft::convexHull(hovercraft::partPoints({part}), mesh.file),
                   Vector3::Zero());
  }

 private:
  static RunShape solid(RunShape::Kind kind, const Vector3& size) {
    RunShape shape;
    shape.kind = kind;
    shape.size = size;
    return shape;
  }
};

template <class Shape>
RunShape placed(const Shape& shape, const Vector3& position, const Vector3& rpy, const char* role) {
  RunShape made = std::visit(ShapeMaker(), shape);
  made.position = position;
  made.orientation = hovercraft::quaternionFromRpy(rpy);
  made.role = role;
  return made;
}

/// The height of the lowest point of a craft without its skirt, in base_link, m.
double bottomOf(const hovercraft::VehicleScenario& vehicle) {
  if (vehicle.parts.empty()) {
    return vehicle.mass_properties.p_HB.z() - 0.5 * equivalentBox(vehicle.mass_properties).z();
  }
  double bottom = std::numeric_limits<double>::infinity();
  for (const Vector3& point : hovercraft::partPoints(vehicle.parts)) {
    bottom = std::min(bottom, point.z());
  }
  return bottom;
}

/// The air of each cell of a cushion, from its hem up to the craft.
void addSkirt(const hovercraft::VehicleScenario& vehicle, std::vector<RunShape>& shapes) {
  const double bottom = bottomOf(vehicle);
  for (const hovercraft::CushionCell& cell : vehicle.cushion->cells) {
    std::vector<Vector3> points;
    double lowest = bottom;
    for (const hovercraft::HemPoint& point : cell.hem) lowest = std::min(lowest, point.p_HK.z());
    const Vector3 up(0.0, 0.0, std::max(bottom - lowest, kLeastSkirt));
    for (const hovercraft::HemPoint& point : cell.hem) {
      points.push_back(point.p_HK);
      points.emplace_back(point.p_HK + up);
    }
    if (cell.hem.size() < 3) continue;
    shapes.push_back(facesOf(hovercraft::convexHull(points, "skirt"), Vector3::Zero()));
    shapes.back().role = "skirt";
  }
}

}  // namespace

std::vector<RunShape> shapesOf(const hovercraft::VehicleScenario& vehicle, bool is_craft) {
  std::vector<RunShape> shapes;
  const char* const role = is_craft ? "hull" : "body";
  shapes.reserve(vehicle.parts.size());
  for (const hovercraft::PartScenario& part : vehicle.parts) {
    shapes.push_back(placed(part.shape, part.p_HP, part.rpy, role));
  }
  if (shapes.empty() && vehicle.hull) {
    shapes.push_back(placed(vehicle.hull->shape, vehicle.hull->p_HS, vehicle.hull->rpy, role));
  }
  if (shapes.empty()) {
    RunShape box;
    box.size = equivalentBox(vehicle.mass_properties).cwiseMax(kLeastEdge);
    box.position = vehicle.mass_properties.p_HB;
    box.role = role;
    shapes.push_back(box);
  }
  if (vehicle.cushion) addSkirt(vehicle, shapes);
  return shapes;
}

std::vector<RunEngine> enginesOf(const hovercraft::VehicleScenario& vehicle) {
  std::vector<RunEngine> engines;
  for (std::size_t i = 0; i < vehicle.engines.size(); ++i) {
    const hovercraft::EngineParameters& parameters = vehicle.engines[i];
    const double full = std::max(parameters.max_thrust, -parameters.min_thrust);
    if (full == 0.0) continue;  // not built in
    engines.push_back({hovercraft::kEngineNames[i], parameters.p_HE, parameters.direction, full});
  }
  return engines;
}

std::optional<RunGround> groundOf(const hovercraft::Scenario& scenario) {
  if (!scenario.ground) return std::nullopt;
  RunGround ground;
  if (const auto* plane = std::get_if<hovercraft::PlaneScenario>(&scenario.ground->surface)) {
    ground.height = plane->height;
    ground.normal = plane->normal;
    return ground;
  }
  const hovercraft::HeightGrid& grid =
      std::get<hovercraft::HeightMapScenario>(scenario.ground->surface).surface->grid();
  const std::size_t stride =
      std::max<std::size_t>(1, (std::max(grid.columns, grid.rows) - 1) / kMostHeights + 1);
  ground.columns = (grid.columns - 1) / stride + 1;
  ground.spacing = grid.spacing * static_cast<double>(stride);
  ground.x = grid.x;
  ground.y = grid.y;
  for (std::size_t row = 0; row < grid.rows; row += stride) {
    for (std::size_t column = 0; column < grid.columns; column += stride) {
      ground.heights.push_back(grid.at(column, row));
    }
  }
  return ground;
}

std::vector<RunObstacle> obstaclesOf(const hovercraft::Scenario& scenario) {
  std::vector<RunObstacle> obstacles;
  if (!scenario.world) return obstacles;
  for (const hovercraft::ObstacleScenario& obstacle : scenario.world->obstacles) {
    RunObstacle shown;
    shown.name = obstacle.name;
    for (const hovercraft::HullScenario& piece : hovercraft::piecesOf(obstacle)) {
      shown.shapes.push_back(placed(piece.shape, piece.p_HS, piece.rpy, "obstacle"));
    }
    obstacles.push_back(std::move(shown));
  }
  return obstacles;
}

}  // namespace hovercraft_ros
