#pragma once

#include <vector>

#include "hovercraft_sim/geometry/convex_polygon.h"
#include "hovercraft_sim/geometry/convex_polyhedron.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// A box with its centre in the origin. @param size lengths along x, y and z, m, each positive.
/// @throws std::invalid_argument
HOVERCRAFT_PUBLIC ConvexPolyhedron boxPolyhedron(const Vector3& size);

/// A prism over a polygon in the x-y plane, from z = -height/2 to height/2.
/// @throws std::invalid_argument
HOVERCRAFT_PUBLIC ConvexPolyhedron prismPolyhedron(const ConvexPolygon& base, double height);

/// A regular n-gon prism about the z axis whose vertices lie on the cylinder; the first at y = 0.
/// @throws std::invalid_argument
HOVERCRAFT_PUBLIC ConvexPolyhedron cylinderPolyhedron(double radius, double height, int sides);

}  // namespace hovercraft
