#pragma once

#include <cstdint>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/pilot/manoeuvre.h"

/// Levels over time that depend on nothing but time, for identification. t counts from the first
/// execute, s, 0 or greater; what comes after the end is the end. The same bits on every machine.
namespace hovercraft {

HOVERCRAFT_PUBLIC double durationOf(const Steps& steps);
HOVERCRAFT_PUBLIC double durationOf(const Ramp& ramp);
HOVERCRAFT_PUBLIC double durationOf(const Prbs& prbs);
HOVERCRAFT_PUBLIC double durationOf(const Chirp& chirp);

/// @param levels of the size that those of the manoeuvre have; replaced.
HOVERCRAFT_PUBLIC void levelsAt(const Steps& steps, double t, Levels& levels);
HOVERCRAFT_PUBLIC void levelsAt(const Ramp& ramp, double t, Levels& levels);
HOVERCRAFT_PUBLIC void levelsAt(const Prbs& prbs, double t, Levels& levels);
HOVERCRAFT_PUBLIC void levelsAt(const Chirp& chirp, double t, Levels& levels);

/// A bit of a sequence of maximum length, by a shift register with feedback (Golomb, Shift Register
/// Sequences, 1967): 2^order - 1 bits, one more 1 than 0, then the same again.
/// @param order kLeastPrbsOrder to kMostPrbsOrder. @param index 0 or greater.
HOVERCRAFT_PUBLIC bool maximumLengthBit(int order, std::int64_t index);

/// The number of the interval of a length that t lies in, 0 for the first. A t that rounding put
/// just before a border counts as on it.
HOVERCRAFT_PUBLIC std::int64_t intervalAt(double t, double length);

}  // namespace hovercraft
