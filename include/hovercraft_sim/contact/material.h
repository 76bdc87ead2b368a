#pragma once

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// What a surface does when it meets another.
struct ContactMaterial {
  double restitution = 0.0;  // e in [0, 1] (-)
  double friction = 0.0;     // Coulomb's mu, >= 0 (-)
  bool stick = false;        // perfectly plastic: no bounce, and no slip while it is pressed
};

/// The law between two surfaces: the lesser restitution, the geometric mean of the frictions, and
/// stick if either sticks. Symmetric in a and b.
HOVERCRAFT_PUBLIC ContactMaterial combined(const ContactMaterial& a, const ContactMaterial& b);

}  // namespace hovercraft
