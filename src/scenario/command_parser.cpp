#include "hovercraft_sim/scenario/command_parser.h"

#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <vector>

#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

constexpr std::size_t kMostKnots = 1000;
constexpr const char* kNormalized = "normalized";

bool isNormalized(const CommandMap& map) {
  return map.unit == CommandUnit::kNormalized;
}

void checkCommand(const ConfigReader& reader, const std::vector<double>& commands, std::size_t i,
                  bool is_normalized) {
  if (i > 0 && !(commands[i] > commands[i - 1])) {
    reader.fail("command", fmt::format("must rise strictly ({} stands after {})",
                                       yamlNumber(commands[i]), yamlNumber(commands[i - 1])));
  }
  if (is_normalized && std::abs(commands[i]) > 1.0) {
    reader.fail("command", "must be -1 to 1, as command is normalized");
  }
}

std::vector<ThrustKnot> parseTable(const ConfigReader& reader, bool is_normalized) {
  reader.allowOnly({"command", "thrust"});
  const std::vector<double> commands = reader.numbers("command", kMostKnots);
  const std::vector<double> thrusts = reader.numbers("thrust", kMostKnots);
  if (commands.size() < 2) reader.fail("command", "must be two numbers or more");
  if (thrusts.size() != commands.size()) {
    reader.fail("thrust",
                fmt::format("must be as many numbers as of command, {}", commands.size()));
  }
  std::vector<ThrustKnot> table;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    checkCommand(reader, commands, i, is_normalized);
    // Differences of what is in a table must be finite.
    if (std::abs(commands[i]) > kFarthest || std::abs(thrusts[i]) > kFarthest) {
      reader.fail(std::abs(thrusts[i]) > kFarthest ? "thrust" : "command",
                  "must be at most 1e30, of either sign");
    }
    table.push_back({commands[i], thrusts[i]});
  }
  return table;
}

std::string listText(const std::vector<ThrustKnot>& table, double ThrustKnot::*number) {
  std::string text;
  for (const ThrustKnot& knot : table) {
    text += (text.empty() ? "" : ", ") + yamlNumber(knot.*number);
  }
  return "[" + text + "]";
}

}  // namespace

CommandMap parseCommandMap(const ConfigReader& reader, const char* unit, bool has_thrust) {
  CommandMap map;
  map.unit = static_cast<CommandUnit>(reader.choiceOr(0, "command", {unit, kNormalized}));
  if (has_thrust && reader.has("thrust_table")) {
    map.table = parseTable(reader.map("thrust_table"), isNormalized(map));
  }
  return map;
}

std::string commandMapYaml(const CommandMap& map, const char* unit) {
  std::string yaml = fmt::format(", command: {}", isNormalized(map) ? kNormalized : unit);
  if (map.table.empty()) return yaml;
  return yaml + fmt::format(", thrust_table: {{command: {}, thrust: {}}}",
                            listText(map.table, &ThrustKnot::command),
                            listText(map.table, &ThrustKnot::thrust));
}

}  // namespace hovercraft
