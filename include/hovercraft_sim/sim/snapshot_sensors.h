#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/sim/simulation.h"

/// The sensors' part of a snapshot: what they remember, the samples on their way, and a hash.

namespace hovercraft {

/// The keys `sensor_hash` and `sensors`; empty if there are no sensors.
std::string sensorStatesText(const Simulation& simulation);

/// @param reader of a snapshot. @param tick of it. @param started a simulation of its scenario at
/// tick 0. @throws std::invalid_argument with key path and rule.
std::vector<SensorState> parseSensorStates(const ConfigReader& reader, Tick tick,
                                           const Simulation& started);

/// @throws std::invalid_argument if `sensor_hash` is not that of the simulation.
void checkSensorHash(const ConfigReader& reader, const Simulation& simulation);

}  // namespace hovercraft
