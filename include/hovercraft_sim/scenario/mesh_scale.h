#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// The scale that follows --scale on a command line: one number or three, each > 0. Words behind
/// the numbers are file names.
/// @param words what followed the option. @param files gets the words that are no numbers.
/// @throws std::invalid_argument
HOVERCRAFT_PUBLIC Vector3 takeScale(const std::vector<std::string>& words,
                                    std::vector<std::string>& files);

}  // namespace hovercraft
