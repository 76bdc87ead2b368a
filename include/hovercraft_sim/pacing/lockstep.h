#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// Who still owes a command before the world may go on: after the states of a stamp were published,
/// one ThrustCommand with that very stamp from every vehicle. What arrives when, and how often, no
/// longer matters to the result.
class HOVERCRAFT_PUBLIC Lockstep {
 public:
  explicit Lockstep(std::size_t vehicles) : owes_(vehicles, false) {}

  /// Every vehicle owes a command for the states of this stamp, ns.
  void await(std::int64_t stamp_ns);
  /// Nobody owes anything, as before the first period.
  void clear();

  /// Takes a vehicle's command, or says why not. @param stamp_ns of its header; none: the topic has
  /// no stamp.
  /// @returns null if it was awaited, else the reason.
  const char* offer(std::size_t vehicle, std::optional<std::int64_t> stamp_ns);

  /// The first vehicle, in the order of the scenario, whose command is awaited.
  [[nodiscard]] std::optional<std::size_t> awaited() const;

 private:
  std::int64_t stamp_ns_ = 0;
  std::vector<bool> owes_;
};

}  // namespace hovercraft
