#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/math/time.h"

namespace hovercraft::testing {

/// The ticks whose hashes are recorded: the first says whether reading and set-up differ, the
/// others where the motion does.
constexpr std::array<Tick, 4> kCheckpoints = {0, 100, 10000, 100000};
constexpr Tick kLastTick = kCheckpoints.back();
using CheckpointHashes = std::array<std::uint64_t, kCheckpoints.size()>;

/// One run of a scenario by one stepper, and the hashes that it had where it was recorded.
struct RecordedRun {
  std::string scenario;     // NAME of scenarios/NAME.yaml
  std::string integrator;   // as in the file; it takes the place of what stands there
  std::string orientation;  // likewise
  CheckpointHashes hashes;
};

/// The runs of `folder`/hashes.txt: lines of scenario, integrator, orientation and one hash for
/// each checkpoint; # begins a comment.
/// @throws std::invalid_argument that names the line.
std::vector<RecordedRun> readRecordedRuns(const std::string& folder);

/// The text of hashes.txt with these runs.
std::string textOf(const std::vector<RecordedRun>& runs);

/// Flies the run again: commands to single and to all engines, with gaps longer than their
/// time-outs, and pushes; all of them drawn from one seed by integer arithmetic.
/// @param last_tick checkpoints after it are left out.
/// @returns the hashes at the checkpoints up to there.
std::vector<std::uint64_t> fly(const std::string& folder, const RecordedRun& run, Tick last_tick);

/// Whether the bodies of the run can meet: its scenario has a world.
bool hasContact(const std::string& folder, const RecordedRun& run);

/// In words, the first checkpoint at which the hashes differ; empty if none does.
std::string firstDifference(const RecordedRun& run, const std::vector<std::uint64_t>& flown);

}  // namespace hovercraft::testing
