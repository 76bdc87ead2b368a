#include "hovercraft_sim/web/craft_controls.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft_ros {

using hovercraft::ActuatorPush;
using hovercraft::Vector3;

namespace {

constexpr double kPushesAhead = 0.5;  // of the direction's x
constexpr double kHasArm = 0.05;      // of the greatest distance from the centre of mass

/// What a level does in the plane: force along x, and moment about the centre of mass over force.
struct Effect {
  double ahead = 0.0;
  double arm = 0.0;  // m
};

Effect effectOf(const Vector3& p_BE, const Vector3& direction) {
  return {direction.x(), p_BE.x() * direction.y() - p_BE.y() * direction.x()};
}

/// The way that a greater level pushes, in B. A lift fan blows down: it neither pushes nor turns.
Vector3 pushOf(const hovercraft::ActuatorScenario& actuator) {
  const Vector3& along = actuator.motion.direction;
  switch (hovercraft::traitsOf(actuator.kind).push) {
    case ActuatorPush::kAlong:
      return along;
    case ActuatorPush::kAcross:
      return hovercraft::cross(actuator.hinge, along);
    case ActuatorPush::kNone:
      break;
  }
  return Vector3::Zero();
}

int signOf(double value) {
  return value > 0.0 ? 1 : -1;
}

/// What a driver who asks for ahead or for a turn asks of each control. @param reach m, of the
/// farthest one from the centre of mass.
void setDirections(const std::vector<Effect>& effects, double reach,
                   std::vector<CraftControl>& controls) {
  const auto has_arm = [&](const Effect& effect) { return std::abs(effect.arm) > kHasArm * reach; };
  const auto pushes = [](const Effect& effect) { return std::abs(effect.ahead) > kPushesAhead; };
  const bool has_pure = std::any_of(effects.begin(), effects.end(), [&](const Effect& effect) {
    return pushes(effect) && !has_arm(effect);
  });
  for (std::size_t i = 0; i < controls.size(); ++i) {
    const Effect& effect = effects[i];
    if (pushes(effect) && !(has_pure && has_arm(effect))) controls[i].ahead = signOf(effect.ahead);
    if (has_arm(effect)) controls[i].turn = signOf(effect.arm);
  }
}

}  // namespace

std::vector<CraftControl> controlsOf(const hovercraft::VehicleScenario& craft) {
  const hovercraft::FloatingPointEnvironment environment;
  std::vector<CraftControl> controls;
  std::vector<Effect> effects;
  double reach = 0.0;
  const auto add = [&](CraftControl control, const hovercraft::EngineParameters& motion,
                       const Vector3& direction) {
    const Vector3 p_BE = motion.p_HE - craft.mass_properties.p_HB;
    control.least = motion.min_thrust;
    control.most = motion.max_thrust;
    reach = std::max(reach, hovercraft::norm(p_BE));
    effects.push_back(effectOf(p_BE, direction));
    controls.push_back(std::move(control));
  };
  for (std::size_t i = 0; i < craft.engines.size(); ++i) {
    if (!craft.has_engine[i]) continue;
    CraftControl control;
    control.name = hovercraft::kEngineNames[i];
    control.unit = "N";
    add(control, craft.engines[i], craft.engines[i].direction);
  }
  for (const hovercraft::ActuatorScenario& actuator : craft.actuators) {
    CraftControl control;
    control.name = actuator.name;
    control.unit = hovercraft::traitsOf(actuator.kind).unit;
    control.rest = actuator.initial;
    control.holds = hovercraft::traitsOf(actuator.kind).push != ActuatorPush::kAlong;
    add(control, actuator.motion, pushOf(actuator));
  }
  setDirections(effects, reach, controls);
  return controls;
}

}  // namespace hovercraft_ros
