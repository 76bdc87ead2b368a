#pragma once

#include <vector>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/world/world.h"

/// What contacts remember, as a snapshot has it.

namespace hovercraft {

/// The key `contacts`: of pairs in the order in which a step looks for them.
/// @param reader of a snapshot. @param world null if the scenario has none.
/// @throws std::invalid_argument with key path and rule.
std::vector<ContactCache> parseContactCaches(const ConfigReader& reader, const World* world);

}  // namespace hovercraft
