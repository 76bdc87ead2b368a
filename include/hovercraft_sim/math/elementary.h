#pragma once

/// exp, log, sin, cos and the like for what determines a state.
///
/// The C library's versions differ in the last bit between processors and releases (it picks a
/// variant with fused multiply-add where there is one). These are computed with 113 bits in integer
/// arithmetic (Boost.Multiprecision) and then rounded once, so that every machine gets the same,
/// correctly rounded bits. They cost microseconds: call them when a scenario is set up, never in a
/// step.

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// @param x any finite number.
HOVERCRAFT_PUBLIC double exactExp(double x);

/// The natural logarithm. @param x finite, > 0.
HOVERCRAFT_PUBLIC double exactLog(double x);

/// @param angle rad, finite.
HOVERCRAFT_PUBLIC double exactSin(double angle);

/// @param angle rad, finite.
HOVERCRAFT_PUBLIC double exactCos(double angle);

/// The angle of the point (x, y), rad in [-pi, pi].
HOVERCRAFT_PUBLIC double exactAtan2(double y, double x);

/// @param x in [-1, 1]. @returns rad in [-pi/2, pi/2].
HOVERCRAFT_PUBLIC double exactAsin(double x);

}  // namespace hovercraft
