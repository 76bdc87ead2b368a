#pragma once

#include <cstddef>

/// Every tolerance and bound of contact and world, with its unit and its reason.

namespace hovercraft {

/// Sine of the angle (-) between a face and the line of the closest points up to which the whole
/// face counts as in contact: over a metre it hides 1 mm, and the points beyond the band of gaps
/// are left out one by one.
constexpr double kFaceAlignment = 1e-3;

/// Sine of the turn (-) below which a corner of a common area is none: over half a side of 0.2 m it
/// hides 0.1 mm.
constexpr double kFlatCorner = 1e-3;

/// Distance (-, of the size of the smaller body) up to which two points of contact are one: sides
/// that coincide but for a small angle are cut twice near each corner.
constexpr double kSamePoint = 2e-3;

/// What the least gap of the points of a face may have more (-) than the closest points; beyond it
/// they are one of the points too: it is where the bodies hit.
constexpr double kMissedGap = 0.25;

/// Bound on the faces and on the edges around a corner that are looked at for the side on which it
/// is entered: more than the corners of common solids have; those of a cone's tip beyond it are
/// nearly alike.
constexpr int kMostSidesAround = 32;

/// Distance (-, of the size of the first body) up to which a point of contact is one of the last
/// step's.
constexpr double kKnownPoint = 0.05;

/// Speed (-, of the fastest point) below which a point of contact stands still: what the rounding
/// of an impact leaves, a thousand units in the last place.
constexpr double kStandingPoint = 1e-13;

/// Change of a velocity (-, of the fastest point) in one sweep at which an impact is solved: a few
/// units in the last place.
constexpr double kImpactResidual = 1e-15;

/// Approach (-, of the residual) up to which an impact that was solved to it counts as over.
constexpr double kUnsolvedApproach = 10.0;

/// Energy (-, of the impulses times the fastest point's speed) up to which what a round adds is
/// rounding: a hit that does not slip adds nothing, and so a unit in the last place.
constexpr double kGainRounding = 1e-12;

/// Number of points from which on an impact is a crowd's.
constexpr std::size_t kCrowd = 40;

/// The residual of a crowd that bounces with friction: to the last places it would take hundreds of
/// sweeps a round.
constexpr double kCrowdResidual = 1e-5;

/// Where nothing bounces, the resting contacts of a crowd go on with what an impact leaves: it is
/// solved when no sweep changes more than this share (-) of the approach that they stop.
constexpr double kLeftResidual = 0.3;

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

/// Speed (m/s) up to which the approach of an elastic pair is rounding and no bounce, and what a
/// resting contact stops in a step is no load.
constexpr double kStillSpeed = 1e-9;

/// Share (-) of the rest gap that what is left unsolved of a resting contact may take in a step:
/// the recovery of the gap, a fifth of what is missing in each step, makes up for it. With 0.1
/// the heap of 100 boxes takes about the same time.
constexpr double kRestResidual = 0.03;

/// Share (-) of the rest gap up to which the approach of a resting pair may eat into it in a step
/// without being an impact: the force over the step stops it.
constexpr double kRestApproach = 0.2;

/// Way (-, of the contact tolerance) that a point may part in what is left of a step and still be
/// pressed: one that goes farther flies, as a force that only lets it come to a stop by the end of
/// the step would carry it out of touch.
constexpr double kRestParting = 1.0;

/// Least sweeps (-) of resting contacts: from step to step they bring a stack to its exact forces.
constexpr int kLeastRestSweeps = 4;

/// Change of a velocity (m/s) in a sweep that is rounding: then no more sweeps are needed.
constexpr double kNoChange = 1e-13;

/// Bound on how often a point is relaxed in one solve of resting contacts, all points together. The
/// solve starts from the forces of the last step, so that a stack at rest needs a sweep or two; a
/// stack of ten that was never solved needs a thousand.
constexpr int kMaxRestRelaxations = 40000;

/// Sweeps (-) that resting contacts of many points get in any case.
constexpr int kMinRestSweeps = 30;

/// Gap (-, of the contact tolerance) below which the positions of a resting contact are corrected:
/// as long as there is more, the solver brings it back by itself.
constexpr double kLeastRestGap = 0.1;

/// Least tolerance (-, of the size of the largest body): a tenth of it is a gap (kLeastRestGap),
/// which must be a number of roundings.
constexpr double kLeastTolerance = 1e-11;

/// Largest ratio (-) of the masses of two bodies that can meet. A heavy box that falls on a light
/// one on a floor needs a number of sweeps that grows with it: with 1e4 no step is cut off from
/// 0.2 ms to 10 ms, with 2e4 some are.
constexpr double kMostMassRatio = 1e4;

/// Gap (-, of the contact tolerance) up to which a correction moves a pair.
constexpr double kFairRestGap = 0.4;

/// Bound on the sweeps of a correction: the height of a stack squared, for ten bodies.
constexpr int kMaxCorrectionSweeps = 100;

/// Bounces of a pair in one step after which it is plastic: the sum of what would follow is shorter
/// than the step (Zeno).
constexpr int kMaxBounces = 8;

/// Bound on the events of a step, of an island without pairs and for each pair, after which all is
/// plastic but pairs of e = 1; after twice as many the rest of the step is left out.
constexpr int kMaxEvents = 32;
constexpr int kMaxEventsPerPair = 2;

/// Bound on how often a piece of a step is cut to the time of impact until the integrator's own
/// path is clear; each cut shortens the piece's curve by the cube of its length.
constexpr int kMaxCuts = 10;

/// Cuts after which a piece is halved at least: two resting bodies that slide around each other can
/// dip on every piece that ends at the time of impact of a longer one. Without it tumble.yaml does
/// not get past its second second.
constexpr int kImpactCuts = 2;

/// What is left (-) of the distance that counts as an impact with each such cut.
constexpr double kCutShare = 0.7;

/// Most faces of an obstacle that are looked at one by one: a twentieth of the cost of a query.
constexpr int kFewFaces = 32;

/// Neighbours are looked for this much farther than a body's own size (-), and ten steps ahead: so
/// seldom that the search costs nothing, so near that few of them come to nothing.
constexpr double kFatBoxMargin = 0.25;
constexpr double kStepsAhead = 10.0;

/// What a fat box is made smaller by (-, of its size): more than the roundings of its sides.
constexpr double kMarginRounding = 1e-12;

/// Most pairs (-) that are looked at for whether bodies may meet in the next milliseconds: some ten
/// microseconds' worth, as much as it costs to wait for a step less.
constexpr std::size_t kMostPairsAhead = 256;

/// Longest turn (rad) for which a body's distance from a plane is bounded by its distance before.
constexpr double kLongestTurn = 0.1;

/// Steps (-) for which what was found of bodies that are near nothing must hold on, as they turn
/// now: to note it costs about as much as it saves in two. Else it is tried again that much later.
constexpr double kLeastStepsClear = 4.0;
constexpr int kStepsUntilClearances = 16;

/// Margin (m) of the fat box of a body that is alone.
constexpr double kFarMargin = 1e6;

/// A body whose points went farther than its motion bound is given twice what it took.
constexpr double kMotionBoundReserve = 2.0;

/// A bound on the motion of bodies that are near nothing is kept until it is exceeded; it begins as
/// this times the motion (-): a craft that speeds up from 1 to 10 m/s makes six of them.
constexpr double kKeptBoundFactor = 1.5;

/// Bound on how often a step is begun anew: each time with at least twice the motion bound.
constexpr int kMaxRestarts = 20;

/// Share (-) of the wanted gap from which on a pair counts as set apart, and bound on the sweeps of
/// separateTouching(): the height of a stack squared, for fifty bodies.
constexpr double kSeparatedShare = 0.9;
constexpr int kMaxSeparationSweeps = 2500;

}  // namespace hovercraft
