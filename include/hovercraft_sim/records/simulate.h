#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/overrides.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/command_source.h"
#include "hovercraft_sim/sim/run.h"

namespace hovercraft {

/// The topic of the true odometry in a bag, where nothing else is asked for.
constexpr const char* kDefaultTruthOdom = "odom";

/// What a run takes from ROS: bags and packages. A run of CSV files takes nothing, and then ROS
/// need not be loaded.
class RosFiles {
 public:
  RosFiles() = default;
  RosFiles(const RosFiles&) = delete;
  RosFiles& operator=(const RosFiles&) = delete;
  virtual ~RosFiles() = default;

  /// The folder of a package; empty if there is none.
  virtual std::string packagePath(const std::string& package) = 0;
  /// The commands of a bag. @throws std::invalid_argument if it is none, or they are bad.
  virtual std::unique_ptr<CommandSource> openCommands(const std::string& path,
                                                      const Scenario& scenario) = 0;
  /// A bag of a run. @throws std::invalid_argument if it cannot be opened for writing.
  virtual std::unique_ptr<RunObserver> openOutput(const std::string& path, const Scenario& scenario,
                                                  const std::string& truth_odom) = 0;
  /// @throws std::invalid_argument with the rule if it is no topic for the true odometry.
  virtual void checkTruthOdom(const std::string& topic) = 0;
};

/// A scenario file; package:// paths in it are those of `ros`. What is worth knowing is said on the
/// standard error. @throws as loadScenario().
HOVERCRAFT_PUBLIC Scenario loadScenarioFile(const std::string& path, const OverrideList& overrides,
                                            RosFiles& ros);

/// Commands from a CSV file or a bag, whichever the file is.
/// @throws std::invalid_argument, see CsvCommandSource and RosFiles.
HOVERCRAFT_PUBLIC std::unique_ptr<CommandSource> openCommands(const std::string& path,
                                                              const Scenario& scenario,
                                                              RosFiles& ros);

/// A bag if the name ends in .bag; CSV if it ends in .csv or is `-` (the standard output).
/// @param truth_odom of a bag, see BagWriter.
/// @throws std::invalid_argument if it is neither, or cannot be opened for writing.
HOVERCRAFT_PUBLIC std::unique_ptr<RunObserver> openOutput(const std::string& path,
                                                          const Scenario& scenario,
                                                          const std::string& truth_odom,
                                                          RosFiles& ros);

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
  std::string truth_odom = kDefaultTruthOdom;  // in a bag, the topic of the true odometry
  Tick every = 1;                              // ticks from one output to the next
  Tick actuators_every = 0;                    // of the file of actuators; 0: as every
  Tick cushion_every = 0;                      // of the file of cushions; 0: as every
  bool hold = false;                           // commands hold for ever: every time-out is 0
  bool shows_progress = false;                 // a bar, while it runs
};
/// ns that a run goes on after its last command, where no end is said.
constexpr std::int64_t kAfterLastCommandNs = 1000000000;

/// Runs a scenario as fast as it goes. Says in `messages` which engines timed out, and at the end
/// what a step cost (without the output), how long it all took and the hash of the last state.
/// @throws std::invalid_argument for whatever in the request or its files is bad, and if the output
/// cannot be written.
HOVERCRAFT_PUBLIC RunSummary simulate(const SimulateRequest& request, std::ostream& messages,
                                      RosFiles& ros);

}  // namespace hovercraft
