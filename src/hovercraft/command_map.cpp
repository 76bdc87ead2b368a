#include "hovercraft_sim/hovercraft/command_map.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/floating_point_environment.h"

namespace hovercraft {
namespace {

double interpolated(const std::vector<ThrustKnot>& table, double command) {
  const auto above =
      std::upper_bound(table.begin(), table.end(), command,
                       [](double value, const ThrustKnot& knot) { return value < knot.command; });
  if (above == table.begin()) return above->thrust;
  const ThrustKnot& low = *(above - 1);
  if (above == table.end()) return low.thrust;
  const double share = (command - low.command) / (above->command - low.command);
  const double value = low.thrust + share * (above->thrust - low.thrust);
  const auto [least, most] = std::minmax(low.thrust, above->thrust);
  return std::clamp(value, least, most);
}

/// The command between two neighbours of a table that makes the level, or the nearest one to it.
double commandBetween(const ThrustKnot& low, const ThrustKnot& high, double level) {
  const double rise = high.thrust - low.thrust;
  if (rise == 0.0) return std::clamp(0.0, low.command, high.command);
  const double share = std::clamp((level - low.thrust) / rise, 0.0, 1.0);
  return std::clamp(low.command + share * (high.command - low.command), low.command, high.command);
}

}  // namespace

double CommandMap::levelOf(double command, double min, double max) const {
  if (!table.empty()) return interpolated(table, command);
  if (unit == CommandUnit::kLevel) return command;
  const double share = std::clamp(command, -1.0, 1.0);
  return share < 0.0 ? -share * min : share * max;
}

bool CommandMap::exceeds(double command, double min, double max) const {
  if (unit == CommandUnit::kNormalized && std::abs(command) > 1.0) return true;
  if (!table.empty() && (command < table.front().command || command > table.back().command)) {
    return true;
  }
  if (table.empty() && unit == CommandUnit::kNormalized) return false;
  const double level = levelOf(command, min, max);
  return level < min || level > max;
}

double CommandMap::commandOf(double level, double min, double max) const {
  const FloatingPointEnvironment environment;
  if (isPlain()) return level;
  const double wanted = std::clamp(level, min, max);
  if (table.empty()) {
    const double limit = wanted < 0.0 ? -min : max;
    return limit > 0.0 ? wanted / limit : 0.0;
  }
  double best = table.front().command;
  double best_error = std::abs(interpolated(table, best) - wanted);
  for (std::size_t i = 0; i + 1 < table.size(); ++i) {
    const double command = commandBetween(table[i], table[i + 1], wanted);
    const double error = std::abs(interpolated(table, command) - wanted);
    const bool is_nearer = std::abs(command) < std::abs(best);
    // What rounding leaves does not count against a command that is nearer to 0.
    const double slack = 1e-12 * std::abs(wanted);
    if (error + slack < best_error || (error <= best_error + slack && is_nearer)) {
      best = command;
      best_error = error;
    }
  }
  return best;
}

}  // namespace hovercraft
