#include "hovercraft_sim/ros/node_config.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

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

hovercraft::Tick publishPeriod(const hovercraft::ConfigReader& reader, double step_size) {
  if (!reader.has("publish_rate")) {
    return std::max<hovercraft::Tick>(1, std::llround(1.0 / (kDefaultPublishRate * step_size)));
  }
  const double rate = reader.number("publish_rate", hovercraft::kPositive);
  const double steps = 1.0 / (rate * step_size);
  const hovercraft::Tick whole = std::llround(steps);
  if (whole < 1 || std::abs(steps - static_cast<double>(whole)) > kRateSlack * steps) {
    reader.fail("publish_rate",
                fmt::format("must divide the step rate of {:.9g} Hz", 1.0 / step_size));
  }
  return whole;
}

}  // namespace

NodeConfig parseNodeConfig(const YAML::Node& parameters, const std::string& node_name) {
  if (!parameters.IsMap() || !parameters["scenario"].IsDefined()) {
    throw std::invalid_argument(
        node_name +
        "/scenario: the parameter is missing; load a scenario with <rosparam "
        "command=\"load\" ns=\"scenario\" file=\"...\"/> inside the <node>, as sim.launch does");
  }
  const hovercraft::ConfigReader reader(parameters, node_name);
  reader.allowOnly({"scenario", "publish_rate", "world_frame", "diagnostic_period"});
  NodeConfig config;
  config.scenario = hovercraft::parseScenario(
      parameters["scenario"], {node_name + "/scenario", "", [](const std::string& package) {
                                 return ros::package::getPath(package);
                               }});
  config.publish_every = publishPeriod(reader, config.scenario.stepSize());
  config.world_frame = reader.has("world_frame") ? reader.text("world_frame") : kDefaultWorldFrame;
  if (config.world_frame.front() == '/') {
    reader.fail("world_frame", "must not begin with a slash (tf2)");
  }
  return config;
}

}  // namespace hovercraft_ros
