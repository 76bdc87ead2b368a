#include "hovercraft_sim/hovercraft/rotors.h"

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {

Vector3 rotorMomentum(const std::vector<Rotor>& rotors, const ActuatorArray<double>& levels) {
  const FloatingPointEnvironment environment;
  Vector3 sum = Vector3::Zero();
  for (const Rotor& rotor : rotors) sum += rotor.angularMomentum(levels[rotor.id]) * rotor.axis;
  return sum;
}

}  // namespace hovercraft
