#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// What a viewer may ask for (doc/web.md). Names of craft and actuators are not looked up yet.
struct DriveMessage {
  std::string craft;
  std::map<std::string, double> levels;  // N of an engine; else the unit of the actuator
};
struct SeatMessage {
  std::string craft;
  bool take = false;  // else leave
};
struct PauseMessage {
  bool paused = false;
};
struct StepMessage {
  std::uint32_t steps = 1;
};
struct ResetMessage {
  std::optional<std::int64_t> seed;  // none: that of the scenario
};
struct PaceMessage {
  double factor = 1.0;  // simulated per wall time; 0: as fast as it can
};
struct NameMessage {
  std::string name;
};
using ClientMessage = std::variant<DriveMessage, SeatMessage, PauseMessage, StepMessage,
                                   ResetMessage, PaceMessage, NameMessage>;

/// B, of one message of a viewer.
constexpr std::size_t kMostMessageBytes = 4096;
/// Of one `step`.
constexpr double kMostStepsOfViewer = 100000;
/// B of UTF-8, of the name of a viewer.
constexpr std::size_t kMostNameBytes = 48;

/// @param text UTF-8, as it came. @returns nothing if it is not one of the messages above, to the
/// last key: a key too many is as wrong as one too few.
[[nodiscard]] HOVERCRAFT_PUBLIC std::optional<ClientMessage> parseClientMessage(
    std::string_view text);

}  // namespace hovercraft_ros
