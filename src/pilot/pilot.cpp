#include "hovercraft_sim/pilot/pilot.h"

#include <cmath>
#include <sstream>
#include <utility>

#include "hovercraft_sim/math/constants.h"
#include "hovercraft_sim/math/demand.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/pilot/excitation.h"
#include "hovercraft_sim/pilot/turning.h"

namespace hovercraft {
namespace {

constexpr double kRadians = kPi / 180.0;
constexpr double kWholeTurn = 360.0;  // deg
// Share of a decision by which times may miss a border: far more than their rounding.
constexpr double kDecisionBorder = 1e-6;

/// A helm order to the first side is one to starboard, or its negative.
double toStarboard(double helm_deg, Side first) {
  return first == Side::kStarboard ? helm_deg : -helm_deg;
}

}  // namespace

const std::vector<std::string>& manoeuvreKindNames() {
  static const std::vector<std::string> names = {
      "steps", "ramp", "prbs", "chirp", "zig_zag", "turning_circle", "figure_of_eight", "stop"};
  return names;
}

const std::vector<std::string>& responseNames() {
  static const std::vector<std::string> names = {"surge", "sway", "yaw_rate", "heading"};
  return names;
}

const std::vector<std::string>& sideNames() {
  static const std::vector<std::string> names = {"starboard", "port"};
  return names;
}

std::string toText(const FlownManoeuvre& flown) {
  std::ostringstream text;
  text.precision(4);
  text << flown.name << " (" << flown.kind << "), first execute at " << flown.execute
       << " s, end at " << flown.end << " s";
  if (!flown.is_complete) text << ", not complete: " << flown.reason;
  text << '\n';
  for (const Measure& measure : flown.measures) {
    text << "  " << measure.name << ": " << measure.value + 0.0;  // no -0
    if (measure.unit == "percent") text << " %";
    if (!measure.unit.empty() && measure.unit != "percent") text << ' ' << measure.unit;
    text << '\n';
  }
  return text.str();
}

Pilot::Pilot(PilotPlan plan) : plan_(std::move(plan)) {
  for (const Manoeuvre& manoeuvre : plan_.manoeuvres) {
    demand(manoeuvre.throttle.size() == plan_.helm.port.size() &&
               manoeuvre.throttle.size() == plan_.helm.starboard.size(),
           "each channel of a plan has its levels");
  }
}

const Levels& Pilot::decide(const PlanarMotion& motion) {
  const FloatingPointEnvironment environment;
  last_time_ = motion.time;
  // A manoeuvre that ends hands over to the next one at the same decision.
  while (!isDone()) {
    if (isApproaching(motion)) return levels_;
    track_.push_back(motion);
    const bool is_over = fly();
    if (!is_over && sinceExecute() < manoeuvre().longest - kDecisionBorder * plan_.period)
      return levels_;
    end(is_over ? "" : "it took longer than `longest`");
  }
  levels_.clear();
  return levels_;
}

bool Pilot::isApproaching(const PlanarMotion& motion) {
  if (!has_begun_) begin_ = motion.time;
  has_begun_ = true;
  if (!track_.empty()) return false;
  if (motion.time >= begin_ + manoeuvre().approach - kDecisionBorder * plan_.period) {
    executes_ = {0};
    return false;
  }
  levels_ = manoeuvre().throttle;
  return true;
}

bool Pilot::fly() {
  return std::visit([this](const auto& task) { return fly(task); }, manoeuvre().task);
}

template <class Timed>
bool Pilot::fly(const Timed& task) {
  levels_.resize(manoeuvre().throttle.size());
  const double t = sinceExecute();
  levelsAt(task, t, levels_);
  return t >= durationOf(task) - kDecisionBorder * plan_.period;
}

bool Pilot::fly(const ZigZag& task) {
  const PlanarMotion& begin = track_.front();
  const double angle = turned(begin, track_.back(), task.first);
  // To the side on which the helm lies: the first one after an odd number of executes.
  const double sign = executes_.size() % 2 == 1 ? 1.0 : -1.0;
  const bool is_last = executes_.size() >= static_cast<std::size_t>(task.executes);
  if (is_last && sign * angle >= 0.0 && executes_.back() + 1 < track_.size()) return true;
  const bool is_due = !is_last && sign * angle >= task.heading_deg * kRadians;
  if (is_due) executes_.push_back(track_.size() - 1);
  steer(toStarboard(is_due ? -sign * task.helm_deg : sign * task.helm_deg, task.first));
  return false;
}

bool Pilot::fly(const TurningCircle& task) {
  steer(toStarboard(task.helm_deg, task.side));
  return turned(track_.front(), track_.back(), task.side) >= task.turn_deg * kRadians;
}

bool Pilot::fly(const FigureOfEight& task) {
  const double angle = turned(track_.front(), track_.back(), task.first);
  if (executes_.size() == 1 && angle >= kWholeTurn * kRadians) {
    executes_.push_back(track_.size() - 1);
  }
  const bool is_second = executes_.size() > 1;
  steer(toStarboard(is_second ? -task.helm_deg : task.helm_deg, task.first));
  return is_second && angle <= 0.0;
}

bool Pilot::fly(const Stop& task) {
  levels_ = task.levels;
  return track_.back().surge <= task.end_speed;
}

void Pilot::steer(double helm_deg) {
  const Levels& added = helm_deg >= 0.0 ? plan_.helm.starboard : plan_.helm.port;
  const double share = std::abs(helm_deg) / plan_.helm.hard_over_deg;
  levels_ = manoeuvre().throttle;
  for (std::size_t i = 0; i < levels_.size(); ++i) levels_[i] += share * added[i];
}

void Pilot::end(std::string reason) {
  const bool is_stop = std::holds_alternative<Stop>(manoeuvre().task);
  if (reason.empty() && is_stop && track_.size() == 1) {
    reason = "it was no faster than `end_speed` when it began";
  }
  FlownManoeuvre flown;
  flown.name = manoeuvre().name;
  flown.kind = manoeuvreKindNames()[manoeuvre().task.index()];
  flown.is_complete = reason.empty();
  flown.reason = reason;
  flown.begin = begin_;
  flown.execute = flown.end = last_time_;
  if (track_.empty()) {
    flown.reason += ", before the first execute";
  } else {
    flown.execute = track_.front().time;
    flown.measures = measures();
  }
  flown_.push_back(std::move(flown));
  ++current_;
  track_.clear();
  executes_.clear();
  has_begun_ = false;
}

void Pilot::giveUp(const std::string& reason) {
  const FloatingPointEnvironment environment;
  if (isDone() || !has_begun_) return;
  end(reason);
  current_ = plan_.manoeuvres.size();
}

Measures Pilot::measures() const {
  Measures measures = approachMeasures(track_);
  const auto& task = manoeuvre().task;
  Measures own;
  if (const auto* steps = std::get_if<Steps>(&task)) own = stepMeasures(track_, *steps);
  if (const auto* zig_zag = std::get_if<ZigZag>(&task)) {
    own = zigZagMeasures(track_, executes_, zig_zag->first);
  }
  if (const auto* circle = std::get_if<TurningCircle>(&task)) {
    own = turningCircleMeasures(track_, circle->side);
  }
  if (const auto* eight = std::get_if<FigureOfEight>(&task)) {
    own = figureOfEightMeasures(track_, executes_.size() > 1 ? executes_[1] : track_.size(),
                                eight->first);
  }
  if (const auto* stop = std::get_if<Stop>(&task)) own = stopMeasures(track_, stop->end_speed);
  measures.insert(measures.end(), own.begin(), own.end());
  return measures;
}

}  // namespace hovercraft
