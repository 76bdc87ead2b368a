#pragma once

#include <functional>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/config_node.h"
#include "hovercraft_sim/scenario/config_reader.h"

namespace hovercraft {

/// Craft that one fleet may have: more than a node can publish in real time, and few enough that
/// the scenario written out can be read again.
constexpr int kMostOfFleet = 1000;

/// The `vehicles` of a scenario with every fleet written out: craft FLEET_1, FLEET_2, ... that are
/// `like` one craft, each at its place. What is not written as a fleet stays as it is. The result
/// says in full what a user could have written, so that a fleet has the bits of the craft written
/// out.
/// @param vehicles the map behind that key. @param source named in errors.
/// @param check called with each description that stands behind `like`, at the path where the user
/// wrote it: what is wrong with it is said once and there, not of FLEET_1.
/// @throws std::invalid_argument with source, key path, value and rule.
HOVERCRAFT_PUBLIC ConfigNode
withFleetsWrittenOut(const ConfigNode& vehicles, const std::string& source,
                     const std::function<void(const ConfigReader&)>& check);

/// Whether a craft of the scenario is one of a fleet, but not its first.
HOVERCRAFT_PUBLIC bool isLaterOfFleet(const ConfigNode& vehicles, const std::string& craft);

}  // namespace hovercraft
