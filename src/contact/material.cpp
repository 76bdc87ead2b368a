#include "hovercraft_sim/contact/material.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {

ContactMaterial combined(const ContactMaterial& a, const ContactMaterial& b) {
  const FloatingPointEnvironment environment;
  ContactMaterial pair;
  pair.restitution = std::min(a.restitution, b.restitution);
  pair.friction = std::sqrt(a.friction * b.friction);
  pair.stick = a.stick || b.stick;
  return pair;
}

}  // namespace hovercraft
