#pragma once

#include <cstdint>
#include <string>

#include <hovercraft_sim/ApplyWrench.h>
#include <hovercraft_sim/RunEvent.h>
#include <hovercraft_sim/SetActuator.h>
#include <hovercraft_sim/SetState.h>
#include <hovercraft_sim/SetWind.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/tf_frames.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/simulation.h"

/// What changes a run besides commands, as messages: made from a service call, applied by the node,
/// recorded, and applied again by a replay through the same function.

namespace hovercraft_ros {

/// Kinds of events that change what `name` says; no constant of RunEvent, whose checksum is that of
/// the recordings there are.
constexpr std::uint8_t kSetWind = 5;
constexpr std::uint8_t kSetActuator = 6;

HOVERCRAFT_PUBLIC hovercraft_sim::RunEvent resetEvent(std::int64_t seed);

/// @param snapshot as hovercraft::toSnapshot() wrote it; checked when the event is applied.
HOVERCRAFT_PUBLIC hovercraft_sim::RunEvent loadEvent(const std::string& snapshot);

/// @throws std::invalid_argument if the request names no vehicle, is not finite, its quaternion is
/// not of length 1, or the motion does not fit the model.
HOVERCRAFT_PUBLIC hovercraft_sim::RunEvent setStateEvent(
    const hovercraft::Scenario& scenario, const hovercraft_sim::SetState::Request& request);

/// @param tick at which the wrench begins. @param frames those that a request may name: the world,
/// or the craft's.
/// @throws std::invalid_argument if the request names no vehicle, no frame that fits, is not finite
/// or lasts no time.
HOVERCRAFT_PUBLIC hovercraft_sim::RunEvent applyWrenchEvent(
    const hovercraft::Scenario& scenario, const hovercraft_sim::ApplyWrench::Request& request,
    const TfFrames& frames, hovercraft::Tick tick);

/// Whether an event of kind kSetWind says a wind.
HOVERCRAFT_PUBLIC bool isWind(const hovercraft_sim::RunEvent& event);
constexpr const char* kWindRuleText =
    "wind: must be three finite numbers, and its speed at most 1e6 m/s";

/// @throws std::invalid_argument if it is none (kWindRuleText).
HOVERCRAFT_PUBLIC hovercraft_sim::RunEvent setWindEvent(
    const hovercraft_sim::SetWind::Request& request);

/// Whether an event of kind kSetActuator says faults of an actuator; of which one, applyEvent()
/// sees.
HOVERCRAFT_PUBLIC bool isFault(const hovercraft_sim::RunEvent& event);
constexpr const char* kFaultRuleText =
    "name, efficiency, stuck: must be an actuator, 0 to 1, and true or false";

/// @throws std::invalid_argument if the request names no vehicle, no actuator of it, or an
/// efficiency that is none.
HOVERCRAFT_PUBLIC hovercraft_sim::RunEvent setActuatorEvent(
    const hovercraft::Scenario& scenario, const hovercraft_sim::SetActuator::Request& request);

/// Changes the simulation as the event says, at its current tick.
/// @param may_be_older whether a snapshot of an older physics version is one: in a replay.
/// @throws std::invalid_argument if a snapshot does not fit the scenario, a motion has momenta or
/// an energy that are not finite, a wind is none, an actuator is not there, or an event is of no
/// known kind.
HOVERCRAFT_PUBLIC void applyEvent(const hovercraft_sim::RunEvent& event,
                                  hovercraft::Simulation& simulation, bool may_be_older = false);

}  // namespace hovercraft_ros
