#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <hovercraft_sim/RunEvent.h>
#include <hovercraft_sim/State.h>

#include "hovercraft_sim/bags/recorded_samples.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/scenario/version.h"
#include "hovercraft_sim/sim/command_log.h"

namespace hovercraft_ros {

/// A place in a run: ticks count anew in each episode.
struct RunTime {
  std::uint32_t episode = 0;  // 0 before the first reset or load
  hovercraft::Tick tick = 0;  // within the episode
};
/// By episode, then by tick.
inline bool operator<(const RunTime& a, const RunTime& b) {
  return a.episode != b.episode ? a.episode < b.episode : a.tick < b.tick;
}

/// Everything in a bag that a replay needs, each list in the order of the run.
struct Recording {
  struct RecordedCommand {
    RunTime time;                 // at which it took effect
    hovercraft::Command command;  // with that tick
  };
  struct RecordedState {
    RunTime time;                 // of the state
    std::size_t vehicle = 0;      // index into the scenario's vehicles
    hovercraft_sim::State state;  // as recorded
  };

  std::string source = "the recording";                        // for people: the file
  std::string scenario_text;                                   // as recorded on ~scenario
  hovercraft::Scenario scenario;                               // the same, parsed
  std::int64_t physics_version = hovercraft::kPhysicsVersion;  // that the states were computed by
  std::vector<RecordedCommand> commands;                       // that took effect
  /// Resets, loads and what else changed the run besides commands.
  std::vector<hovercraft_sim::RunEvent> events;
  std::vector<RecordedState> states;  // of all craft

  std::vector<RecordedSample> samples;  // of sensors, as they lie in the bag
  /// ROS time of tick 0 of each episode, ns.
  std::map<std::uint32_t, std::int64_t> epochs_ns;

  /// From its time on to the end of its episode, states rest on a command or an event that the bag
  /// lacks; `missing` says which. A reset or a load that is there makes all before it irrelevant.
  struct Gap {
    RunTime begin;        // the first time that it concerns
    std::string missing;  // for people: what
  };
  std::vector<Gap> gaps;  // one at most of an episode, in their order
  /// States that the bag lacks: they are fewer to compare, no more.
  std::uint64_t missing_states = 0;
};

/// Reads topics by their types: State, AppliedCommand, RunEvent, those of sensors, and the scenario
/// (std_msgs/String named .../scenario). Which commands and events are missing is seen from their
/// numbers, which each State repeats; which states, from header.seq, which a publisher counts up (a
/// bag of `simulate`, where all are 0, is whole).
/// @throws std::invalid_argument that names the file and what is wrong: no bag, no index, damaged,
/// no scenario, no state, a vehicle that the scenario lacks, more than one run; or topic, time and
/// rule of a message that cannot be (recorded_messages.h), such as a State whose stamp does not fit
/// its tick.
HOVERCRAFT_PUBLIC Recording readRecording(const std::string& path);

}  // namespace hovercraft_ros
