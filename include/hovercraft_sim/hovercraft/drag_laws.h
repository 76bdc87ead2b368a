#pragma once

#include <variant>

#include "hovercraft_sim/body/rigid_body.h"
#include "hovercraft_sim/hovercraft/drag_polar.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// A law of drag of the hull besides Drag, by the velocity of the centre of mass relative to the
/// air alone: + - * / and sqrt only, no memory. Each has wrenchInBody() and quadraticDrag(), as
/// DragPolar.
using DragLaw = std::variant<DragPolar>;

/// Force and moment about the centre of mass, both in B; N, N m. @param u_B m/s.
inline Wrench wrenchInBody(const DragLaw& law, const Vector3& u_B) {
  return std::visit([&u_B](const auto& each) { return each.wrenchInBody(u_B); }, law);
}

/// What is like Drag::quadratic of it, N s²/m²: all that the velocity controller counts with.
inline Vector3 quadraticDrag(const DragLaw& law) {
  return std::visit([](const auto& each) { return each.quadraticDrag(); }, law);
}

}  // namespace hovercraft
