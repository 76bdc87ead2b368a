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

/// How exactly assimp keeps a coordinate of a mesh file, relative to it (-): single precision
/// (6e-8) and the rounding of its number parser; the worst of 90,000 random numbers was 1.6e-7.
constexpr double kMeshCoordinate = 2e-7;

/// How well the volume of a mesh must be known for its mass properties to be of use (-): thin or
/// far-off meshes lose it to the rounding of coordinates.
constexpr double kMeshVolume = 0.01;

/// Relative distance (-) from a whole number of nanoseconds at which a duration still counts as
/// whole: a decimal such as 0.001 s is no binary fraction, and its double is off by up to 1.1e-16.
constexpr double kNanosecondSlack = 1e-14;

/// Longest duration (ns) that a scenario may name, 11.6 days: a double still tells its nanoseconds
/// apart.
constexpr double kMaxNanoseconds = 1e15;

/// Distance (N) from its demand below which a lagging thrust has arrived: without a bound it would
/// end among the denormal numbers, which processors multiply a hundred times slower.
constexpr double kSettledThrust = 1e-100;

}  // namespace hovercraft
