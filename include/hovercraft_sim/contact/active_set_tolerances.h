#pragma once

#include <cstddef>

/// Tolerances and bounds of active sets (ContactSolver), with their units and reasons.

namespace hovercraft {

/// Weight (-) of what the velocities of an active set miss, against the length of the change: each
/// turn of the method of multipliers makes the miss smaller by about this times the least
/// eigenvalue of the rows, and its roundings larger by as much. With three turns a part of 1e-8 is
/// left.
constexpr double kEqualityPenalty = 1e8;
constexpr int kEqualityTurns = 3;

/// That part (-): less than it of what its points stop is not asked of an active set, or a stack at
/// steps of 50 ms would be solved anew without end.
constexpr double kActiveSetRounding = 1e-8;

/// Sweeps (-) before an active set is guessed from them, and between two guesses: the least that
/// resting contacts get in any case.
constexpr int kSweepsBeforeActiveSet = 4;

/// Sweeps (-) between two guesses from which on it is left to the sweeps: each guess that comes to
/// no end doubles them.
constexpr int kLongestWait = 16;

/// What an active set may leave of resting contacts (-, of what sweeps may leave).
constexpr double kActiveSetResidual = 1e-3;

/// What it may leave of an impact (-, of the fastest point); the last places are for the sweeps.
constexpr double kActiveSetPrecision = 1e-9;

/// Moving bodies (-) from which on it is tried: a craft that slides keeps the forces of its last
/// step, as those of many points of one body are not unique.
constexpr std::ptrdiff_t kLeastActiveBodies = 3;

/// Share (-) of the bound of friction up to which a point is guessed to stick.
constexpr double kStuckShare = 0.999;

/// Bound on the corrections of a guess.
constexpr int kMaxActiveSets = 8;

/// Products of blocks (-, of the points) that an active set may take. 27 cubes in a cube are beyond
/// it: a step of them took 9.1 ms with 20, and 2.4 ms with 4, as no guess came to an end.
constexpr std::size_t kMostActiveSetWork = 4;

}  // namespace hovercraft
