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

/// Height (-, of the greatest coordinate) up to which a vertex of a polyhedron counts as in the
/// plane of a face: rounding of rotated coordinates is some 1e-16, and no error of a distance may
/// pass 1e-12 of the size.
constexpr double kPlanarSlack = 1e-13;

/// Dent (-, of the greatest coordinate) up to which a mesh counts as convex: what the error of the
/// coordinates that were read from a file makes of the height of a vertex over three others.
constexpr double kMeshDentSlack = 4.0 * kMeshCoordinate;

/// Sine of the angle (-) by which a direction may leave a Voronoi region and still count as on its
/// boundary: a hundred roundings of a unit vector. Between two features that are as parallel as
/// this the distance differs by no more than 2e-14 of their length.
constexpr double kVoronoiSlack = 2e-14;

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

/// Bound on the number of queries in one search for a time of impact. Each step of the search
/// closes a fixed share of the gap at least; ten to a hundred are usual.
constexpr int kMaxImpactQueries = 10000;

/// Sine of the angle (-) between a face and the line of the closest points up to which the whole
/// face counts as in contact: over a metre it hides 1 mm, and the points beyond the band of gaps
/// are left out one by one.
constexpr double kFaceAlignment = 1e-3;

/// Sine of the turn (-) below which a corner of a common area is none: over half a side of 0.2 m it
/// hides 0.1 mm.
constexpr double kFlatCorner = 1e-3;

/// Distance (-, of the size of the bodies) up to which two points of contact are one: sides that
/// coincide but for a small angle are cut twice near each corner.
constexpr double kSamePoint = 1e-3;

/// Speed (-, of the fastest point) below which a point of contact stands still: what the rounding
/// of an impact leaves, a thousand units in the last place.
constexpr double kStandingPoint = 1e-13;

/// Change of a velocity (-, of the fastest point) in one sweep at which an impact is solved: a few
/// units in the last place.
constexpr double kImpactResidual = 1e-15;

/// Bound on how often a point is relaxed in one round of an impact, all points together: four
/// points of a face need some hundred each, nearly dependent ones ten thousand.
constexpr int kMaxImpactRelaxations = 80000;

/// Sweeps (-) that an impact of many points gets in any case.
constexpr int kMinImpactSweeps = 50;

/// Bound on the rounds of one impact, after which it is plastic. Two points of one body need two or
/// three.
constexpr int kMaxImpactRounds = 16;

/// Bound on how often the restitution of a round that gains energy is halved; then it is 0.
constexpr int kMaxHalvedRestitutions = 8;

/// Gap (-, of the contact tolerance) that resting bodies keep and at which an impact is found: as
/// far from overlap as from losing touch.
constexpr double kRestGap = 0.5;

/// Distance (-, of the contact tolerance) beyond which a resting contact is over: far enough that
/// the noise of a stack does not end it.
constexpr double kLostContact = 10.0;

/// Share (-) of a missing gap that a resting contact makes up for in a step: the rest comes in the
/// steps that follow, so that the push is no bounce.
constexpr double kGapRecovery = 0.2;

/// Speed (m/s) up to which points of an elastic pair stand still: what solving to kRestResidual
/// leaves, which must not be taken for a bounce.
constexpr double kStillSpeed = 1e-9;

/// Share (-) of the rest gap that what is left unsolved of a resting contact may take in a step:
/// the recovery of the gap makes up for it.
constexpr double kRestResidual = 0.01;

/// Share (-) of the rest gap up to which the approach of a resting pair may eat into it in a step
/// without being an impact: the force over the step stops it.
constexpr double kRestApproach = 0.2;

/// Least sweeps (-) of resting contacts: from step to step they bring a stack to its exact forces.
constexpr int kLeastRestSweeps = 4;

/// Number of points from which on an impact is solved only to kCrowdResidual (-, of the fastest
/// point): what is left of it is taken up by the resting contacts of the crowd.
constexpr std::size_t kCrowd = 40;
constexpr double kCrowdResidual = 1e-5;

/// Bound on how often a point is relaxed in one solve of resting contacts, all points together. The
/// solve starts from the forces of the last step, so that a stack at rest needs a sweep or two; a
/// stack of ten that was never solved needs a thousand.
constexpr int kMaxRestRelaxations = 40000;

/// Sweeps (-) that resting contacts of many points get in any case.
constexpr int kMinRestSweeps = 30;

/// Gap (-, of the contact tolerance) below which a resting contact is repaired: as long as there is
/// more, the solver brings it back by itself.
constexpr double kLeastRestGap = 0.1;

/// Gap (-, of the contact tolerance) up to which a repair moves a pair.
constexpr double kFairRestGap = 0.4;

/// Bound on the sweeps of a repair: the height of a stack squared, for ten bodies.
constexpr int kMaxRepairSweeps = 100;

/// Bounces of a pair in one step after which it is plastic: the sum of what would follow is shorter
/// than the step (Zeno).
constexpr int kMaxBounces = 8;

/// Bound on the events of a step, of an island without pairs and for each pair, after which all is
/// plastic; after twice as many the rest of the step is left out.
constexpr int kMaxEvents = 32;
constexpr int kMaxEventsPerPair = 2;

/// Bound on how often a piece of a step is cut to the time of impact until the integrator's own
/// path is clear; each cut shortens the piece's curve by the cube of its length.
constexpr int kMaxCuts = 10;

/// Distance (N) from its demand below which a lagging thrust has arrived: without a bound it would
/// end among the denormal numbers, which processors multiply a hundred times slower.
constexpr double kSettledThrust = 1e-100;

}  // namespace hovercraft
