#pragma once

#include <dlfcn.h>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "hovercraft_sim/records/simulate.h"

namespace hovercraft {

/// Loads libhovercraft_ros when something of it is asked for: for tools that mostly need no ROS, as
/// to load its libraries takes longer than a short run. All of it is inline, so that the library is
/// found where the program finds those that it is linked with.
class LateRosFiles : public RosFiles {
 public:
  /// @param library its file's name, as linkers write it into programs; empty: the program has it
  /// in itself.
  explicit LateRosFiles(std::string library) : library_(std::move(library)) {}

  std::string packagePath(const std::string& package) override {
    return loaded().packagePath(package);
  }
  std::unique_ptr<CommandSource> openCommands(const std::string& path,
                                              const Scenario& scenario) override {
    return loaded().openCommands(path, scenario);
  }
  std::unique_ptr<RunObserver> openOutput(const std::string& path, const Scenario& scenario,
                                          const std::string& truth_odom) override {
    return loaded().openOutput(path, scenario, truth_odom);
  }
  void checkTruthOdom(const std::string& topic) override { loaded().checkTruthOdom(topic); }

 private:
  /// Found as if the program were linked with it, and never unloaded: what came from it may outlive
  /// this.
  RosFiles& loaded() {
    if (files_ != nullptr) return *files_;
    void* const library =
        dlopen(library_.empty() ? nullptr : library_.c_str(), RTLD_NOW | RTLD_GLOBAL);
    if (library == nullptr) fail();
    void* const symbol = dlsym(library, "hovercraftRosFiles");
    if (symbol == nullptr) fail();
    using Files = RosFiles* (*)();
    files_ = reinterpret_cast<Files>(symbol)();  // NOLINT: as POSIX has it
    return *files_;
  }
  [[noreturn]] void fail() const {
    const char* const error = dlerror();
    throw std::runtime_error("bags and package:// need " + library_ + ": " +
                             (error == nullptr ? "it cannot be loaded" : error));
  }

  std::string library_;
  RosFiles* files_ = nullptr;
};

}  // namespace hovercraft
