#include "recording.h"

#include <algorithm>
#include <stdexcept>

#include <hovercraft_sim/AppliedCommand.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

#include "recorded_flight.h"

namespace hovercraft_ros::testing {

hovercraft::Scenario Recording::scenario() const {
  const auto texts = messages<std_msgs::String>(kScenarioTopic);
  if (texts.size() != 1) throw std::runtime_error("the bag must hold the scenario once");
  return hovercraft::parseScenario(texts[0].data, {kScenarioTopic, "", {}});
}

std::vector<hovercraft::Command> Recording::commands(const hovercraft::Scenario& scenario) const {
  std::vector<hovercraft::Command> commands;
  for (std::size_t vehicle = 0; vehicle < scenario.vehicles.size(); ++vehicle) {
    const std::string topic = "/" + scenario.vehicles[vehicle].name + "/commands";
    for (const auto& message : messages<hovercraft_sim::AppliedCommand>(topic)) {
      commands.push_back(toCommand(message, vehicle));
    }
  }
  std::stable_sort(commands.begin(), commands.end(),
                   [](const auto& a, const auto& b) { return a.tick < b.tick; });
  return commands;
}

}  // namespace hovercraft_ros::testing
