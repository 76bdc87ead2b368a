#include "hovercraft_sim/bags/recorded_samples.h"

#include <algorithm>
#include <fmt/format.h>
#include <type_traits>
#include <utility>

#include <ros/serialization.h>
#include <rosbag/view.h>

#include "hovercraft_sim/bags/bag_file.h"
#include "hovercraft_sim/bags/recorded_messages.h"
#include "hovercraft_sim/messages/vehicle_messages.h"

namespace hovercraft_ros {
namespace {

std::uint64_t digestOfBytes(const std::vector<std::uint8_t>& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const std::uint8_t byte : bytes) {
    hash ^= byte;
    hash *= 0x100000001b3ULL;
  }
  return hash;
}

void forgetFrames(nav_msgs::Odometry& message) {
  message.child_frame_id.clear();
}
template <class Message>
void forgetFrames(Message& /*message*/) {}

template <class Message>
std::uint64_t digestOf(Message message) {
  message.header.seq = 0;
  message.header.frame_id.clear();
  forgetFrames(message);
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return digestOfBytes(bytes);
}

/// The ends of all topics on which sensors publish.
std::vector<std::string> endsOf(const std::vector<SensorMessages>& craft) {
  std::vector<std::string> ends;
  for (const SensorMessages& messages : craft) {
    const std::string space = "/" + messages.name() + "/";
    for (const SensorMessage& message : messages.messages()) {
      ends.push_back(space + message.topic);
      if (!message.velocity_topic.empty()) ends.push_back(space + message.velocity_topic);
      if (message.topic == kOdometryTopic) ends.push_back(space + kOdomTopic);
    }
  }
  return ends;
}

/// Reads the messages of one topic of one sensor.
class TopicReader {
 public:
  /// @param ends of all sensors' topics: a topic is of the longest one that fits.
  TopicReader(const std::string& path, const rosbag::Bag& bag, std::vector<std::string> ends,
              std::vector<RecordedSample>& samples)
      : path_(path), bag_(bag), ends_(std::move(ends)), samples_(samples) {}

  /// @param end of the topic's full name. @param frame_end of the frame that the messages have;
  /// empty: any.
  template <class Message>
  void read(const std::string& end, const RecordedSample& of, const std::string& frame_end = "") {
    rosbag::View view(bag_, rosbag::TypeQuery(ros::message_traits::DataType<Message>::value()));
    for (const rosbag::MessageInstance& instance : view) {
      if (!isOf(instance.getTopic(), end)) continue;
      const auto message = messageAs<Message>(path_, instance);
      if (!endsWith(message->header.frame_id, frame_end)) continue;
      RecordedSample sample = of;
      sample.stamp_ns = message->header.stamp.toNSec();
      sample.digest = digestOf(*message);
      samples_.push_back(sample);
    }
  }

 private:
  /// A craft may have a sensor of its own name: then .../a/a/imu/data ends in /a/imu/data too.
  bool isOf(const std::string& topic, const std::string& end) const {
    return endsWith(topic, end) &&
           std::none_of(ends_.begin(), ends_.end(), [&](const std::string& other) {
             return other.size() > end.size() && endsWith(topic, other);
           });
  }

  const std::string& path_;
  const rosbag::Bag& bag_;
  std::vector<std::string> ends_;
  std::vector<RecordedSample>& samples_;
};

}  // namespace

std::vector<RecordedSample> readSamples(const std::string& path, const rosbag::Bag& bag,
                                        const hovercraft::Scenario& scenario) {
  std::vector<RecordedSample> samples;
  const std::vector<SensorMessages> craft = sensorMessages(scenario, TfFrames());
  TopicReader reader(path, bag, endsOf(craft), samples);
  for (std::size_t vehicle = 0; vehicle < craft.size(); ++vehicle) {
    const std::string space = "/" + craft[vehicle].name() + "/";
    const auto& messages = craft[vehicle].messages();
    for (std::size_t sensor = 0; sensor < messages.size(); ++sensor) {
      RecordedSample of;
      of.vehicle = vehicle;
      of.sensor = sensor;
      std::visit(
          [&](const auto& message) {
            reader.read<std::decay_t<decltype(message)>>(space + messages[sensor].topic, of);
          },
          messages[sensor].message);
      if (messages[sensor].topic == kOdometryTopic) {
        reader.read<nav_msgs::Odometry>(space + kOdomTopic, of, space.substr(1) + kOdometryFrame);
      }
      if (messages[sensor].velocity_topic.empty()) continue;
      of.is_velocity = true;
      reader.read<geometry_msgs::TwistWithCovarianceStamped>(
          space + messages[sensor].velocity_topic, of);
    }
  }
  return samples;
}

SampleComparison::SampleComparison(const std::vector<RecordedSample>& recorded,
                                   const hovercraft::Scenario& scenario)
    : messages_(sensorMessages(scenario, TfFrames())) {
  for (const RecordedSample& sample : recorded) {
    recorded_[{sample.stamp_ns, sample.vehicle, sample.sensor, sample.is_velocity}].digest =
        sample.digest;
  }
}

void SampleComparison::add(const hovercraft::SensorSample& sample, std::uint64_t stamp_ns) {
  if (recorded_.empty()) return;
  ros::Time stamp;
  stamp.fromNSec(stamp_ns);
  const SensorMessage& filled = messages_[sample.vehicle].fill(sample, stamp);
  const Key key = {stamp_ns, sample.vehicle, sample.sensor, false};
  compare(key, std::visit([](const auto& message) { return digestOf(message); }, filled.message));
  if (filled.velocity_topic.empty()) return;
  compare({stamp_ns, sample.vehicle, sample.sensor, true}, digestOf(filled.velocity));
}

SampleComparison::Difference SampleComparison::differenceAt(const Key& key) const {
  const auto& [stamp_ns, vehicle, sensor, is_velocity] = key;
  const SensorMessage& message = messages_[vehicle].messages()[sensor];
  return {stamp_ns, messages_[vehicle].name(), is_velocity ? message.velocity_topic : message.topic,
          fmt::format("{:016x}", recorded_.at(key).digest), "nothing"};
}

void SampleComparison::compare(const Key& key, std::uint64_t digest) {
  const auto found = recorded_.find(key);
  if (found == recorded_.end()) return;
  found->second.found = true;
  ++compared_;
  if (found->second.digest == digest || difference_) return;
  difference_ = differenceAt(key);
  difference_->replayed = fmt::format("{:016x}", digest);
}

std::optional<SampleComparison::Difference> SampleComparison::missing(std::uint64_t begin_ns,
                                                                      std::uint64_t end_ns) const {
  for (auto entry = recorded_.lower_bound(Key{begin_ns + 1, 0, 0, false});
       entry != recorded_.end() && std::get<0>(entry->first) <= end_ns; ++entry) {
    if (!entry->second.found) return differenceAt(entry->first);
  }
  return std::nullopt;
}

}  // namespace hovercraft_ros
