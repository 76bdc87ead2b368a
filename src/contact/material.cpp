#include "hovercraft_sim/contact/material.h"

#include <algorithm>
#include <cmath>

namespace hovercraft {

ContactMaterial combined(const ContactMaterial& a, const ContactMaterial& b) {
  ContactMaterial pair;
  pair.restitution = std::min(a.restitution, b.restitution);
  pair.friction = std::sqrt(a.friction * b.friction);
  pair.stick = a.stick || b.stick;
  return pair;
}

}  // namespace hovercraft
