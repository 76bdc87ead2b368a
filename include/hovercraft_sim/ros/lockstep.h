#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <ros/time.h>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// Who still owes a command before the world may go on: after the states of a stamp were published,
/// one ThrustCommand with that very stamp from every vehicle. What arrives when, and how often, no
/// longer matters to the result.
class HOVERCRAFT_PUBLIC Lockstep {
 public:
  explicit Lockstep(std::size_t vehicles) : owes_(vehicles, false) {}

  /// Every vehicle owes a command for the states of `stamp`.
  void await(const ros::Time& stamp);
  /// Nobody owes anything, as before the first period.
  void clear();

  /// Takes a vehicle's command, or says why not. @param stamp of its header; none: the topic has no
  /// stamp.
  /// @returns null if it was awaited, else the reason.
  const char* offer(std::size_t vehicle, const std::optional<ros::Time>& stamp);

  /// The first vehicle, in the order of the scenario, whose command is awaited.
  [[nodiscard]] std::optional<std::size_t> awaited() const;

 private:
  ros::Time stamp_;
  std::vector<bool> owes_;
};

}  // namespace hovercraft_ros
