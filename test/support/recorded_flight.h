#pragma once

#include <string>
#include <vector>

#include "child_process.h"
#include "recording.h"
#include "temporary_folder.h"

namespace hovercraft_ros::testing {

constexpr const char* kSimulationNode = "/hovercraft_sim";
constexpr const char* kScenarioTopic = "/hovercraft_sim/scenario";

/// Everything that the simulation publishes about these craft, and about itself; full names.
std::vector<std::string> outputTopics(const std::vector<std::string>& vehicles);

/// A flight that rosbag record writes down, from the moment at which it is connected to every
/// publisher until finish(). The bag lies in a folder of its own and is deleted with this.
class RecordedFlight {
 public:
  /// Starts rosbag record and returns when nothing that is published from now on can be missed.
  /// @param topics full names. Each that has a publisher by now is waited for, and each of the
  /// simulation's must have one.
  explicit RecordedFlight(const std::vector<std::string>& topics);
  RecordedFlight(const RecordedFlight&) = delete;
  RecordedFlight& operator=(const RecordedFlight&) = delete;

  /// Stops rosbag record once it has everything that the simulation has sent by now.
  Recording finish();

  const std::string& bagPath() const { return path_; }

 private:
  TemporaryFolder folder_;
  std::string path_;
  std::string recorder_name_;
  ChildProcess recorder_;
};

}  // namespace hovercraft_ros::testing
