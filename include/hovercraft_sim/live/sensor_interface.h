#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <ros/node_handle.h>

#include "hovercraft_sim/live/live_run.h"
#include "hovercraft_sim/live/topic_publisher.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/sensor_messages.h"

namespace hovercraft_ros {

/// The topics of the sensors of all craft.
class HOVERCRAFT_PUBLIC SensorInterface {
 public:
  /// @param handle of the namespace that the craft's namespaces lie in. @param odometry_topic as
  /// SensorMessages. @param latched who subscribes late gets the last sample, as in lockstep.
  SensorInterface(const ros::NodeHandle& handle, const LiveRun& run, const TfFrames& frames,
                  const std::string& odometry_topic, bool latched);
  SensorInterface(const SensorInterface&) = delete;
  SensorInterface& operator=(const SensorInterface&) = delete;

  void publish(const hovercraft::SensorSample& sample);

  /// Full names of the topics that nobody else may publish.
  std::vector<std::string> topics() const;
  /// base_link -> sensors, of all craft.
  std::vector<geometry_msgs::TransformStamped> frames() const;

 private:
  struct Publishers {
    TopicPublisher message;
    TopicPublisher velocity;
  };

  const LiveRun& run_;
  std::vector<SensorMessages> messages_;             // of each craft
  std::vector<std::vector<Publishers>> publishers_;  // of each craft and sensor
  TopicPublisher transforms_;
};

}  // namespace hovercraft_ros
