#include "hovercraft_sim/scenario/pilot_parser.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <set>
#include <utility>

#include "hovercraft_sim/io/input_file.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/pilot/excitation.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/step_time.h"
#include "hovercraft_sim/scenario/world_builder.h"
#include "hovercraft_sim/scenario/yaml_text.h"

namespace hovercraft {
namespace {

constexpr std::size_t kMostManoeuvres = 100;
constexpr std::size_t kMostSteps = 1000;
constexpr double kPeriodsTolerance = 1e-9;  // share of a whole number that typed digits may miss

const NumberRule kTimeRule = {[](double s) { return s > 0.0 && s <= kLongestManoeuvre; },
                              "must be greater than 0 s and at most 3600 s"};
const NumberRule kApproachRule = {[](double s) { return s >= 0.0 && s <= kLongestManoeuvre; },
                                  "must be 0 to 3600 s"};
const NumberRule kPeriodRule = {[](double s) { return s >= 1e-4 && s <= 1.0; },
                                "must be 0.0001 to 1 s"};
const NumberRule kHelmAngleRule = {[](double degrees) { return degrees > 0.0 && degrees <= 180.0; },
                                   "must be greater than 0 and at most 180 degrees"};
const NumberRule kHeadingRule = {[](double degrees) { return degrees > 0.0 && degrees < 180.0; },
                                 "must be greater than 0 and less than 180 degrees"};
const NumberRule kTurnRule = {[](double degrees) { return degrees >= 180.0 && degrees <= 7200.0; },
                              "must be 180 to 7200 degrees"};

using Words = std::vector<std::string>;

/// Reads a file for one craft.
class PilotParser {
 public:
  PilotParser(const ConfigReader& reader, const Scenario& scenario)
      : reader_(reader), scenario_(scenario) {}

  PilotFile parse() {
    reader_.allowOnly({"vehicle", "period", "helm", "manoeuvres"});
    chooseVehicle();
    parsePeriod();
    if (reader_.has("helm")) parseHelm(reader_.map("helm"));
    const auto manoeuvres = reader_.list("manoeuvres");
    if (manoeuvres.size() > kMostManoeuvres) {
      reader_.fail("manoeuvres", fmt::format("must be at most {} manoeuvres", kMostManoeuvres));
    }
    for (const ConfigReader& manoeuvre : manoeuvres) parseManoeuvre(manoeuvre);
    file_.channels.assign(named_.begin(), named_.end());
    checkTimeouts();
    return std::move(file_);
  }

 private:
  void chooseVehicle();
  void parsePeriod();
  void parseHelm(const ConfigReader& helm);
  void parseManoeuvre(const ConfigReader& reader);
  void checkTimeouts() const;
  /// What a map of names and levels makes of the levels of a base.
  Levels levels(const ConfigReader& map, const Levels& base);
  Levels levels(const ConfigReader& reader, const char* key, const Levels& base) {
    return levels(reader.map(key), base);
  }
  /// @param what is named by it lies beyond the limits of the actuator.
  void checkLimits(const ConfigReader& reader, const char* key, const Levels& levels) const;
  void allow(const ConfigReader& reader, const Words& own) const;
  Side side(const ConfigReader& reader, const char* key) const {
    return static_cast<Side>(reader.choiceOr(0, key, sideNames()));
  }
  double helmAngle(const ConfigReader& reader, double fallback, const Manoeuvre& manoeuvre) const;
  /// A time that is a whole number of decisions.
  double decisions(const ConfigReader& reader, const char* key) const;
  void parseLongest(const ConfigReader& reader, Manoeuvre& manoeuvre) const;
  template <class Timed>
  void setLength(const ConfigReader& reader, const char* key, const Timed& task,
                 Manoeuvre& manoeuvre) const;

  void parseSteps(const ConfigReader& reader, Manoeuvre& manoeuvre);
  void parseRamp(const ConfigReader& reader, Manoeuvre& manoeuvre);
  void parsePrbs(const ConfigReader& reader, Manoeuvre& manoeuvre);
  void parseChirp(const ConfigReader& reader, Manoeuvre& manoeuvre);
  void parseZigZag(const ConfigReader& reader, Manoeuvre& manoeuvre);
  void parseTurningCircle(const ConfigReader& reader, Manoeuvre& manoeuvre);
  void parseFigureOfEight(const ConfigReader& reader, Manoeuvre& manoeuvre);
  void parseStop(const ConfigReader& reader, Manoeuvre& manoeuvre);

