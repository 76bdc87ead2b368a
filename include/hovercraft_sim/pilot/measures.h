#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/pilot/manoeuvre.h"
#include "hovercraft_sim/pilot/planar_motion.h"

/// What manoeuvres come to, from the motion that was flown. Points in time between two motions are
/// found on the straight line between them. Measures that were not reached are left out.
namespace hovercraft {

/// A number by the name that the ITTC has for it.
struct Measure {
  std::string name;    // such as steady turning radius
  std::string unit;    // m, s, m/s, deg, deg/s, percent; empty: none
  double value = 0.0;  // in that unit
};
using Measures = std::vector<Measure>;  // of one manoeuvre

/// The motion of a manoeuvre at every decision, from its first execute on.
using Track = std::vector<PlanarMotion>;

/// Speed and yaw rate when it began. @param track not empty.
HOVERCRAFT_PUBLIC Measures approachMeasures(const Track& track);

/// @param executes indices of the track at which the helm was put over, the first one is 0.
HOVERCRAFT_PUBLIC Measures zigZagMeasures(const Track& track,
                                          const std::vector<std::size_t>& executes, Side first);
/// @param side of the turn. @param track not empty.
HOVERCRAFT_PUBLIC Measures turningCircleMeasures(const Track& track, Side side);
/// @param reversal index of the track at which the helm went to the other side; its size: never.
HOVERCRAFT_PUBLIC Measures figureOfEightMeasures(const Track& track, std::size_t reversal,
                                                 Side first);
/// None unless the craft was faster ahead than the end speed, m/s, and at the end no more.
HOVERCRAFT_PUBLIC Measures stopMeasures(const Track& track, double end_speed);
/// Of each step that was held to its end: where the response settles, rise time from 10 to 90 %,
/// overshoot. It begins with the response at the change of levels, and settles at the mean over the
/// last tenth of the step. A change of less than kLeastResponse has no rise time and no overshoot.
HOVERCRAFT_PUBLIC Measures stepMeasures(const Track& track, const Steps& steps);
constexpr double kLeastResponse = 1e-6;  // m/s, rad/s, rad

}  // namespace hovercraft
