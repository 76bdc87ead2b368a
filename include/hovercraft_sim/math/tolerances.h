#pragma once

/// Every tolerance of the library, with its unit and its reason.

namespace hovercraft {

/// Orthogonality error (-) from which one step of Newton's polar iteration reaches rounding: 1e-8
/// squared = 1e-16.
constexpr double kPolarLastStep = 1e-8;

/// Bound on Newton's polar iteration; from an error of 1 it needs six, from 1e3 about sixteen.
constexpr int kMaxPolarIterations = 60;

/// |length - 1| (-) that a direction given by a user may have: what five printed digits leave.
constexpr double kUnitLength = 1e-5;

/// Relative slack (-) of the checks on an inertia tensor given by a user: symmetric entries,
/// triangle inequality. Flat bodies meet the inequality with equality, and their printed entries
/// round to either side.
constexpr double kInertiaSlack = 1e-9;

}  // namespace hovercraft
