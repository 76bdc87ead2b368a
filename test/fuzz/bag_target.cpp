#include <fstream>
#include <stdexcept>
#include <string>

#include "hovercraft_sim/bags/commands_bag.h"
#include "hovercraft_sim/bags/recording_reader.h"
#include "hovercraft_sim/bags/trajectory_file.h"
#include "hovercraft_sim/scenario/scenario_parser.h"

#include "memory_file.h"
#include "targets.h"

namespace hovercraft::fuzz {
namespace {

constexpr const char* kCraft = R"(step_size: 0.01
model: planar
vehicles:
  craft:
    mass: 2
    inertia: {ixx: 0.5, iyy: 0.5, izz: 0.5}
    engines:
      rear: {position: [-1, 0, 0], direction: [1, 0, 0], min_thrust: -10, max_thrust: 10}
      left: {position: [1, 0, 0], direction: [0, -1, 0], min_thrust: -10, max_thrust: 10}
      right: {position: [1, 0, 0], direction: [0, 1, 0], min_thrust: -10, max_thrust: 10}
)";

template <class Read>
void answer(const Read& read) {
  try {
    read();
  } catch (const std::invalid_argument&) {  // it names what is wrong
  }
}

}  // namespace

void readBag(const std::string& input) {
  static const Scenario scenario = parseScenario(treeOf(kCraft, "craft"), {"craft", "", {}});
  const MemoryFile file(input);
  answer([&] { hovercraft_ros::readRecording(file.path()); });
  answer([&] { hovercraft_ros::readBagTrajectories(file.path()); });
  answer([&] {
    hovercraft_ros::BagCommandSource commands(file.path(), scenario);
    while (commands.next()) {
    }
  });
}

}  // namespace hovercraft::fuzz
