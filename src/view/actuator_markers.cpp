#include "hovercraft_sim/view/actuator_markers.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/tf_frames.h"
#include "hovercraft_sim/view/vehicle_markers.h"

namespace hovercraft_ros {
namespace {

using hovercraft::ActuatorKind;
using hovercraft::ActuatorScenario;
using hovercraft::Quaternion;
using hovercraft::Vector3;
using visualization_msgs::Marker;

constexpr double kDiscDiameter = 0.14;     // m, of a fan whose scenario says none; as engines
constexpr double kDiscThickness = 0.03;    // m
constexpr double kArrowOfFullLevel = 0.8;  // m, as thrustMarkers()
constexpr double kLeastShownLevel = 0.01;  // of the greater limit
constexpr double kPlateThickness = 0.01;   // m

void paint(Marker& target, float r, float g, float b, float a) {
  target.color.r = r;
  target.color.g = g;
  target.color.b = b;
  target.color.a = a;
}

void paintState(Marker& target, const hovercraft_sim::ActuatorStatus& status) {
  if (status.stuck != 0 || status.efficiency < 1.0) {
    paint(target, 0.6F, 0.2F, 0.8F, 0.9F);
  } else if (status.saturated != 0) {
    paint(target, 0.9F, 0.1F, 0.1F, 0.9F);
  } else {
    paint(target, 1.0F, 0.55F, 0.0F, 0.9F);
  }
}

/// Where the status is missing it is that of a sound actuator at level 0.
hovercraft_sim::ActuatorStatus statusOf(const hovercraft_sim::ActuatorStatusArray& all,
                                        std::size_t index) {
  if (index < all.actuators.size()) return all.actuators[index];
  hovercraft_sim::ActuatorStatus none;
  none.efficiency = 1.0;
  return none;
}

Quaternion turnFromZ(const Vector3& direction) {
  const Quaternion z_to_x = hovercraft::quaternionFromRpy({0.0, 0.5 * hovercraft::kPi, 0.0});
  return turnFromX(direction) * z_to_x;
}

/// The plane of its direction and its hinge, turned about that.
Quaternion turnOfRudder(const ActuatorScenario& rudder, double angle) {
  hovercraft::Matrix3 axes;
  axes.col(0) = rudder.motion.direction;
  axes.col(1) = hovercraft::cross(rudder.hinge, rudder.motion.direction);
  axes.col(2) = rudder.hinge;
  return hovercraft::quaternionFromMatrix(axes) * hovercraft::quaternionFromRpy({0.0, 0.0, angle});
}

void setSize(Marker& target, double x, double y, double z) {
  target.scale.x = x;
  target.scale.y = y;
  target.scale.z = z;
}

}  // namespace

std::vector<Marker> actuatorMarkers(const hovercraft::VehicleScenario& craft,
                                    const hovercraft_sim::ActuatorStatusArray& status) {
  const hovercraft::FloatingPointEnvironment environment;
  const std::string frame = TfFrames().of(craft.name);
  std::vector<Marker> markers;
  for (std::size_t i = 0; i < craft.actuators.size(); ++i) {
    const ActuatorScenario& actuator = craft.actuators[i];
    const hovercraft_sim::ActuatorStatus now = statusOf(status, i);
    const auto add = [&](const char* kind, int type) -> Marker& {
      markers.push_back(markerOf(frame, craft.name + "/" + kind, static_cast<int>(i), type));
      markers.back().frame_locked = 1;
      return markers.back();
    };
    if (actuator.kind == ActuatorKind::kRudder) {
      Marker& plate = add("rudders", Marker::CUBE);
      const double edge = std::sqrt(actuator.area);
      setSize(plate, edge, kPlateThickness, edge);
      plate.pose.position = toPointMessage(actuator.motion.p_HE);
      plate.pose.orientation = toQuaternionMessage(turnOfRudder(actuator, now.applied));
      paintState(plate, now);
      continue;
    }
    Marker& disc = add("actuators", Marker::CYLINDER);
    const double diameter = actuator.diameter > 0.0 ? actuator.diameter : kDiscDiameter;
    setSize(disc, diameter, diameter, kDiscThickness);
    disc.pose.position = toPointMessage(actuator.motion.p_HE);
    disc.pose.orientation = toQuaternionMessage(turnFromZ(actuator.motion.direction));
    paint(disc, 0.25F, 0.25F, 0.28F, 1.0F);
    const double full = std::max(actuator.motion.max_thrust, -actuator.motion.min_thrust);
    const double share = full > 0.0 ? now.applied / full : 0.0;
    Marker& arrow = add("actuator_thrust", Marker::ARROW);
    if (std::abs(share) < kLeastShownLevel) arrow.action = Marker::DELETE;
    const Vector3 along = kArrowOfFullLevel * share * actuator.motion.direction;
    arrow.points = {toPointMessage(actuator.motion.p_HE),
                    toPointMessage(actuator.motion.p_HE + along)};
    setSize(arrow, 0.04, 0.09, 0.1);  // m: shaft, head diameter, head length
    paintState(arrow, now);
  }
  return markers;
}

}  // namespace hovercraft_ros
