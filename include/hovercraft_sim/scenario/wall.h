#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// A wall from `wall: {points, closed, thickness, height}`.
/// @throws std::invalid_argument with key, value and rule: too few points, two in one place, a bend
/// so sharp, or a part so short, that the sides of the wall cross.
WallShape parseWall(const ConfigReader& reader);

/// The same as YAML on one line, read back to the same bits.
std::string wallText(const WallShape& wall);

/// The straight parts of a wall: the corners of each. Two that follow each other share the four
/// corners between them, to the bit.
std::vector<PointsShape> straightParts(const WallShape& wall);

}  // namespace hovercraft
