#pragma once

#include <memory>
#include <optional>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/command_source.h"

namespace hovercraft_ros {

/// Commands from a bag, of every vehicle of the scenario.
///
/// Where the bag holds `/<vehicle>/commands` of any vehicle (AppliedCommand, what a simulation
/// accepted), those are played at the ticks that they name. Else `/<vehicle>/thrust`
/// (ThrustCommand) and `/<vehicle>/thrust/rear`, `left`, `right` (Float64) are: each takes effect
/// at the first tick at or after the time from the first message of the bag to its own receipt.
class HOVERCRAFT_PUBLIC BagCommandSource : public hovercraft::CommandSource {
 public:
  /// @throws std::invalid_argument if the file is not a bag or has no command of a vehicle, or
  /// if something besides commands changed the run that it records (RunEvent): its first event.
  BagCommandSource(const std::string& path, const hovercraft::Scenario& scenario);
  ~BagCommandSource() override;

  [[nodiscard]] std::optional<hovercraft::Command> next() override;

  /// Which topics are played, for people.
  const std::string& description() const;

 private:
  class Streams;

  std::string path_;
  std::unique_ptr<Streams> streams_;
};

}  // namespace hovercraft_ros
