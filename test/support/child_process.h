#pragma once

#include <string>
#include <sys/types.h>
#include <vector>

namespace hovercraft_ros::testing {

/// A program that runs beside a test. It is interrupted and waited for when this goes out of scope,
/// so none is left behind.
class ChildProcess {
 public:
  /// @param command program, found on PATH, and its arguments.
  /// @throws std::runtime_error if it cannot be started.
  explicit ChildProcess(const std::vector<std::string>& command);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();

  /// Does nothing once it has ended.
  void signal(int number) const;

  bool hasEnded();
  /// Of a program that has ended: its exit status, or 128 + the signal that ended it.
  int exitStatus() const { return exit_status_; }

 private:
  std::string name_;
  pid_t pid_ = 0;  // 0 once it was waited for
  int exit_status_ = 0;
};

}  // namespace hovercraft_ros::testing
