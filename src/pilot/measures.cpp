#include "hovercraft_sim/pilot/measures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/pilot/turning.h"

namespace hovercraft {
namespace {

constexpr double kDegrees = 180.0 / kPi;

using Value = std::function<double(const PlanarMotion&)>;

/// The motion at a share of the way from one to the next.
PlanarMotion between(const PlanarMotion& a, const PlanarMotion& b, double share) {
  const auto mix = [share](double from, double to) { return (1.0 - share) * from + share * to; };
  return {mix(a.time, b.time),        mix(a.x, b.x),         mix(a.y, b.y),
          mix(a.heading, b.heading),  mix(a.surge, b.surge), mix(a.sway, b.sway),
          mix(a.yaw_rate, b.yaw_rate)};
}

/// The first motion from index `begin` on at which a value that was below a level reaches it.
std::optional<PlanarMotion> rising(const Track& track, std::size_t begin, const Value& value,
                                   double level) {
  for (std::size_t i = begin; i < track.size(); ++i) {
    const double now = value(track[i]);
    if (now < level) continue;
    if (i == begin) return track[i];
    const double before = value(track[i - 1]);
    return between(track[i - 1], track[i], (level - before) / (now - before));
  }
  return std::nullopt;
}

double speedOf(const PlanarMotion& motion) {
  return std::sqrt(motion.surge * motion.surge + motion.sway * motion.sway);
}

/// How a place lies from where the manoeuvre began, in the axes of the heading then: m ahead and
/// to a side.
struct Reach {
  double ahead = 0.0;
  double aside = 0.0;
};
Reach reachOf(const PlanarMotion& begin, const PlanarMotion& motion, Side side) {
  const Heading axis = headingOf(begin.heading);
  const double dx = motion.x - begin.x;
  const double dy = motion.y - begin.y;
  const double to_port = axis.along * dy - axis.across * dx;
  return {axis.along * dx + axis.across * dy, side == Side::kPort ? to_port : -to_port};
}

/// Means over the last half turn before the end: what the circle has become.
struct SteadyTurn {
  double radius = 0.0;    // m
  double speed = 0.0;     // m/s
  double yaw_rate = 0.0;  // rad/s, to the side of the turn
  double drift = 0.0;     // rad, from the bow to the way, to the outside of the turn positive
};
std::optional<SteadyTurn> steadyTurn(const Track& track, std::size_t end, Side side) {
  const double whole = turned(track.front(), track[end - 1], side);
  std::size_t begin = end - 1;
  while (begin > 0 && std::abs(whole - turned(track.front(), track[begin], side)) < kPi) --begin;
  const double angle = std::abs(turned(track[begin], track[end - 1], side));
  const double time = track[end - 1].time - track[begin].time;
  if (begin == 0 || !(time > 0.0)) return std::nullopt;
  double way = 0.0;
  double ahead = 0.0;
  double aside = 0.0;
  for (std::size_t i = begin; i + 1 < end; ++i) {
    const double dt = track[i + 1].time - track[i].time;
    way += 0.5 * dt * (speedOf(track[i]) + speedOf(track[i + 1]));
    ahead += 0.5 * dt * (track[i].surge + track[i + 1].surge);
    aside += 0.5 * dt * (track[i].sway + track[i + 1].sway);
  }
  const double outwards = side == Side::kPort ? -aside : aside;
  return SteadyTurn{way / angle, way / time, angle / time, angleOf(outwards, ahead)};
}

void add(Measures& measures, const std::string& name, const std::string& unit, double value) {
  measures.push_back({name, unit, value});
}

void addSteadyTurn(Measures& measures, const std::string& beginning, const SteadyTurn& turn) {
  add(measures, beginning + "steady turning radius", "m", turn.radius);
  add(measures, beginning + "steady speed", "m/s", turn.speed);
  add(measures, beginning + "steady yaw rate", "deg/s", kDegrees * turn.yaw_rate);
  add(measures, beginning + "steady drift angle", "deg", kDegrees * turn.drift);
}

std::string ordinal(std::size_t number) {
  static const std::vector<std::string> words = {"first", "second",  "third",  "fourth", "fifth",
                                                 "sixth", "seventh", "eighth", "ninth",  "tenth"};
  return number <= words.size() ? words[number - 1] : std::to_string(number) + "th";
}

/// The motion between two indices with the greatest value.
const PlanarMotion& greatest(const Track& track, std::size_t begin, std::size_t end,
                             const Value& value) {
  const auto at = [&track](std::size_t i) {
    return track.begin() + static_cast<std::ptrdiff_t>(i);
  };
  return *std::max_element(
      at(begin), at(end),
      [&value](const PlanarMotion& a, const PlanarMotion& b) { return value(a) < value(b); });
}

double answerOf(const PlanarMotion& motion, Response response) {
  switch (response) {
    case Response::kSurge:
      return motion.surge;
    case Response::kSway:
      return motion.sway;
    case Response::kYawRate:
      return motion.yaw_rate;
    case Response::kHeading:
      break;
  }
  return motion.heading;
}

/// One step: the part of a track from the index of its change of levels to that of the next one.
struct StepPart {
  std::size_t begin;
  std::size_t end;
};

void addStep(Measures& measures, const Track& track, const StepPart& part, const std::string& name,
             Response response) {
  const bool is_angle = response == Response::kYawRate || response == Response::kHeading;
  const double factor = is_angle ? kDegrees : 1.0;
  static const std::vector<std::string> units = {"m/s", "m/s", "deg/s", "deg"};
  const double from = answerOf(track[part.begin], response);
  const std::size_t tail = std::max<std::size_t>(1, (part.end - part.begin) / 10);
  double to = 0.0;
  for (std::size_t i = part.end - tail; i < part.end; ++i) to += answerOf(track[i], response);
  to /= static_cast<double>(tail);
  add(measures, name + ": settles at", units[static_cast<std::size_t>(response)], factor * to);
  if (std::abs(to - from) < kLeastResponse) return;
  const Value share = [&](const PlanarMotion& m) {
    return (answerOf(m, response) - from) / (to - from);
  };
  const Track own(track.begin() + static_cast<std::ptrdiff_t>(part.begin),
                  track.begin() + static_cast<std::ptrdiff_t>(part.end));
  const auto low = rising(own, 0, share, 0.1);
  const auto high = rising(own, 0, share, 0.9);
  if (low && high) add(measures, name + ": rise time", "s", high->time - low->time);
  const double top = share(greatest(own, 0, own.size(), share));
  add(measures, name + ": overshoot", "percent", std::max(0.0, 100.0 * (top - 1.0)));
}

}  // namespace

Measures approachMeasures(const Track& track) {
  const FloatingPointEnvironment environment;
  return {{"approach speed", "m/s", speedOf(track.front())},
          {"yaw rate at the first execute", "deg/s", kDegrees * track.front().yaw_rate}};
}

Measures zigZagMeasures(const Track& track, const std::vector<std::size_t>& executes, Side first) {
  const FloatingPointEnvironment environment;
  Measures measures;
  const PlanarMotion& begin = track.front();
  if (executes.size() < 2) return measures;
  add(measures, "initial turning time", "s", track[executes[1]].time - begin.time);
  std::vector<double> zeros;  // when the heading is the first one again, after each execute
  for (std::size_t i = 1; i < executes.size(); ++i) {
    // To the side that the craft is turned to at this execute.
    const double sign = i % 2 == 1 ? 1.0 : -1.0;
    const Value away = [&](const PlanarMotion& m) { return sign * turned(begin, m, first); };
    const auto zero = rising(
        track, executes[i], [&](const auto& m) { return -away(m); }, 0.0);
    const std::size_t end = i + 1 < executes.size() ? executes[i + 1] + 1 : track.size();
    const PlanarMotion& top = greatest(track, executes[i], end, away);
    if (i + 1 < executes.size() || zero) {
      add(measures, ordinal(i) + " overshoot angle", "deg",
          kDegrees * (away(top) - away(track[executes[i]])));
      add(measures, ordinal(i) + " time to check yaw", "s", top.time - track[executes[i]].time);
    }
    if (zero) zeros.push_back(zero->time - begin.time);
  }
  if (!zeros.empty()) add(measures, "reach", "s", zeros[0]);
  if (zeros.size() > 1) add(measures, "time of a complete cycle", "s", zeros[1]);
  if (zeros.size() > 2) add(measures, "period", "s", zeros[2] - zeros[0]);
  return measures;
}

Measures turningCircleMeasures(const Track& track, Side side) {
  const FloatingPointEnvironment environment;
  Measures measures;
  const PlanarMotion& begin = track.front();
  const Value angle = [&](const PlanarMotion& m) { return turned(begin, m, side); };
  if (const auto quarter = rising(track, 0, angle, 0.5 * kPi)) {
    const Reach reach = reachOf(begin, *quarter, side);
    add(measures, "advance", "m", reach.ahead);
    add(measures, "transfer", "m", reach.aside);
    add(measures, "time to turn 90 deg", "s", quarter->time - begin.time);
  }
  if (const auto half = rising(track, 0, angle, kPi)) {
    add(measures, "tactical diameter", "m", reachOf(begin, *half, side).aside);
    add(measures, "time to turn 180 deg", "s", half->time - begin.time);
  }
  if (const auto whole = rising(track, 0, angle, 2.0 * kPi)) {
    add(measures, "time to turn 360 deg", "s", whole->time - begin.time);
    if (const auto turn = steadyTurn(track, track.size(), side)) addSteadyTurn(measures, "", *turn);
  }
  return measures;
}

Measures figureOfEightMeasures(const Track& track, std::size_t reversal, Side first) {
  const FloatingPointEnvironment environment;
  Measures measures;
  if (reversal >= track.size()) return measures;
  const PlanarMotion& begin = track.front();
  add(measures, "time of the first circle", "s", track[reversal].time - begin.time);
  if (const auto turn = steadyTurn(track, reversal + 1, first)) {
    addSteadyTurn(measures, "first circle: ", *turn);
  }
  const Value back = [&](const PlanarMotion& m) { return -turned(begin, m, first); };
  const auto end = rising(track, reversal, back, 0.0);
  if (!end) return measures;
  add(measures, "time of the second circle", "s", end->time - track[reversal].time);
  const Side other = first == Side::kPort ? Side::kStarboard : Side::kPort;
  if (const auto turn = steadyTurn(track, track.size(), other)) {
    addSteadyTurn(measures, "second circle: ", *turn);
  }
  const double dx = end->x - begin.x;
  const double dy = end->y - begin.y;
  add(measures, "distance from where it began", "m", std::sqrt(dx * dx + dy * dy));
  return measures;
}

Measures stopMeasures(const Track& track, double end_speed) {
  const FloatingPointEnvironment environment;
  const PlanarMotion& begin = track.front();
  const PlanarMotion& end = track.back();
  if (!(begin.surge > end_speed && end.surge <= end_speed)) return {};
  const Reach reach = reachOf(begin, end, Side::kStarboard);
  double way = 0.0;
  for (std::size_t i = 0; i + 1 < track.size(); ++i) {
    const double dt = track[i + 1].time - track[i].time;
    way += 0.5 * dt * (speedOf(track[i]) + speedOf(track[i + 1]));
  }
  return {
      {"head reach", "m", reach.ahead},
      {"track reach", "m", way},
      {"lateral deviation to starboard", "m", reach.aside},
      {"time to stop", "s", end.time - begin.time},
      {"change of heading to starboard", "deg", kDegrees * turned(begin, end, Side::kStarboard)}};
}

Measures stepMeasures(const Track& track, const Steps& steps) {
  const FloatingPointEnvironment environment;
  Measures measures;
  std::size_t begin = 0;
  for (std::size_t step = 0; step < steps.levels.size(); ++step) {
    const double border = track.front().time + steps.hold * static_cast<double>(step + 1);
    std::size_t end = begin;
    // Times are rounded: just before the border is on it.
    while (end < track.size() && track[end].time < border - 1e-9 * steps.hold) ++end;
    if (end == begin || end == track.size()) break;  // cut off
    addStep(measures, track, {begin, end}, "step " + std::to_string(step + 1), steps.response);
    begin = end;
  }
  return measures;
}

}  // namespace hovercraft
