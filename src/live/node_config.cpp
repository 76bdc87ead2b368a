#include "hovercraft_sim/live/node_config.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <ros/console.h>
#include <ros/package.h>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/scenario/actuator_topics.h"
#include "hovercraft_sim/scenario/config_reader.h"
#include "hovercraft_sim/scenario/scenario_names.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/step_time.h"

namespace hovercraft_ros {
namespace {

constexpr double kDefaultPublishRate = 100.0;  // Hz

hovercraft::Tick publishPeriod(const hovercraft::ConfigReader& reader, double step_size) {
  if (!reader.has("publish_rate")) {
    return std::max<hovercraft::Tick>(1, std::llround(1.0 / (kDefaultPublishRate * step_size)));
  }
  const double rate = reader.number("publish_rate", hovercraft::kPositive);
  const auto steps = hovercraft::wholeSteps(1.0 / (rate * step_size));
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

/// A parameter that is true or false, in the words of YAML 1.1 and as the numbers that roslaunch's
/// `if` takes.
bool switchOr(bool fallback, const hovercraft::ConfigReader& reader, const char* key) {
  static const std::map<std::string, bool> words = {{"true", true}, {"1", true},      {"yes", true},
                                                    {"on", true},   {"false", false}, {"0", false},
                                                    {"no", false},  {"off", false}};
  if (!reader.has(key)) return fallback;
  std::string word = reader.text(key);
  std::transform(word.begin(), word.end(), word.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = words.find(word);
  if (found == words.end()) reader.fail(key, "must be true or false (or 1, 0, yes, no, on, off)");
  return found->second;
}

constexpr const char* kMissingScenario =
    "the parameter is missing: give the text of a scenario file by <param name=\"scenario\" "
    "textfile=\"FILE\"/> inside the <node>, as sim.launch does, or the path of one on the node's "
    "machine as scenario_file";
constexpr const char* kScenarioTree =
    "must be the text of a scenario file; since version 0.2.0 its tree is refused, as a parameter "
    "server loses part of it: write <param name=\"scenario\" textfile=\"FILE\"/> in the place of "
    "<rosparam command=\"load\" ns=\"scenario\" file=\"FILE\"/>";

std::string packageFolder(const std::string& package) {
  return ros::package::getPath(package);
}

void warn(const std::string& note) {
  ROS_WARN("%s", note.c_str());
}

/// A path of the node's machine, whose working folder nobody knows.
std::string absolutePath(const hovercraft::ConfigReader& reader, const char* key) {
  const std::string path = reader.text(key);
  if (path.front() != '/') reader.fail(key, "must be an absolute path");
  return path;
}

hovercraft::OverrideList readOverrides(const hovercraft::ConfigReader& reader,
                                       const hovercraft::ConfigNode& parameters) {
  const hovercraft::ConfigNode* const set = parameters.find("set");
  if (set == nullptr || set->isNull()) return {};
  if (!set->isText()) reader.fail("set", "must be a text: KEY.PATH=VALUE; KEY.PATH=VALUE");
  return {reader.source() + "/set", {set->text()}};
}

hovercraft::Scenario readScenario(const hovercraft::ConfigReader& reader,
                                  const hovercraft::ConfigNode& parameters) {
  const std::string name = reader.source() + "/scenario";
  const hovercraft::ConfigNode* const text = parameters.find("scenario");
  if (text != nullptr && !text->isText()) throw std::invalid_argument(name + ": " + kScenarioTree);
  const hovercraft::OverrideList overrides = readOverrides(reader, parameters);
  const hovercraft::ConfigNode* const folder = parameters.find("scenario_dir");
  const bool has_folder = folder != nullptr && !(folder->isText() && folder->text().empty());
  if (reader.has("scenario_file")) {
    if (text != nullptr) reader.fail("scenario_file", "must not stand beside scenario: give one");
    if (has_folder) reader.fail("scenario_dir", "belongs to scenario: a file has its own folder");
    return hovercraft::loadScenario(absolutePath(reader, "scenario_file"), packageFolder, overrides,
                                    warn);
  }
  if (text == nullptr) throw std::invalid_argument(name + ": " + kMissingScenario);
  return hovercraft::parseScenario(
      text->text(),
      {name, has_folder ? absolutePath(reader, "scenario_dir") : "", packageFolder, warn},
      overrides);
}

/// Topics and parameters of a craft lie below its name, those of the node below its own: its
/// robot_description would be a parameter of the node, and of the next one of that name.
void requireOtherNames(const hovercraft::Scenario& scenario, const std::string& node_name) {
  const std::string own = node_name.substr(node_name.rfind('/') + 1);
  const auto check = [&](const char* list, const std::vector<hovercraft::VehicleScenario>& bodies) {
    for (const hovercraft::VehicleScenario& body : bodies) {
      if (body.name != own) continue;
      throw std::invalid_argument(
          fmt::format("{}/scenario: {}.{}: must not have the name of the node, below which its own "
                      "parameters and topics lie: rename it, or the node (__name:=NAME)",
                      node_name, list, body.name));
    }
  };
  check("vehicles", scenario.vehicles);
  if (scenario.world) check("world.bodies", scenario.world->bodies);
}

void readLockstep(const hovercraft::ConfigReader& reader, NodeConfig& config) {
  config.lockstep = switchOr(config.lockstep, reader, "lockstep");
  config.lockstep_timeout =
      reader.numberOr(config.lockstep_timeout, "lockstep_timeout", hovercraft::kPositive);
  config.control_period = config.publish_every;
  if (!reader.has("control_period")) return;
  const double step_size = config.scenario.stepSize();
  const auto steps =
      hovercraft::wholeSteps(reader.number("control_period", hovercraft::kPositive) / step_size);
  if (!steps) {
    reader.fail("control_period",
                fmt::format("must be a whole number of steps of {:.9g} s", step_size));
  }
  if (!config.lockstep) {
    reader.fail("control_period", "has a meaning in lockstep only: set lockstep or leave it out");
  }
  config.control_period = *steps;
}

void readMap(const hovercraft::ConfigReader& reader, NodeConfig& config) {
  config.map_resolution =
      reader.numberOr(config.map_resolution, "map_resolution", hovercraft::kPositive);
  if (reader.has("map_height")) {
    config.map_height = reader.number("map_height", hovercraft::kCoordinate);
  } else if (reader.has("map_resolution")) {
    reader.fail("map_resolution", "has a meaning with map_height only");
  }
}

/// A topic below the namespace of each craft.
std::string readTruthOdom(const hovercraft::ConfigReader& reader, const NodeConfig& config) {
  if (!reader.has("truth_odom")) return config.truth_odom;
  const std::string topic = reader.text("truth_odom");
  const auto& vehicles = config.scenario.vehicles;
  const bool is_free =
      std::all_of(vehicles.begin(), vehicles.end(), [&](const hovercraft::VehicleScenario& craft) {
        return !hovercraft::isCommandTopic(config.scenario, absoluteTopic(craft, topic));
      });
  if (!isTopicForTruth(topic) || !is_free) reader.fail("truth_odom", kTruthOdomRuleText);
  return topic;
}

TfFrames readFrames(const hovercraft::ConfigReader& reader) {
  TfFrames frames;
  if (reader.has("world_frame")) frames.world = reader.text("world_frame");
  if (frames.world.front() == '/') reader.fail("world_frame", "must not begin with a slash (tf2)");
  if (!reader.has("tf_prefix")) return frames;
  frames.prefix = reader.text("tf_prefix");
  if (frames.prefix.front() == '/' || frames.prefix.back() == '/') {
    reader.fail("tf_prefix", "must not begin or end with a slash");
  }
  return frames;
}

}  // namespace

const char* const kRealTimeFactorRuleText = "must be 0 (as fast as it can) or 1e-6 to 1000";

bool isRealTimeFactor(double factor) {
  return factor == 0.0 ||
         (factor >= NodeConfig::kMinRealTimeFactor && factor <= NodeConfig::kMaxRealTimeFactor);
}

NodeConfig parseNodeConfig(const hovercraft::ConfigNode& parameters, const std::string& node_name) {
  const hovercraft::FloatingPointEnvironment environment;
  const hovercraft::ConfigReader reader(parameters, node_name);
  reader.allowOnly({"scenario", "scenario_dir", "scenario_file", "set", "publish_rate",
                    "world_frame", "tf_prefix", "truth_odom", "map_height", "map_resolution",
                    "real_time_factor", "paused", "clock", "clock_rate", "lockstep",
                    "control_period", "lockstep_timeout", "diagnostic_period"});
  NodeConfig config;
  config.scenario = readScenario(reader, parameters);
  requireOtherNames(config.scenario, node_name);
  config.publish_every = publishPeriod(reader, config.scenario.stepSize());
  config.frames = readFrames(reader);
  config.truth_odom = readTruthOdom(reader, config);
  readMap(reader, config);
  config.real_time_factor = reader.numberOr(config.real_time_factor, "real_time_factor",
                                            {isRealTimeFactor, kRealTimeFactorRuleText});
  config.paused = switchOr(config.paused, reader, "paused");
  config.clock = switchOr(config.clock, reader, "clock");
  config.clock_rate = reader.numberOr(config.clock_rate, "clock_rate", kClockRateRule);
  readLockstep(reader, config);
  config.diagnostic_period =
      reader.numberOr(config.diagnostic_period, "diagnostic_period", kDiagnosticPeriodRule);
  return config;
}

}  // namespace hovercraft_ros
