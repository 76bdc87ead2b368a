#include "hovercraft_sim/view/detail_markers.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <initializer_list>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/view/vehicle_markers.h"

namespace hovercraft_ros {
namespace {

using hovercraft::Vector3;
using visualization_msgs::Marker;

constexpr double kArrowOfFullThrust = 0.8;  // m, as thrustMarkers()
constexpr double kLongestArrow = 4.0;       // m
constexpr double kShortestArrow = 0.005;    // m: less is not drawn
constexpr double kForceHeight = 0.3;   // m above the centre of mass: hulls hide what is in them
constexpr double kBeside = 0.07;       // m, of the resultant above the drag, often the same
constexpr double kWindArrow = 0.2;     // m for 1 m/s
constexpr double kWindHeight = 0.6;    // m above the centre of mass
constexpr double kImpulseArrow = 0.3;  // m for 1 N s
constexpr double kWordHeight = 0.08;   // m

Marker detail(const std::string& frame, const std::string& space, int id, int type,
              const std::array<float, 3>& color) {
  Marker marker = markerOf(frame, space, id, type);
  marker.color.r = color[0];
  marker.color.g = color[1];
  marker.color.b = color[2];
  marker.color.a = 1.0F;
  return marker;
}

constexpr std::array<float, 3> kDragColor = {0.80F, 0.47F, 0.65F};  // those of Okabe and Ito
constexpr std::array<float, 3> kResultantColor = {0.94F, 0.89F, 0.26F};
constexpr std::array<float, 3> kWindColor = {0.34F, 0.71F, 0.91F};
constexpr std::array<float, 3> kContactColor = {0.90F, 0.30F, 0.20F};
constexpr std::array<float, 3> kNearestColor = {0.0F, 0.80F, 0.60F};

void point(Marker& arrow, const Vector3& from, const Vector3& along) {
  arrow.points = {toPointMessage(from), toPointMessage(from + along)};
  arrow.scale.x = 0.03;  // m: shaft, head diameter, head length
  arrow.scale.y = 0.07;
  arrow.scale.z = 0.08;
  if (!(hovercraft::norm(along) >= kShortestArrow)) arrow.action = Marker::DELETE;
}

Marker wordsAt(const Marker& beside, int id, const Vector3& at, const std::string& text) {
  Marker result = beside;
  result.id = id;
  result.type = Marker::TEXT_VIEW_FACING;
  result.points.clear();
  result.pose.position = toPointMessage(at);
  result.scale = geometry_msgs::Vector3();
  result.scale.z = kWordHeight;
  result.text = text;
  return result;
}

/// N that are drawn as a full thrust.
double fullForce(const hovercraft::VehicleScenario& craft) {
  double full = 0.0;
  for (const hovercraft::EngineParameters& engine : craft.engines) {
    full = std::max({full, engine.max_thrust, -engine.min_thrust});
  }
  for (const hovercraft::ActuatorScenario& actuator : craft.actuators) {
    if (actuator.kind != hovercraft::ActuatorKind::kFan) continue;
    full = std::max({full, actuator.motion.max_thrust, -actuator.motion.min_thrust});
  }
  return full > 0.0 ? full : craft.mass_properties.mass;
}

Vector3 bounded(const Vector3& arrow, double least, double most) {
  const double length = hovercraft::norm(arrow);
  if (!(length > 0.0)) return Vector3::Zero();
  return std::clamp(length, least, most) / length * arrow;
}

}  // namespace

Vector3 dragOf(const hovercraft::VehicleScenario& craft, const Vector3& wind,
               const hovercraft_sim::State& state) {
  const hovercraft::FloatingPointEnvironment environment;
  const hovercraft::Matrix3 R_WB = hovercraft::rotationMatrix(fromMessage(state.pose.orientation));
  const Vector3 u_B = hovercraft::transposeTimes(R_WB, fromMessage(state.velocity) - wind);
  Vector3 force_B = craft.drag.wrenchInBody(u_B, Vector3::Zero()).force;
  for (const hovercraft::DragLaw& law : craft.drag_laws) {
    force_B += hovercraft::wrenchInBody(law, u_B).force;
  }
  return hovercraft::times(R_WB, force_B);
}

std::optional<Vector3> resultantOf(const CraftMotion& motion) {
  const hovercraft::FloatingPointEnvironment environment;
  if (!motion.before) return std::nullopt;
  const double dt = (motion.state.header.stamp - motion.before->header.stamp).toSec();
  if (!(dt > 0.0)) return std::nullopt;
  return (1.0 / dt) * (fromMessage(motion.state.momentum) - fromMessage(motion.before->momentum));
}

std::vector<Marker> forceMarkers(const hovercraft::VehicleScenario& craft,
                                 const Vector3& steady_wind, const CraftMotion& motion) {
  const std::string& frame = motion.state.header.frame_id;
  const Vector3 wind = motion.wind.value_or(steady_wind);
  const Vector3 p_WB = fromMessage(motion.state.pose.position);
  const Vector3 from = p_WB + Vector3(0.0, 0.0, kForceHeight);
  const double metres = kArrowOfFullThrust / fullForce(craft);
  Marker drag = detail(frame, craft.name + "/drag", 0, Marker::ARROW, kDragColor);
  point(drag, from, bounded(metres * dragOf(craft, wind, motion.state), 0.0, kLongestArrow));
  Marker resultant = detail(frame, craft.name + "/resultant", 0, Marker::ARROW, kResultantColor);
  const Vector3 force = resultantOf(motion).value_or(Vector3::Zero());
  point(resultant, from + Vector3(0.0, 0.0, kBeside), bounded(metres * force, 0.0, kLongestArrow));
  Marker air = detail(frame, craft.name + "/wind", 0, Marker::ARROW, kWindColor);
  const Vector3 above = p_WB + Vector3(0.0, 0.0, kWindHeight);
  point(air, above, bounded(kWindArrow * wind, 0.0, kLongestArrow));
  const Marker speed = wordsAt(air, 1, above + Vector3(0.0, 0.0, 1.5 * kWordHeight),
                               fmt::format("wind {:.2g} m/s", hovercraft::norm(wind)));
  return {drag, resultant, air, speed};
}

std::vector<Marker> contactMarkers(const hovercraft_sim::Contact& contact, int id) {
  const Vector3 at = fromMessage(contact.point) + Vector3(0.0, 0.0, kForceHeight);
  const Vector3 impulse = fromMessage(contact.impulse);
  Marker arrow = detail(contact.header.frame_id, "contacts", 2 * id, Marker::ARROW, kContactColor);
  arrow.lifetime = ros::Duration(kContactShown);
  point(arrow, at, bounded(kImpulseArrow * impulse, 0.1, 2.0));
  const std::string text = fmt::format("{:.3g} N s", hovercraft::norm(impulse));
  const Marker size = wordsAt(arrow, 2 * id + 1, at + Vector3(0.0, 0.0, 0.15), text);
  return {arrow, size};
}

std::vector<Marker> nearestMarkers(const std::optional<hovercraft::NearestPair>& pair,
                                   const std::string& world_frame) {
  Marker line = detail(world_frame, "nearest", 0, Marker::LINE_LIST, kNearestColor);
  line.scale.x = 0.015;
  Marker ends = detail(world_frame, "nearest", 1, Marker::SPHERE_LIST, kNearestColor);
  ends.scale = toVector3Message(Vector3::Constant(0.05));
  Vector3 middle = Vector3::Zero();
  std::string text;
  if (pair) {
    line.points = {toPointMessage(pair->p_WCa), toPointMessage(pair->p_WCb)};
    ends.points = line.points;
    middle = 0.5 * (pair->p_WCa + pair->p_WCb);
    text = fmt::format("{} - {}: {:.3f} m", pair->a, pair->b, pair->distance);
  }
  std::vector<Marker> markers = {line, ends,
                                 wordsAt(line, 2, middle + Vector3(0.0, 0.0, 0.15), text)};
  for (Marker& marker : markers) {
    if (!pair) marker.action = Marker::DELETE;
  }
  return markers;
}

}  // namespace hovercraft_ros
