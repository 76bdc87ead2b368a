#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/sim/simulation.h"
#include "hovercraft_sim/sim/state_hash.h"

/// What a simulation knows of single actuators: their rotors and their faults.

namespace hovercraft {

void Simulation::setActuator(std::size_t vehicle, std::size_t id, double efficiency, bool stuck) {
  demand(vehicle < vehicleCount() && id < state_.engines[vehicle].size(),
         "a fault must name an actuator of the scenario");
  demand(efficiency >= 0.0 && efficiency <= 1.0, "an efficiency must be checked before");
  steady_until_[vehicle] = 0;
  EngineState& actuator = state_.engines[vehicle][id];
  actuator.efficiency = efficiency;
  actuator.stuck = stuck;
}

/// The angular momentum of the rotors of a body relative to it, as they turn at this tick, N m s.
Vector3 Simulation::rotorsOf(std::size_t body) const {
  const std::vector<Rotor>& rotors = modelOf(body).rotors;
  if (rotors.empty()) return Vector3::Zero();
  return rotorMomentum(rotors, levelsOf(state_.engines[body]));
}

Motion Simulation::motionOf(std::size_t body, const BodyState& state) const {
  const HovercraftModel& model = modelOf(body);
  const bool has_rotors = !model.rotors.empty();
  const Vector3 rotors_B = rotorsOf(body);
  return std::visit(
      [&](const auto& y) -> Motion {
        const double potential = -dot(model.weight_W, y.p_WB);
        const double kinetic = has_rotors ? kineticEnergy(y, model.mobility, rotors_B)
                                          : kineticEnergy(y, model.mobility);
        return {y.p_WB,
                toQuaternion(y.orientation),
                has_rotors ? model.mobility.twist(y, rotors_B) : model.mobility.twist(y),
                y.momentum_W,
                y.angular_momentum_W,
                kinetic + potential};
      },
      state);
}

/// Faults determine the future where there are some.
void Simulation::addFaults(StateHash& hash, std::size_t first, std::size_t last) const {
  for (std::size_t vehicle = first; vehicle < last; ++vehicle) {
    const EngineStates& actuators = state_.engines[vehicle];
    for (std::size_t id = 0; id < actuators.size(); ++id) {
      if (actuators[id].isFaulty()) hash.addFault(vehicle, id, actuators[id]);
    }
  }
}

}  // namespace hovercraft
