#pragma once

#include <string>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/sim/simulation.h"

/// The air's part of a snapshot: the mean wind and what gusts remember.

namespace hovercraft {

/// The keys `wind` and `gusts`; empty where the air is what the scenario says for ever.
std::string airText(const Scenario& scenario, const SimulationState& state);

/// @param reader of a snapshot. @throws std::invalid_argument with key path and rule.
void parseAirState(const ConfigReader& reader, const Scenario& scenario, SimulationState& state);

/// @throws std::invalid_argument if a body would meet a wind that is not finite.
void checkAir(const ConfigReader& reader, const Simulation& simulation);

}  // namespace hovercraft
