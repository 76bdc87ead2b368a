#include "hovercraft_sim/live/sensor_interface.h"

#include <tf2_msgs/TFMessage.h>
#include <type_traits>

namespace hovercraft_ros {
namespace {

constexpr std::uint32_t kSensorQueue = 1000;  // every sample belongs in a recording

}  // namespace

SensorInterface::SensorInterface(const ros::NodeHandle& handle, const LiveRun& run,
                                 const TfFrames& frames, const std::string& odometry_topic,
                                 bool latched)
    : run_(run), messages_(sensorMessages(run.simulation().scenario(), frames, odometry_topic)) {
  ros::NodeHandle root(handle);
  for (const SensorMessages& craft : messages_) {
    ros::NodeHandle space(handle, craft.name());
    std::vector<Publishers> publishers;
    for (const SensorMessage& sensor : craft.messages()) {
      Publishers own;
      std::visit(
          [&](const auto& message) {
            using Message = std::decay_t<decltype(message)>;
            own.message = space.advertise<Message>(sensor.topic, kSensorQueue, latched);
          },
          sensor.message);
      if (!sensor.velocity_topic.empty()) {
        own.velocity = space.advertise<geometry_msgs::TwistWithCovarianceStamped>(
            sensor.velocity_topic, kSensorQueue, latched);
      }
      publishers.push_back(own);
    }
    publishers_.push_back(publishers);
  }
  transforms_ = root.advertise<tf2_msgs::TFMessage>("/tf", kSensorQueue);
}

void SensorInterface::publish(const hovercraft::SensorSample& sample) {
  const Publishers& own = publishers_[sample.vehicle][sample.sensor];
  if (!own.message.isHeard() && !(own.velocity && own.velocity.isHeard()) &&
      !transforms_.isHeard()) {
    own.message.skip();
    if (own.velocity) own.velocity.skip();
    return;
  }
  SensorMessages& craft = messages_[sample.vehicle];
  const SensorMessage& filled = craft.fill(sample, run_.sampleStamp(sample.measured));
  std::visit([&own](const auto& message) { own.message.publish(message); }, filled.message);
  if (own.velocity) own.velocity.publish(filled.velocity);
  if (const auto transform = craft.transform(sample.sensor)) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(*transform);
    transforms_.publish(message);
  }
}

std::vector<std::string> SensorInterface::topics() const {
  std::vector<std::string> topics;
  for (const auto& craft : publishers_) {
    for (const Publishers& own : craft) {
      topics.push_back(own.message.topic());
      if (own.velocity) topics.push_back(own.velocity.topic());
    }
  }
  return topics;
}

std::vector<geometry_msgs::TransformStamped> SensorInterface::frames() const {
  std::vector<geometry_msgs::TransformStamped> all;
  for (const SensorMessages& craft : messages_) {
    const auto frames = craft.sensorFrames(run_.stampOf(1));
    all.insert(all.end(), frames.begin(), frames.end());
  }
  return all;
}

}  // namespace hovercraft_ros