  const ConfigReader& reader_;
  const Scenario& scenario_;
  const VehicleScenario* craft_ = nullptr;
  ActuatorArray<EngineParameters> parameters_;
  Words names_;  // of its actuators, by id; empty: an engine that it lacks
  std::set<std::size_t> named_;
  bool has_helm_ = false;
  PilotFile file_;
};

void PilotParser::chooseVehicle() {
  Words crafts;
  for (const VehicleScenario& craft : scenario_.vehicles) crafts.push_back(craft.name);
  if (!reader_.has("vehicle") && crafts.size() > 1) {
    reader_.fail("vehicle", fmt::format("the key is missing; the scenario has several: {}",
                                        fmt::join(crafts, ", ")));
  }
  file_.vehicle = reader_.choiceOr(0, "vehicle", crafts);
  craft_ = &scenario_.vehicles[file_.vehicle];
  parameters_ = parametersOf(*craft_);
  file_.actuators = parameters_;
  const EngineStates initial = initialActuators(*craft_);
  for (std::size_t id = 0; id < parameters_.size(); ++id) {
    const bool is_there = id >= kFirstActuator || craft_->has_engine[id];
    names_.push_back(is_there ? actuatorName(*craft_, id) : "");
    file_.idle.push_back(initial[id].commanded);
  }
  file_.plan.helm.port.assign(names_.size(), 0.0);
  file_.plan.helm.starboard.assign(names_.size(), 0.0);
}

void PilotParser::parsePeriod() {
  double& period = file_.plan.period;
  period = reader_.numberOr(period, "period", kPeriodRule);
  const auto steps = wholeSteps(period / scenario_.stepSize());
  if (!steps) {
    reader_.fail("period", fmt::format("must be a whole number of steps of the scenario, {} s",
                                       numberText(scenario_.stepSize())));
  }
  file_.period_ticks = *steps;
}

void PilotParser::parseHelm(const ConfigReader& helm) {
  helm.allowOnly({"hard_over_deg", "port", "starboard"});
  file_.plan.helm.hard_over_deg =
      helm.numberOr(file_.plan.helm.hard_over_deg, "hard_over_deg", kHelmAngleRule);
  const Levels none(names_.size(), 0.0);
  file_.plan.helm.port = levels(helm, "port", none);
  file_.plan.helm.starboard = levels(helm, "starboard", none);
  has_helm_ = true;
}

Levels PilotParser::levels(const ConfigReader& map, const Levels& base) {
  Words known;
  std::copy_if(names_.begin(), names_.end(), std::back_inserter(known),
               [](const std::string& name) { return !name.empty(); });
  map.allowOnly(known);
  Levels result = base;
  for (std::size_t id = 0; id < names_.size(); ++id) {
    if (names_[id].empty() || !map.has(names_[id].c_str())) continue;
    result[id] = map.number(names_[id].c_str());
    named_.insert(id);
  }
  return result;
}

void PilotParser::checkLimits(const ConfigReader& reader, const char* key,
                              const Levels& levels) const {
  for (std::size_t id = 0; id < levels.size(); ++id) {
    const double least = parameters_[id].min_thrust;
    const double most = parameters_[id].max_thrust;
    // The sum of a throttle and a helm is rounded.
    const double rounding = 1e-12 * (most - least);
    if (levels[id] >= least - rounding && levels[id] <= most + rounding) continue;
    reader.fail(key, fmt::format("would set {} to {:.12g}: must be {:.12g} to {:.12g}", names_[id],
                                 levels[id], least, most));
  }
}

void PilotParser::allow(const ConfigReader& reader, const Words& own) const {
  Words keys = {"name", "kind", "throttle", "approach"};
  keys.insert(keys.end(), own.begin(), own.end());
  reader.allowOnly(keys);
}

void PilotParser::parseLongest(const ConfigReader& reader, Manoeuvre& manoeuvre) const {
  manoeuvre.longest = reader.numberOr(300.0, "longest", kTimeRule);
  if (manoeuvre.longest / file_.plan.period > kMostDecisions) {
    reader.fail("longest", "must be at most 1,000,000 times `period`");
  }
}

template <class Timed>
void PilotParser::setLength(const ConfigReader& reader, const char* key, const Timed& task,
                            Manoeuvre& manoeuvre) const {
  const double duration = durationOf(task);
  if (duration > kLongestManoeuvre || duration / file_.plan.period > kMostDecisions) {
    reader.fail(key, fmt::format("makes a manoeuvre of {:.12g} s: must be at most 3600 s, and "
                                 "1,000,000 times `period`",
                                 duration));
  }
  manoeuvre.longest = duration + file_.plan.period;
  manoeuvre.task = task;
}

double PilotParser::decisions(const ConfigReader& reader, const char* key) const {
  const double time = reader.number(key, kTimeRule);
  const double count = time / file_.plan.period;
  if (count < 0.5 || std::abs(count - std::round(count)) > kPeriodsTolerance * count) {
    reader.fail(key, fmt::format("must be a whole number of periods of {} s",
                                 numberText(file_.plan.period)));
  }
  return time;
}

double PilotParser::helmAngle(const ConfigReader& reader, double fallback,
                              const Manoeuvre& manoeuvre) const {
  if (!has_helm_) {
    reader.fail("kind", "needs `helm` of the file: what hard over to port and to starboard does");
  }
  const Helm& helm = file_.plan.helm;
  const double angle = reader.numberOr(fallback, "helm_deg", kHelmAngleRule);
  const char* key = reader.has("helm_deg") ? "helm_deg" : "kind";
  if (angle > helm.hard_over_deg) {
    reader.fail(
        key, fmt::format("must be at most hard over, {} degrees", numberText(helm.hard_over_deg)));
  }
  for (const Levels* added : {&helm.port, &helm.starboard}) {
    Levels levels = manoeuvre.throttle;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      levels[i] += angle / helm.hard_over_deg * (*added)[i];
    }
    checkLimits(reader, key, levels);
  }
  return angle;
}

void PilotParser::parseSteps(const ConfigReader& reader, Manoeuvre& manoeuvre) {
  allow(reader, {"levels", "hold", "response"});
  Steps steps;
  const auto list = reader.list("levels");
  if (list.size() > kMostSteps) {
    reader.fail("levels", fmt::format("must be at most {} steps", kMostSteps));
  }
  for (const ConfigReader& step : list) {
    steps.levels.push_back(levels(step, manoeuvre.throttle));
    checkLimits(reader, "levels", steps.levels.back());
  }
  steps.hold = decisions(reader, "hold");
  steps.response = static_cast<Response>(reader.choiceOr(0, "response", responseNames()));
  setLength(reader, "hold", steps, manoeuvre);
}

void PilotParser::parseRamp(const ConfigReader& reader, Manoeuvre& manoeuvre) {
  allow(reader, {"from", "to", "duration"});
  Ramp ramp;
  ramp.from = manoeuvre.throttle;
  if (reader.has("from")) ramp.from = levels(reader, "from", manoeuvre.throttle);
  ramp.to = levels(reader, "to", ramp.from);
  checkLimits(reader, "from", ramp.from);
  checkLimits(reader, "to", ramp.to);
  ramp.duration = reader.number("duration", kTimeRule);
  setLength(reader, "duration", ramp, manoeuvre);
}

void PilotParser::parsePrbs(const ConfigReader& reader, Manoeuvre& manoeuvre) {
  allow(reader, {"low", "high", "order", "bit", "cycles"});
  Prbs prbs;
  prbs.low = levels(reader, "low", manoeuvre.throttle);
  prbs.high = levels(reader, "high", manoeuvre.throttle);
  checkLimits(reader, "low", prbs.low);
  checkLimits(reader, "high", prbs.high);
  const auto order = reader.wholeNumberOr(prbs.order, "order");
  if (order < kLeastPrbsOrder || order > kMostPrbsOrder) {
    reader.fail("order", fmt::format("must be {} to {}", kLeastPrbsOrder, kMostPrbsOrder));
  }
  const auto cycles = reader.wholeNumberOr(prbs.cycles, "cycles");
  if (cycles < 1 || cycles > 1000) reader.fail("cycles", "must be 1 to 1000");
  prbs.order = static_cast<int>(order);
  prbs.cycles = static_cast<int>(cycles);
  prbs.bit = decisions(reader, "bit");
  setLength(reader, "bit", prbs, manoeuvre);
}

void PilotParser::parseChirp(const ConfigReader& reader, Manoeuvre& manoeuvre) {
  allow(reader, {"centre", "amplitude", "first_frequency", "last_frequency", "duration", "sweep"});
  Chirp chirp;
  chirp.centre = manoeuvre.throttle;
  if (reader.has("centre")) chirp.centre = levels(reader, "centre", manoeuvre.throttle);
  chirp.amplitude = levels(reader, "amplitude", Levels(names_.size(), 0.0));
  for (const double sign : {1.0, -1.0}) {
    Levels peak = chirp.centre;
    for (std::size_t i = 0; i < peak.size(); ++i) peak[i] += sign * chirp.amplitude[i];
    checkLimits(reader, "amplitude", peak);
  }
  const auto frequency = [&](const char* key) {
    const double value = reader.number(key, kPositive);
    const double most = 0.5 / file_.plan.period;
    if (value > most) {
      reader.fail(
          key, fmt::format("must be at most half of the decisions in a second, {:.12g} Hz", most));
    }
    // So far below that the sweep would have no number.
    if (value < 1e-6) reader.fail(key, "must be at least 1e-6 Hz");
    return value;
  };
  chirp.first_frequency = frequency("first_frequency");
  chirp.last_frequency = frequency("last_frequency");
  chirp.duration = reader.number("duration", kTimeRule);
  chirp.is_logarithmic = reader.choiceOr(0, "sweep", {"linear", "logarithmic"}) == 1;
  setLength(reader, "duration", chirp, manoeuvre);
}

void PilotParser::parseZigZag(const ConfigReader& reader, Manoeuvre& manoeuvre) {
  allow(reader, {"helm_deg", "heading_deg", "executes", "first", "longest"});
  ZigZag task;
  task.helm_deg = helmAngle(reader, task.helm_deg, manoeuvre);
  task.heading_deg = reader.numberOr(task.helm_deg, "heading_deg", kHeadingRule);
  const auto executes = reader.wholeNumberOr(task.executes, "executes");
  if (executes < 2 || executes > 100) reader.fail("executes", "must be 2 to 100");
  task.executes = static_cast<int>(executes);
  task.first = side(reader, "first");
  parseLongest(reader, manoeuvre);
  manoeuvre.task = task;
}

void PilotParser::parseTurningCircle(const ConfigReader& reader, Manoeuvre& manoeuvre) {
  allow(reader, {"helm_deg", "turn_deg", "side", "longest"});
  TurningCircle task;
  task.helm_deg = helmAngle(reader, file_.plan.helm.hard_over_deg, manoeuvre);
  task.turn_deg = reader.numberOr(task.turn_deg, "turn_deg", kTurnRule);
  task.side = side(reader, "side");
  parseLongest(reader, manoeuvre);
  manoeuvre.task = task;
}

void PilotParser::parseFigureOfEight(const ConfigReader& reader, Manoeuvre& manoeuvre) {
  allow(reader, {"helm_deg", "first", "longest"});
  FigureOfEight task;
  task.helm_deg = helmAngle(reader, file_.plan.helm.hard_over_deg, manoeuvre);
  task.first = side(reader, "first");
  parseLongest(reader, manoeuvre);
  manoeuvre.task = task;
}

void PilotParser::parseStop(const ConfigReader& reader, Manoeuvre& manoeuvre) {
  allow(reader, {"levels", "end_speed", "longest"});
  Stop task;
  task.levels = levels(reader, "levels", manoeuvre.throttle);
  checkLimits(reader, "levels", task.levels);
  task.end_speed = reader.numberOr(task.end_speed, "end_speed", kNotNegative);
  parseLongest(reader, manoeuvre);
  manoeuvre.task = task;
}

void PilotParser::parseManoeuvre(const ConfigReader& reader) {
  using Parse = void (PilotParser::*)(const ConfigReader&, Manoeuvre&);
  // In the order of manoeuvreKindNames().
  static constexpr std::array<Parse, 8> kParse = {
      &PilotParser::parseSteps,         &PilotParser::parseRamp,   &PilotParser::parsePrbs,
      &PilotParser::parseChirp,         &PilotParser::parseZigZag, &PilotParser::parseTurningCircle,
      &PilotParser::parseFigureOfEight, &PilotParser::parseStop};
  Manoeuvre manoeuvre;
  reader.text("kind");
  const std::size_t kind = reader.choiceOr(0, "kind", manoeuvreKindNames());
  manoeuvre.name = reader.has("name") ? reader.text("name") : manoeuvreKindNames()[kind];
  manoeuvre.throttle = file_.idle;
  if (reader.has("throttle")) manoeuvre.throttle = levels(reader, "throttle", file_.idle);
  checkLimits(reader, "throttle", manoeuvre.throttle);
  manoeuvre.approach = reader.numberOr(0.0, "approach", kApproachRule);
  (this->*kParse[kind])(reader, manoeuvre);
  file_.plan.manoeuvres.push_back(std::move(manoeuvre));
}

/// A level is repeated at each decision: none may time out before the next one.
void PilotParser::checkTimeouts() const {
  if (named_.empty()) reader_.fail("manoeuvres", "must set a level of at least one actuator");
  for (const std::size_t id : named_) {
    const std::int64_t timeout_ns = parameters_[id].timeout_ns;
    if (timeout_ns == 0 || file_.period_ticks * scenario_.step_ns < timeout_ns) continue;
    reader_.fail("period", fmt::format("must be less than the time-out of {}, {} s", names_[id],
                                       secondsText(timeout_ns)));
  }
}

}  // namespace

PilotFile parsePilot(const std::string& text, const std::string& source, const Scenario& scenario) {
  const FloatingPointEnvironment environment;
  const ConfigNode tree = treeOf(text, source);
  if (tree.isNull()) {
    throw std::invalid_argument(source + ": must be a map of keys with manoeuvres; it is empty");
  }
  if (!tree.isMap()) throw std::invalid_argument(source + ": must be a map of keys");
  const ConfigReader reader(tree, source);
  return PilotParser(reader, scenario).parse();
}

PilotFile loadPilot(const std::string& path, const Scenario& scenario) {
  return parsePilot(readWholeFile(path, kLongestYamlText), path, scenario);
}

}  // namespace hovercraft
