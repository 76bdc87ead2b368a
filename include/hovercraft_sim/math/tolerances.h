#pragma once

#include <cstddef>

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
/// round to either side; six digits leave this much.
constexpr double kInertiaSlack = 1e-5;

/// Smallest principal moment relative to the largest (-) that is told from 0: an eigenvalue is
/// exact to a few units in the last place of the largest one.
constexpr double kSingularInertia = 1e-14;

/// How exactly a mesh file says where a vertex was meant to be, relative to the greatest coordinate
/// (-): exporters compute in single precision (6e-8), and some print six or seven digits of that.
constexpr double kMeshCoordinate = 2e-7;

/// Rounding of a number to single precision, as binary STL has it, relative to it (-): 2^-24.
constexpr double kSingleRounding = 5.97e-8;

/// What rounding makes of a sum of products of coordinates, relative to the greatest of these (-):
/// some nine roundings of 1.1e-16.
constexpr double kDoubleRounding = 1e-15;

/// How far apart (-, of the longest edge of the box around a mesh, along each axis) two vertices on
/// open edges may lie that were meant to be one: a unit of the sixth digit of a coordinate, the
/// fewest that exporters print.
constexpr double kWeldDistance = 1e-5;

/// Greatest coordinate (m) of a mesh: the fifth powers that its inertia is summed of stay far below
/// the largest double, 1.8e308.
constexpr double kMostMeshCoordinate = 1e50;

/// Most shells of a mesh: each is compared with all others, some seconds for so many.
constexpr std::size_t kMostShells = 20000;

/// Greatest length (bytes) of a mesh file, some five million triangles of binary STL: what is made
/// of it in memory takes some ten times as much.
constexpr std::size_t kMostMeshBytes = 256U << 20U;

/// How well the volume of a mesh must be known for its mass properties to be of use (-): thin or
/// far-off meshes lose it to the rounding of coordinates.
constexpr double kMeshVolume = 0.01;

/// Relative distance (-) from a whole number of nanoseconds at which a duration still counts as
/// whole: a decimal such as 0.001 s is no binary fraction, and its double is off by up to 1.1e-16.
constexpr double kNanosecondSlack = 1e-14;

/// Longest duration (ns) that a scenario may name, 11.6 days: a double still tells its nanoseconds
/// apart.
constexpr double kMaxNanoseconds = 1e15;

/// Height (-, of the greatest coordinate) up to which a vertex of a polyhedron counts as in the
/// plane of a face: rounding of rotated coordinates is some 1e-16, and no error of a distance may
/// pass 1e-12 of the size.
constexpr double kPlanarSlack = 1e-13;

/// Area of a face relative to the products of its sides (-) below which its normal takes more than
/// a double: three roundings of 1.1e-16 of each product then tilt it by a tenth of kPlanarSlack.
constexpr double kSliver = 0.03;

/// Dent (-, of the greatest coordinate) up to which a mesh counts as convex, in the mean over the
/// surface of its hull: what the error of the coordinates that were read from a file makes of the
/// height of a vertex over three others.
constexpr double kMeshDentSlack = 4.0 * kMeshCoordinate;

/// The same for the deepest place: a cube of 1 m (greatest coordinate 0.87 m) that is turned and
/// printed with six decimals has dents of up to 1.7e-6 m, as each coordinate moves by up to 5e-7 m.
constexpr double kMeshDentDepth = 3.0 * kMeshDentSlack;

/// Sine of the angle (-) by which a direction may leave a Voronoi region and still count as on its
/// boundary: a hundred roundings of a unit vector. Between two features that are as parallel as
/// this the distance differs by no more than 2e-14 of their length.
constexpr double kVoronoiSlack = 2e-14;

/// Difference (-, of the largest there can be) below which neighbours in a long loop of edges count
/// as level: some hundred roundings, and still far below what two corners of a million make.
constexpr double kLevelLoop = 1e-13;

/// Rounding (-, of the sum of all coordinates) of the difference of two points in one frame: each
/// coordinate is a sum of four terms, eight roundings of 1.1e-16 bound it.
constexpr double kPointRounding = 8e-16;

/// Distance (-, of the sum of all coordinates) up to which two bodies touch: what rounding leaves
/// of the sign.
constexpr double kTouchingDistance = 4e-15;

/// Overlap (-, of the sum of all coordinates) up to which two bodies whose features met count as
/// touching: the sum over ten such roundings.
constexpr double kTouchingOverlap = 4e-14;

/// Square of the sine of the angle (-) below which two edges are taken as parallel: their common
/// perpendicular is lost in rounding.
constexpr double kParallelEdges = 1e-26;

/// The same in numbers of 106 bits.
constexpr double kPreciseParallelEdges = 1e-56;

/// Square of the sine of the angle (-) between two edges from which on their cross product gives
/// the direction of the distance better than the difference of the witness points.
constexpr double kCrossingEdges = 1e-4;

/// Bound on the number of queries in one search for a time of impact: seven are usual. A body that
/// spins across the normal a hair's breadth from another one for a thousand radii is what needs
/// more.
constexpr int kMaxImpactQueries = 10000;

/// How far a saved orientation may be from a rotation (-): a step leaves some 1e-15, and the text
/// of a snapshot loses nothing. The closest features rest on rotations that are orthonormal to
/// rounding.
constexpr double kSavedRotation = 1e-12;

/// Greatest coordinate (m) of a body, and the farthest that a point of one may come in a step where
/// bodies meet: the tenth power is still a double, so that no product of lengths and speeds is
/// infinite. The universe that can be seen has 1e27 m.
constexpr double kFarthest = 1e30;

/// Distance (N) from its demand below which a lagging thrust has arrived: without a bound it would
/// end among the denormal numbers, which processors multiply a hundred times slower.
constexpr double kSettledThrust = 1e-100;

/// Momentum (kg m/s, kg m^2/s) below which a component counts as gone, for the same reason: drag
/// lets it decay for ever, and its square must not be a denormal number either.
constexpr double kSettledMomentum = 1e-100;

}  // namespace hovercraft
