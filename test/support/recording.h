#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/command_log.h"

namespace hovercraft_ros::testing {

/// What rosbag record left.
class Recording {
 public:
  explicit Recording(const std::string& path)
      : bag_(std::make_shared<rosbag::Bag>(path, rosbag::bagmode::Read)) {}

  /// The messages of a topic (its full name), in the order in which they were recorded.
  /// @throws std::runtime_error if one is of another type.
  template <class Message>
  std::vector<Message> messages(const std::string& topic) const {
    std::vector<Message> result;
    rosbag::View view(*bag_, rosbag::TopicQuery(topic));
    for (const rosbag::MessageInstance& instance : view) {
      const auto message = instance.instantiate<Message>();
      if (message == nullptr)
        throw std::runtime_error(topic + " carries a " + instance.getDataType());
      result.push_back(*message);
    }
    return result;
  }

  /// The scenario that explains the bag: the latched text, parsed.
  hovercraft::Scenario scenario() const;

  /// Every command that the simulation accepted, by tick.
  std::vector<hovercraft::Command> commands(const hovercraft::Scenario& scenario) const;

 private:
  std::shared_ptr<const rosbag::Bag> bag_;
};

}  // namespace hovercraft_ros::testing
