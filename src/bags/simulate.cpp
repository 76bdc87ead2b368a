#include "hovercraft_sim/bags/simulate.h"

#include <fmt/format.h>
#include <stdexcept>

#include <ros/package.h>

#include "hovercraft_sim/bags/bag_writer.h"
#include "hovercraft_sim/bags/commands_bag.h"
#include "hovercraft_sim/messages/vehicle_messages.h"

namespace hovercraft_ros {
namespace {

class BagsAndPackages : public hovercraft::RosFiles {
 public:
  std::string packagePath(const std::string& package) override {
    return ros::package::getPath(package);
  }
  std::unique_ptr<hovercraft::CommandSource> openCommands(
      const std::string& path, const hovercraft::Scenario& scenario) override {
    return std::make_unique<BagCommandSource>(path, scenario);
  }
  std::unique_ptr<hovercraft::RunObserver> openOutput(const std::string& path,
                                                      const hovercraft::Scenario& scenario,
                                                      const std::string& truth_odom) override {
    return std::make_unique<BagWriter>(path, scenario, truth_odom);
  }
  void checkTruthOdom(const std::string& topic) override {
    if (isTopicForTruth(topic)) return;
    throw std::invalid_argument(fmt::format("--truth-odom = {}: {}", topic, kTruthOdomRuleText));
  }
};

}  // namespace

hovercraft::RosFiles& rosFiles() {
  static BagsAndPackages files;
  return files;
}

hovercraft::Scenario loadScenarioFile(const std::string& path,
                                      const hovercraft::OverrideList& overrides) {
  return hovercraft::loadScenarioFile(path, overrides, rosFiles());
}

std::unique_ptr<hovercraft::CommandSource> openCommands(const std::string& path,
                                                        const hovercraft::Scenario& scenario) {
  return hovercraft::openCommands(path, scenario, rosFiles());
}

std::unique_ptr<hovercraft::RunObserver> openOutput(const std::string& path,
                                                    const hovercraft::Scenario& scenario,
                                                    const std::string& truth_odom) {
  return hovercraft::openOutput(path, scenario, truth_odom, rosFiles());
}

hovercraft::RunSummary simulate(const SimulateRequest& request, std::ostream& messages) {
  return hovercraft::simulate(request, messages, rosFiles());
}

}  // namespace hovercraft_ros

hovercraft::RosFiles* hovercraftRosFiles() {
  return &hovercraft_ros::rosFiles();
}
