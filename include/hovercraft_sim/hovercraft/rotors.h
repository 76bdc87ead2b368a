#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "hovercraft_sim/hovercraft/actuator_array.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// A rotor of an actuator as the scenario describes it; it turns with the level.
struct RotorParameters {
  double inertia = 0.0;  // J, kg m² about its axis; 0: none
  double speed = 0.0;    // rad/s: of a level that is a thrust at the greater of its limits, else of
                         // a level of 1
  double turn = 1.0;     // 1 or -1: right- or left-handed about its axis, at a positive level
};

/// A rotor of a craft: its angular momentum J Omega relative to the hull, (32) of doc/craft.md. The
/// L of a body's state is the total one, so that
///   w = I^-1 (R^T L - sum J_i Omega_i a_i)
/// with I that of the hull with its rotors at rest: gyroscopic moment and the reaction to spinning
/// up come by themselves, and L of a free craft stays to the last bit.
struct Rotor {
  std::size_t id = 0;           // of its actuator
  bool by_square_root = false;  // its level is a thrust, which grows with the square of the speed
  double scale = 0.0;           // N m s of a level of 1, signed
  double most = 0.0;            // N m s, bound within the limits of the level
  Vector3 axis = Vector3::UnitZ();  // unit, in B

  /// About its axis, N m s.
  double angularMomentum(double level) const {
    if (!by_square_root) return scale * level;
    const double root = scale * std::sqrt(std::abs(level));
    return level < 0.0 ? -root : root;
  }
};

/// The angular momentum of all of them relative to the hull, N m s in B, in their order. Out of
/// line, so that a craft without any keeps its registers.
HOVERCRAFT_PUBLIC Vector3 rotorMomentum(const std::vector<Rotor>& rotors,
                                        const ActuatorArray<double>& levels);

}  // namespace hovercraft
