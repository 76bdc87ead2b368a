#include "hovercraft_sim/view/vehicle_markers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

#include <std_msgs/ColorRGBA.h>

#include "hovercraft_sim/geometry/convex_hull.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/tf_frames.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Quaternion;
using hovercraft::Vector3;
using visualization_msgs::Marker;

struct Color {
  float r, g, b, a;
};
/// Of the craft: those of Okabe and Ito, which people who see fewer colours tell apart.
constexpr std::array<Color, kCraftColors> kHullColors = {{{0.20F, 0.45F, 0.75F, 1.0F},
                                                          {0.84F, 0.37F, 0.0F, 1.0F},
                                                          {0.0F, 0.62F, 0.45F, 1.0F},
                                                          {0.80F, 0.47F, 0.65F, 1.0F},
                                                          {0.94F, 0.89F, 0.26F, 1.0F},
                                                          {0.34F, 0.71F, 0.91F, 1.0F}}};
constexpr Color kBowColor = {0.95F, 0.95F, 0.95F, 1.0F};
constexpr Color kEngineColor = {0.25F, 0.25F, 0.28F, 1.0F};
constexpr Color kThrustColor = {1.0F, 0.55F, 0.0F, 0.9F};
constexpr Color kSaturatedColor = {0.9F, 0.1F, 0.1F, 0.9F};
constexpr Color kBodyColor = {0.75F, 0.55F, 0.30F, 1.0F};
constexpr Color kObstacleColor = {0.87F, 0.84F, 0.74F, 1.0F};  // brighter than any ground
constexpr Color kPathColor = {0.1F, 0.8F, 0.3F, 1.0F};

constexpr double kLeastEdge = 0.02;         // m: a flat plate is still seen
constexpr double kEngineDiameter = 0.14;    // m
constexpr double kEngineLength = 0.08;      // m
constexpr double kArrowPerMaximum = 0.8;    // m of arrow at full thrust
constexpr double kLeastShownThrust = 0.01;  // of the maximum
constexpr double kPathWidth = 0.03;         // m
constexpr double kNameHeight = 0.12;        // m
constexpr double kNameAbove = 0.45;         // m above base_link

Marker marker(const hovercraft::VehicleScenario& craft, const std::string& kind, int id, int type,
              const Color& color) {
  Marker result;
  result.header.frame_id = TfFrames().of(craft.name);
  result.ns = craft.name + "/" + kind;
  result.id = id;
  result.type = type;
  result.action = Marker::ADD;
  result.frame_locked = 1;
  result.pose.orientation.w = 1.0;
  result.color.r = color.r;
  result.color.g = color.g;
  result.color.b = color.b;
  result.color.a = color.a;
  return result;
}

void setScale(Marker& target, const Vector3& scale) {
  target.scale = toVector3Message(scale);
}

/// Shapes of the scenario as markers; a cone is the head of an arrow without a shaft.
struct ShapePainter {
  Marker& target;

  void operator()(const hovercraft::BoxShape& box) const {
    target.type = Marker::CUBE;
    setScale(target, box.size);
  }
  void operator()(const hovercraft::SphereShape& sphere) const {
    target.type = Marker::SPHERE;
    setScale(target, Vector3::Constant(2.0 * sphere.radius));
  }
  void operator()(const hovercraft::CylinderShape& cylinder) const {
    target.type = Marker::CYLINDER;
    setScale(target, {2.0 * cylinder.radius, 2.0 * cylinder.radius, cylinder.length});
  }
  void operator()(const hovercraft::ConeShape& cone) const {
    target.type = Marker::ARROW;
    target.points = {toPointMessage({0.0, 0.0, -0.5 * cone.length}),
                     toPointMessage({0.0, 0.0, 0.5 * cone.length})};
    setScale(target, {2.0 * cone.radius, 2.0 * cone.radius, cone.length});
  }
  void operator()(const hovercraft::MeshShape& mesh) const {
    target.type = Marker::MESH_RESOURCE;
    target.mesh_resource = "file://" + mesh.file;
    setScale(target, mesh.scale);
  }
};

