#include "hovercraft_sim/hovercraft/forces.h"

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

/// FanForce::thrust(). A fan whose thrust does not fall with speed need not know it.
double thrustOf(const FanForce& fan, const ForceInputs& inputs) {
  return fan.inverse_free_speed == 0.0 ? inputs.levels[fan.id] : fan.thrust(inputs);
}

}  // namespace

Wrench wrenchInBody(const std::vector<Force>& forces, const ForceInputs& inputs) {
  const FloatingPointEnvironment environment;
  Wrench sum;
  for (const Force& force : forces) {
    // Kind by kind, as a call by std::visit takes three times as long as a fan.
    if (const auto* const fan = std::get_if<FanForce>(&force)) {
      sum = sum + fan->place.wrench(thrustOf(*fan, inputs) * fan->place.direction);
    } else if (const auto* const propeller = std::get_if<PropellerForce>(&force)) {
      sum = sum + propeller->wrench(inputs);
    } else if (const auto* const rudder = std::get_if<RudderForce>(&force)) {
      sum = sum + rudder->wrench(inputs);
    } else if (const auto* const polar = std::get_if<PolarForce>(&force)) {
      sum = sum + polar->wrench(inputs);
    }
  }
  return sum;
}

}  // namespace hovercraft
