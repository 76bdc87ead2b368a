#pragma once

/// Every tolerance of the library, with its unit and its reason.

namespace hovercraft {

/// Orthogonality error (-) from which one step of Newton's polar iteration reaches rounding: 1e-8
/// squared = 1e-16.
constexpr double kPolarLastStep = 1e-8;

/// Bound on Newton's polar iteration; from an error of 1 it needs six, from 1e3 about sixteen.
constexpr int kMaxPolarIterations = 60;

/// |length - 1| (-) that a direction given by a user may have: what six printed digits leave.
constexpr double kUnitLength = 1e-6;

/// Relative slack (-) of the checks on an inertia tensor given by a user: symmetric entries,
/// triangle inequality. Flat bodies meet the inequality with equality, and their printed entries
/// round to either side.
constexpr double kInertiaSlack = 1e-9;

/// Smallest principal moment relative to the largest (-) that is told from 0: an eigenvalue is
/// exact to a few units in the last place of the largest one.
constexpr double kSingularInertia = 1e-14;

/// Half a unit in the last place of single precision (-), 2^-24: how exactly assimp keeps a
/// coordinate of a mesh file.
constexpr double kSinglePrecision = 5.9604644775390625e-8;

/// Relative distance (-) from a whole number of nanoseconds at which a duration still counts as
/// whole: a decimal such as 0.001 s is no binary fraction, and its double is off by up to 1.1e-16
/// of its value.
constexpr double kNanosecondSlack = 1e-14;

/// Longest duration (ns) that a scenario may name, 11.6 days: a double still tells its nanoseconds
/// apart.
constexpr double kMaxNanoseconds = 1e15;

}  // namespace hovercraft
