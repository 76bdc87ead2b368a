#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/parse_number.h"

namespace hovercraft {

/// Seconds as decimal text to whole nanoseconds, exactly; a half and more of a nanosecond counts
/// as one, so that a text with 17 digits of a double's time gives the time that was meant.
/// @param text parseNumber() finds in it a number of at most kMaxNanoseconds, of either sign.
HOVERCRAFT_PUBLIC std::int64_t parseNanoseconds(const std::string& text);

/// Appends the shortest decimal number that parseNumber() reads as the same bits, and of several
/// the nearest one: 0.6, not 0.59999999999999998. Written as %g writes: with an exponent below 1e-4
/// and from 1e17 on. Several times as fast as printf for the numbers that a craft's motion is made
/// of.
/// @param number if it is not finite, what is written is a word that parseNumber() refuses.
HOVERCRAFT_PUBLIC void appendNumber(fmt::memory_buffer& buffer, double number);
HOVERCRAFT_PUBLIC std::string numberText(double number);

/// Appends whole nanoseconds as seconds, exactly and without trailing zeros: 1500000000 is 1.5.
HOVERCRAFT_PUBLIC void appendSeconds(fmt::memory_buffer& buffer, std::int64_t time_ns);
HOVERCRAFT_PUBLIC std::string secondsText(std::int64_t time_ns);

}  // namespace hovercraft