/// Makes a marker draw a mesh with the colours that it has of its own, placed in frame H.
void setVisual(Marker& target, const hovercraft::VisualScenario& visual, const Quaternion& q_WH,
               const Vector3& p_WH) {
  target.type = Marker::MESH_RESOURCE;
  target.mesh_resource = visual.resource;
  target.mesh_use_embedded_materials = 1;
  target.color = std_msgs::ColorRGBA();  // black would tint it, transparent black does not
  target.points.clear();
  setScale(target, visual.scale);
  target.pose.position =
      toPointMessage(p_WH + hovercraft::times(rotationMatrix(q_WH), visual.p_HV));
  target.pose.orientation = toQuaternionMessage(q_WH * hovercraft::quaternionFromRpy(visual.rpy));
}

std::vector<Marker> hullMarkers(const hovercraft::VehicleScenario& craft, const Color& color) {
  std::vector<Marker> markers;
  if (craft.visual) {
    Marker mesh = marker(craft, "hull", 0, Marker::MESH_RESOURCE, color);
    setVisual(mesh, *craft.visual, {}, Vector3::Zero());
    return {mesh};
  }
  if (craft.parts.empty()) {
    Marker box = marker(craft, "hull", 0, Marker::CUBE, color);
    const Vector3 edges = equivalentBox(craft.mass_properties);
    setScale(box, edges.cwiseMax(kLeastEdge));
    box.pose.position = toPointMessage(craft.mass_properties.p_HB);
    markers.push_back(box);
    // The bow, so that fore and aft are told apart.
    Marker bow = marker(craft, "hull", 1, Marker::CYLINDER, kBowColor);
    setScale(bow, {0.5 * edges.y(), 0.5 * edges.y(), 1.02 * std::max(edges.z(), kLeastEdge)});
    bow.pose.position =
        toPointMessage(craft.mass_properties.p_HB + 0.25 * Vector3(edges.x(), 0.0, 0.0));
    markers.push_back(bow);
    return markers;
  }
  int id = 0;
  for (const hovercraft::PartScenario& part : craft.parts) {
    Marker shape = marker(craft, "hull", id++, Marker::CUBE, color);
    shape.pose.position = toPointMessage(part.p_HP);
    shape.pose.orientation = toQuaternionMessage(hovercraft::quaternionFromRpy(part.rpy));
    std::visit(ShapePainter{shape}, part.shape);
    markers.push_back(shape);
  }
  return markers;
}

/// RViz draws a cylinder along z: first z to x, then x to the engine's direction.
Quaternion alongEngine(const Vector3& direction) {
  const Quaternion z_to_x = hovercraft::quaternionFromRpy({0.0, std::acos(0.0), 0.0});
  return turnFromX(direction) * z_to_x;
}

}  // namespace

visualization_msgs::Marker markerOf(const std::string& frame, const std::string& space, int id,
                                    int type) {
  visualization_msgs::Marker marker;
  marker.header.frame_id = frame;
  marker.ns = space;
  marker.id = id;
  marker.type = type;
  marker.action = visualization_msgs::Marker::ADD;
  marker.pose.orientation.w = 1.0;
  return marker;
}

// A box of edges a, b, c has I_xx = m (b² + c²)/12 and so on; solved for a²: 6 (I_yy + I_zz -
// I_xx)/m.
Vector3 equivalentBox(const hovercraft::MassProperties& body) {
  const Vector3 moments = body.I_BBo_B.diagonal();
  Vector3 edges;
  for (int i = 0; i < 3; ++i) {
    const double squared =
        6.0 * (moments[(i + 1) % 3] + moments[(i + 2) % 3] - moments[i]) / body.mass;
    edges[i] = std::sqrt(std::max(squared, 0.0));
  }
  return edges;
}

std::vector<Marker> craftMarkers(const hovercraft::VehicleScenario& craft, std::size_t index) {
  std::vector<Marker> markers = hullMarkers(craft, kHullColors[index % kCraftColors]);
  int id = 0;
  for (const hovercraft::EngineParameters& engine : craft.engines) {
    if (engine.min_thrust == 0.0 && engine.max_thrust == 0.0) continue;  // not built in
    Marker fan = marker(craft, "engines", id++, Marker::CYLINDER, kEngineColor);
    setScale(fan, {kEngineDiameter, kEngineDiameter, kEngineLength});
    fan.pose.position = toPointMessage(engine.p_HE);
    fan.pose.orientation = toQuaternionMessage(alongEngine(engine.direction));
    markers.push_back(fan);
  }
  return markers;
}

