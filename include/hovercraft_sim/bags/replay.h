#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hovercraft_sim/bags/recording_observer.h"
#include "hovercraft_sim/bags/recording_reader.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros {

/// Where a replay and its recording part: the first state, and its first field in the order of
/// State.msg.
struct ReplayDifference {
  RunTime time;          // of the state
  std::string vehicle;   // name
  std::string field;     // name in State.msg
  std::string recorded;  // to the last bit
  std::string replayed;  // likewise
};

struct ReplayResult {
  std::optional<ReplayDifference> difference;  // none: it is the same
  std::uint64_t compared_states = 0;           // states that were held against the recording
  std::uint64_t compared_samples = 0;          // messages of sensors
  hovercraft::Tick simulated_ticks = 0;        // steps that were made
  std::uint64_t hash = 0;                      // Simulation::hash() at the end
  /// Of a position, m, and where it is. Of a recording of this physics version it is 0 up to the
  /// difference, which ends the replay; one of an older version is replayed to its end.
  double largest_error = 0.0;
  RunTime largest_error_time;         // of the state that it is of
  std::string largest_error_vehicle;  // name
  /// States that rest on something that the recording lacks (Recording::gaps).
  std::uint64_t unknown_states = 0;
};

/// Runs again what a recording holds, commands and events at their ticks, and compares every
/// recorded state, and message of a sensor, bit for bit until the first difference or the first
/// gap.
/// @param scenario that it runs in; that of the recording, or another one to see what would have
/// been; a snapshot that was loaded then gives it the motion, not the momenta.
/// @param observer null: nobody is told.
/// @throws std::invalid_argument that names the recording and the event if one does not fit the
/// scenario.
HOVERCRAFT_PUBLIC ReplayResult replay(const Recording& recording,
                                      const hovercraft::Scenario& scenario, bool compares,
                                      RecordingObserver* observer = nullptr);

/// What the tool `replay` was asked for.
struct ReplayRequest {
  std::string bag;                      // its path
  std::string output;                   // a bag to write anew, or empty
  std::vector<std::string> sets;        // KEY.PATH=VALUE: withOverrides()
  std::string truth_odom = kOdomTopic;  // in the output, the topic of the true odometry
};

/// Replays a bag and says in one line what came of it.
/// @returns 0 identical, or the scenario was changed and there is nothing to compare; 1 different;
/// 2 not all can be checked, or different from what an older physics version recorded: the verdict
/// says so, with the first difference and the largest error.
/// @throws std::invalid_argument for whatever in the request or the bag is bad.
HOVERCRAFT_PUBLIC int replayBag(const ReplayRequest& request, std::string& verdict);

}  // namespace hovercraft_ros
