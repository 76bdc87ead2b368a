#include "hovercraft_sim/hovercraft/forces.h"

#include <cstddef>
#include <utility>

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

template <class Kind>
Wrench wrenchOf(const Kind& force, const ForceInputs& inputs) {
  return force.wrench(inputs);
}

/// A fan whose thrust does not fall with speed need not know it.
Wrench wrenchOf(const FanForce& fan, const ForceInputs& inputs) {
  const double thrust = fan.inverse_free_speed == 0.0 ? inputs.levels[fan.id] : fan.thrust(inputs);
  return fan.place.wrench(thrust * fan.place.direction);
}

/// Calls with the force as what it is. Kind by kind: with std::visit four fans take twice as long.
template <class Call, std::size_t... kIndex>
[[gnu::always_inline]] inline void withKind(const Force& force, const Call& call,
                                            std::index_sequence<kIndex...> /*kinds*/) {
  const auto call_if = [&](const auto* kind) {
    if (kind != nullptr) call(*kind);
    return kind != nullptr;
  };
  (void)(call_if(std::get_if<kIndex>(&force)) || ...);
}

}  // namespace

Wrench wrenchInBody(const std::vector<Force>& forces, const ForceInputs& inputs) {
  const FloatingPointEnvironment environment;
  Vector3 sum_of_forces = Vector3::Zero();
  Vector3 sum_of_torques = Vector3::Zero();
  const auto add = [&](const auto& force) {
    const Wrench wrench = wrenchOf(force, inputs);
    sum_of_forces += wrench.force;
    sum_of_torques += wrench.torque;
  };
  for (const Force& each : forces) {
    withKind(each, add, std::make_index_sequence<std::variant_size_v<Force>>());
  }
  return {sum_of_forces, sum_of_torques};
}

}  // namespace hovercraft
