#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include <hovercraft_sim/ScheduleCommands.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/command_log.h"

namespace hovercraft_ros {

/// Commands that were handed over before their time. The run takes each just before the step of
/// its tick, as if it came then.
class HOVERCRAFT_PUBLIC CommandSchedule {
 public:
  void add(const std::vector<hovercraft::Command>& commands);
  void clear() { waiting_.clear(); }

  /// The next one with a tick of at most `tick`; those of one tick in the order in which they came.
  [[nodiscard]] std::optional<hovercraft::Command> takeDue(hovercraft::Tick tick);
  /// Tick of the next one.
  [[nodiscard]] std::optional<hovercraft::Tick> next() const;

 private:
  std::multimap<hovercraft::Tick, hovercraft::Command> waiting_;
};

/// The commands of a request. @param episode, tick where the run stands.
/// @throws std::invalid_argument if the vehicle is unknown, or a command is of another episode, in
/// the past, for no engine or not finite.
HOVERCRAFT_PUBLIC std::vector<hovercraft::Command> scheduledCommands(
    const hovercraft::Scenario& scenario, const hovercraft_sim::ScheduleCommands::Request& request,
    std::uint32_t episode, hovercraft::Tick tick);

}  // namespace hovercraft_ros
