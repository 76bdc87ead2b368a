#include "hovercraft_sim/ros/node_config.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

#include <ros/console.h>
#include <ros/package.h>

#include "hovercraft_sim/ros/vehicle_messages.h"
#include "hovercraft_sim/sim/config_reader.h"
#include "hovercraft_sim/sim/scenario_parser.h"

namespace hovercraft_ros {
namespace {

// Relative distance from a whole number of steps that a rate may have: rates are typed with few
// digits.
constexpr double kRateSlack = 1e-9;
constexpr double kDefaultPublishRate = 100.0;  // Hz

// Beyond it a count of steps is no exact double; such a period is a slip.
constexpr double kMostSteps = 1e15;

/// How many steps a period is; none if these are not a whole number.
std::optional<hovercraft::Tick> wholeSteps(double steps) {
  if (!(steps <= kMostSteps)) return std::nullopt;
  const hovercraft::Tick whole = std::llround(steps);
  if (whole < 1 || std::abs(steps - static_cast<double>(whole)) > kRateSlack * steps) {
    return std::nullopt;
  }
  return whole;
}

hovercraft::Tick publishPeriod(const hovercraft::ConfigReader& reader, double step_size) {
  if (!reader.has("publish_rate")) {
    return std::max<hovercraft::Tick>(1, std::llround(1.0 / (kDefaultPublishRate * step_size)));
  }
  const double rate = reader.number("publish_rate", hovercraft::kPositive);
  const auto steps = wholeSteps(1.0 / (rate * step_size));
  if (!steps) {
    reader.fail("publish_rate",
                fmt::format("must divide the step rate of {:.9g} Hz", 1.0 / step_size));
  }
  return *steps;
}

const hovercraft::NumberRule kClockRateRule = {[](double rate) {
                                                 return rate >= NodeConfig::kMinClockRate &&
                                                        rate <= NodeConfig::kMaxClockRate;
                                               },
                                               "must be 0.001 to 250 Hz"};

const hovercraft::NumberRule kDiagnosticPeriodRule = {
    [](double period) {
      return period >= NodeConfig::kMinDiagnosticPeriod &&
             period <= NodeConfig::kMaxDiagnosticPeriod;
    },
    "must be 0.01 to 3600 s"};

void readLockstep(const hovercraft::ConfigReader& reader, NodeConfig& config) {
  config.lockstep = reader.flagOr(config.lockstep, "lockstep");
  config.lockstep_timeout =
      reader.numberOr(config.lockstep_timeout, "lockstep_timeout", hovercraft::kPositive);
  config.control_period = config.publish_every;
  if (!reader.has("control_period")) return;
  const double step_size = config.scenario.stepSize();
  const auto steps = wholeSteps(reader.number("control_period", hovercraft::kPositive) / step_size);
  if (!steps) {
    reader.fail("control_period",
                fmt::format("must be a whole number of steps of {:.9g} s", step_size));
  }
  if (!config.lockstep) {
    reader.fail("control_period", "has a meaning in lockstep only: set lockstep or leave it out");
  }
  config.control_period = *steps;
}

}  // namespace

const char* const kRealTimeFactorRuleText = "must be 0 (as fast as it can) or 1e-6 to 1000";

bool isRealTimeFactor(double factor) {
  return factor == 0.0 ||
         (factor >= NodeConfig::kMinRealTimeFactor && factor <= NodeConfig::kMaxRealTimeFactor);
}

NodeConfig parseNodeConfig(const YAML::Node& parameters, const std::string& node_name) {
  if (!parameters.IsMap() || !parameters["scenario"].IsDefined()) {
    throw std::invalid_argument(
        node_name +
        "/scenario: the parameter is missing; load a scenario with <rosparam "
        "command=\"load\" ns=\"scenario\" file=\"...\"/> inside the <node>, as sim.launch does");
  }
  const hovercraft::ConfigReader reader(parameters, node_name);
  reader.allowOnly({"scenario", "publish_rate", "world_frame", "real_time_factor", "paused",
                    "clock", "clock_rate", "lockstep", "control_period", "lockstep_timeout",
                    "diagnostic_period"});
  NodeConfig config;
  config.scenario = hovercraft::parseScenario(
      parameters["scenario"],
      {node_name + "/scenario", "",
       [](const std::string& package) { return ros::package::getPath(package); },
       [](const std::string& note) { ROS_WARN("%s", note.c_str()); }});
  config.publish_every = publishPeriod(reader, config.scenario.stepSize());
  config.world_frame = reader.has("world_frame") ? reader.text("world_frame") : kDefaultWorldFrame;
  if (config.world_frame.front() == '/') {
    reader.fail("world_frame", "must not begin with a slash (tf2)");
  }
  config.real_time_factor = reader.numberOr(config.real_time_factor, "real_time_factor",
                                            {isRealTimeFactor, kRealTimeFactorRuleText});
  config.paused = reader.flagOr(config.paused, "paused");
  config.clock = reader.flagOr(config.clock, "clock");
  config.clock_rate = reader.numberOr(config.clock_rate, "clock_rate", kClockRateRule);
  readLockstep(reader, config);
  config.diagnostic_period =
      reader.numberOr(config.diagnostic_period, "diagnostic_period", kDiagnosticPeriodRule);
  return config;
}

}  // namespace hovercraft_ros
