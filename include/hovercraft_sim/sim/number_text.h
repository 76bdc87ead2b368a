#pragma once

#include <cstdint>
#include <fmt/format.h>
#include <string>

#include "hovercraft_sim/math/parse_number.h"

namespace hovercraft {

/// Seconds as decimal text to whole nanoseconds, exactly; a half and more of a nanosecond counts
/// as one, so that a text with 17 digits of a double's time gives the time that was meant.
/// @param text parseNumber() finds in it a number of at most kMaxNanoseconds, of either sign.
std::int64_t parseNanoseconds(const std::string& text);

/// Appends a number with up to 17 significant digits, correctly rounded, the text of printf's
/// %.17g: parseNumber() gives the same bits again. Several times as fast as printf for the numbers
/// that a craft's motion is made of.
/// @param number finite.
void appendNumber(fmt::memory_buffer& buffer, double number);

/// Appends whole nanoseconds as seconds, exactly and without trailing zeros: 1500000000 is 1.5.
void appendSeconds(fmt::memory_buffer& buffer, std::int64_t time_ns);
std::string secondsText(std::int64_t time_ns);

}  // namespace hovercraft
