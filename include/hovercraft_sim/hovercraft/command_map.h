#pragma once

#include <cstddef>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// What the number of a command is: the level itself (N, or what the kind of the actuator says), or
/// a share of its limits.
enum class CommandUnit { kLevel, kNormalized };

/// A point of a thrust table.
struct ThrustKnot {
  double command = 0.0;  // in the unit of the commands
  double thrust = 0.0;   // N
};

/// From the command of an actuator to the level that it asks for: (28) of doc/craft.md. By default
/// they are the same number.
/// - kNormalized, u: u >= 0 -> u max, u < 0 -> |u| min; beyond +-1 as at +-1.
/// - A table: linear between its knots, held beyond the first and the last one; commands are in the
///   unit that is said.
/// The limits of the actuator hold afterwards.
struct HOVERCRAFT_PUBLIC CommandMap {
  CommandUnit unit = CommandUnit::kLevel;  // of the commands
  std::vector<ThrustKnot> table;           // none, or two or more of strictly rising commands

  /// Whether a command is the level.
  bool isPlain() const { return unit == CommandUnit::kLevel && table.empty(); }

  /// @param min,max limits of the level, <= 0 and >= 0. @returns the level, not held to them where
  /// the command is one.
  double levelOf(double command, double min, double max) const;

  /// Whether a command asks for more than there is: beyond the limits, +-1, or the table's ends.
  bool exceeds(double command, double min, double max) const;

  /// A command that asks for a level within the limits: of several the one that is nearest to 0; if
  /// there is none, one of the level nearest to it. Where a command is the level, that.
  double commandOf(double level, double min, double max) const;
};

}  // namespace hovercraft