Marker nameMarker(const hovercraft::VehicleScenario& craft) {
  Marker name = marker(craft, "name", 0, Marker::TEXT_VIEW_FACING, kBowColor);
  name.scale.z = kNameHeight;
  name.pose.position = toPointMessage({0.0, 0.0, kNameAbove});
  name.text = craft.name;
  return name;
}

std::vector<Marker> thrustMarkers(const hovercraft::VehicleScenario& craft,
                                  const hovercraft_sim::EngineStatus& engines) {
  const std::array<const hovercraft_sim::Engine*, hovercraft::kEngineCount> status = {
      &engines.rear, &engines.left, &engines.right};
  std::vector<Marker> markers;
  for (std::size_t i = 0; i < status.size(); ++i) {
    const hovercraft::EngineParameters& engine = craft.engines[i];
    const double full = std::max(engine.max_thrust, -engine.min_thrust);
    const double share = full > 0.0 ? status[i]->applied / full : 0.0;
    Marker arrow = marker(craft, "thrust", static_cast<int>(i), Marker::ARROW,
                          status[i]->saturated ? kSaturatedColor : kThrustColor);
    if (std::abs(share) < kLeastShownThrust) arrow.action = Marker::DELETE;
    arrow.points = {toPointMessage(engine.p_HE),
                    toPointMessage(engine.p_HE + kArrowPerMaximum * share * engine.direction)};
    setScale(arrow, {0.04, 0.09, 0.1});  // m: shaft, head diameter, head length
    markers.push_back(arrow);
  }
  return markers;
}

namespace {

/// The faces of a polyhedron as fans of triangles, shifted.
void addTriangles(const hovercraft::ConvexPolyhedron& hull, const Vector3& shift, Marker& target) {
  for (int face = 0; face < hull.faceCount(); ++face) {
    const auto ring = hull.verticesOf({hovercraft::FeatureKind::kFace, face});
    for (std::size_t i = 2; i < ring.size(); ++i) {
      for (const std::int32_t vertex : {ring[0], ring[i - 1], ring[i]}) {
        target.points.push_back(toPointMessage(hull.vertex(vertex) + shift));
      }
    }
  }
}

}  // namespace

Marker bodyMarker(const hovercraft::VehicleScenario& body) {
  Marker result = marker(body, "hull", 0, Marker::TRIANGLE_LIST, kBodyColor);
  setScale(result, Vector3::Ones());
  addTriangles(hovercraft::hullOf(body), body.mass_properties.p_HB, result);
  if (body.visual) setVisual(result, *body.visual, {}, Vector3::Zero());
  return result;
}

std::vector<Marker> obstacleMarkers(const hovercraft::Scenario& scenario,
                                    const std::string& world_frame) {
  std::vector<Marker> markers;
  if (!scenario.world) return markers;
  for (const hovercraft::ObstacleScenario& obstacle : scenario.world->obstacles) {
    hovercraft::VehicleScenario named;
    named.name = obstacle.name;
    Marker result = marker(named, "obstacle", 0, Marker::TRIANGLE_LIST, kObstacleColor);
    result.header.frame_id = world_frame;
    setScale(result, Vector3::Ones());
    for (const hovercraft::HullScenario& piece : hovercraft::piecesOf(obstacle)) {
      addTriangles(hovercraft::convexHull(hovercraft::hullPoints(piece), obstacle.name),
                   Vector3::Zero(), result);
    }
    if (obstacle.visual) {
      setVisual(result, *obstacle.visual, hovercraft::quaternionFromRpy(obstacle.hull.rpy),
                obstacle.hull.p_HS);
    }
    markers.push_back(result);
  }
  return markers;
}

void addPrefix(const std::string& prefix, std::vector<Marker>& markers) {
  if (prefix.empty()) return;
  for (Marker& each : markers) each.header.frame_id.insert(0, prefix + "/");
}

Marker pathMarker(const hovercraft::VehicleScenario& craft, const std::string& world_frame,
                  const std::vector<geometry_msgs::Point>& path) {
  Marker line = marker(craft, "path", 0, Marker::LINE_STRIP, kPathColor);
  line.header.frame_id = world_frame;
  line.frame_locked = 0;
  line.scale.x = kPathWidth;
  line.points = path;
  if (path.size() < 2) line.action = Marker::DELETE;
  return line;
}

}  // namespace hovercraft_ros
