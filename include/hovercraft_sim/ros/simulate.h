#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/ros/vehicle_messages.h"
#include "hovercraft_sim/sim/command_source.h"
#include "hovercraft_sim/sim/overrides.h"
#include "hovercraft_sim/sim/run.h"
#include "hovercraft_sim/sim/scenario.h"

namespace hovercraft_ros {

/// A scenario file; package:// paths in it are found by rospack. @throws as loadScenario().
HOVERCRAFT_PUBLIC hovercraft::Scenario loadScenarioFile(
    const std::string& path, const hovercraft::OverrideList& overrides = {});

/// Commands from a CSV file or a bag, whichever the file is.
/// @throws std::invalid_argument, see CsvCommandSource and BagCommandSource.
HOVERCRAFT_PUBLIC std::unique_ptr<hovercraft::CommandSource> openCommands(
    const std::string& path, const hovercraft::Scenario& scenario);

/// A bag if the name ends in .bag; CSV if it ends in .csv or is `-` (the standard output).
/// @param truth_odom of a bag, see BagWriter.
/// @throws std::invalid_argument if it is neither, or cannot be opened for writing.
HOVERCRAFT_PUBLIC std::unique_ptr<hovercraft::StateSink> openOutput(
    const std::string& path, const hovercraft::Scenario& scenario,
    const std::string& truth_odom = kOdomTopic);

/// What the tool `simulate` was asked for.
struct SimulateRequest {
  std::string scenario;             // file
  std::vector<std::string> sets;    // KEY.PATH=VALUE: withOverrides()
  std::string commands;             // file; empty: nobody commands anything
  std::vector<std::string> pilots;  // files of manoeuvres, each for another craft
  std::string duration;   // decimal seconds; empty: until kAfterLastCommandNs after the last
  std::string output;     // as openOutput()
  std::string contacts;   // CSV file of contacts; empty: none
  std::string actuators;  // CSV file of engines and other actuators; empty: none
  std::string cushion;    // CSV file of the cells of cushions; empty: none
  std::string sensors;    // folder of CSV files, one a sensor; empty: none
  std::string truth_odom = kOdomTopic;  // in a bag, the topic of the true odometry
  hovercraft::Tick every = 1;           // ticks from one output to the next
  bool hold = false;                    // commands hold for ever: every time-out is 0
  bool shows_progress = false;          // a bar, while it runs
};
constexpr std::int64_t kAfterLastCommandNs = 1000000000;

/// Runs a scenario as fast as it goes. Says in `messages` which engines timed out, and at the end
/// what a step cost (without the output), how long it all took and the hash of the last state.
/// @throws std::invalid_argument for whatever in the request or its files is bad, and if the output
/// cannot be written.
HOVERCRAFT_PUBLIC hovercraft::RunSummary simulate(const SimulateRequest& request,
                                                  std::ostream& messages);

}  // namespace hovercraft_ros
