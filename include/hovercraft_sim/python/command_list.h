#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/command_source.h"

namespace hovercraft_python {

/// Commands that are all there before a run begins.
class CommandList : public hovercraft::CommandSource {
 public:
  /// @param commands in the order of their ticks.
  explicit CommandList(std::vector<hovercraft::Command> commands);
  [[nodiscard]] std::optional<hovercraft::Command> next() override;

 private:
  std::vector<hovercraft::Command> commands_;
  std::size_t next_ = 0;
};

/// A table of commands for one craft: a row each.
struct CommandTable {
  std::string vehicle;             // empty: the only one
  std::vector<std::string> names;  // of engines and other actuators, one a column
  std::vector<double> times;       // s, one a row, >= 0, never decreasing
  std::vector<double> values;      // row by row: N, or the level of another actuator
};

/// @throws std::invalid_argument that names the vehicle and the rule: also if the name is empty
/// and there are several.
std::size_t craftIndex(const hovercraft::Scenario& scenario, const std::string& name);

/// @returns seconds to whole nanoseconds, as the shortest text of the number would be read.
/// @throws std::invalid_argument that names what it is, for a time that is not finite, negative or
/// beyond the longest run.
std::int64_t nanosecondsOf(const std::string& what, double seconds);

/// The commands of several tables in the order of their ticks; of one tick in that of the tables.
/// @throws std::invalid_argument that names column, row and rule.
std::vector<hovercraft::Command> commandsOf(const std::vector<CommandTable>& tables,
                                            const hovercraft::Scenario& scenario);

/// All that a source has. @throws std::invalid_argument as it does.
std::vector<hovercraft::Command> allOf(hovercraft::CommandSource& source);

}  // namespace hovercraft_python
