#pragma once

#include <optional>

#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/sim/command_log.h"

namespace hovercraft {

/// Where the commands of a run come from: one by one, so that a long run needs no more memory than
/// a short one.
class CommandSource {
 public:
  CommandSource() = default;
  CommandSource(const CommandSource&) = delete;
  CommandSource& operator=(const CommandSource&) = delete;
  virtual ~CommandSource() = default;

  /// The next command, none before the tick of the last one; nothing when there are no more.
  /// @throws std::invalid_argument that names file, place and rule if what comes next is bad.
  [[nodiscard]] virtual std::optional<Command> next() = 0;
};

/// Nobody commands anything.
class NoCommands : public CommandSource {
 public:
  [[nodiscard]] std::optional<Command> next() override { return std::nullopt; }
};

/// The first tick at or after a time: ceil(time / step).
/// @param time_ns ns, 0 or greater. @param step_ns ns, greater than 0.
constexpr Tick firstTickAt(std::int64_t time_ns, std::int64_t step_ns) {
  return time_ns / step_ns + (time_ns % step_ns > 0 ? 1 : 0);
}

}  // namespace hovercraft
