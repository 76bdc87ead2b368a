#include "hovercraft_sim/report/recorded_topics.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include <hovercraft_sim/State.h>
#include <hovercraft_sim/States.h>
#include <ros/serialization.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "hovercraft_sim/bags/bag_file.h"
#include "hovercraft_sim/bags/recorded_messages.h"
#include "hovercraft_sim/messages/vehicle_messages.h"

namespace hovercraft_ros {
namespace {

/// Types that say nothing as curves.
bool isPassedOver(const std::string& type) {
  static const std::set<std::string> types = {
      "tf2_msgs/TFMessage",
      "tf/tfMessage",
      "rosgraph_msgs/Clock",
      "rosgraph_msgs/Log",
      "diagnostic_msgs/DiagnosticArray",
      "dynamic_reconfigure/Config",
      "dynamic_reconfigure/ConfigDescription",
      "visualization_msgs/Marker",
      "visualization_msgs/MarkerArray",
      "visualization_msgs/InteractiveMarkerUpdate",
      "visualization_msgs/InteractiveMarkerInit",
      "nav_msgs/OccupancyGrid",
      "nav_msgs/Path",
      "sensor_msgs/Image",
      "sensor_msgs/CompressedImage",
      "sensor_msgs/CameraInfo",
      "sensor_msgs/PointCloud",
      "sensor_msgs/PointCloud2",
  };
  return types.count(type) > 0;
}

/// What a page shows of a message: not its header, which is the time, nor covariances.
bool isKept(const MessageLeaf& leaf) {
  const std::string& path = leaf.path;
  if (path == "header.stamp" || path == "header.seq" || path == "header.frame_id") return false;
  return path.find("covariance") == std::string::npos;
}

/// Takes the messages of one topic.
class TopicReader {
 public:
  explicit TopicReader(const rosbag::MessageInstance& first)
      : TopicReader(first.getTopic(), first.getDataType(), first.getMessageDefinition()) {}
  TopicReader(const std::string& topic, const std::string& type, std::string definition)
      : definition_(std::move(definition)), layout_(type, definition_) {
    samples_.topic = topic;
    samples_.type = type;
    stamp_ = layout_.find("header.stamp");
    for (std::size_t i = 0; i < layout_.leaves().size(); ++i) {
      if (!isKept(layout_.leaves()[i])) continue;
      kept_.push_back(i);
      samples_.leaves.push_back(layout_.leaves()[i]);
    }
    samples_.numbers.resize(kept_.size());
    samples_.texts.resize(kept_.size());
    samples_.last_integers.resize(kept_.size());
  }

  void add(const rosbag::MessageInstance& instance) {
    if (instance.getDataType() != samples_.type || instance.getMessageDefinition() != definition_) {
      throw std::invalid_argument("its messages must be of one type and one definition");
    }
    bytes_.resize(instance.size());
    ros::serialization::OStream stream(bytes_.data(), static_cast<std::uint32_t>(bytes_.size()));
    instance.write(stream);
    addBytes(instance.getTime());
  }

  /// A message that is not one of the bag by itself.
  template <class Message>
  void add(const Message& message, const ros::Time& received) {
    bytes_.resize(ros::serialization::serializationLength(message));
    ros::serialization::OStream stream(bytes_.data(), static_cast<std::uint32_t>(bytes_.size()));
    ros::serialization::serialize(stream, message);
    addBytes(received);
  }

  TopicSamples take() {
    sort();
    return std::move(samples_);
  }

 private:
  void addBytes(const ros::Time& received) {
    if (!layout_.read(bytes_.data(), bytes_.size(), values_)) {
      throw std::invalid_argument("a message is shorter than its definition");
    }
    const auto received_ns = static_cast<std::int64_t>(received.toNSec());
    const std::int64_t stamp_ns = stamp_ ? values_[*stamp_].integer : 0;
    samples_.received_ns.push_back(received_ns);
    samples_.stamps_ns.push_back(stamp_ns > 0 ? stamp_ns : received_ns);
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      const LeafValue& value = values_[kept_[i]];
      samples_.last_integers[i] = value.integer;
      if (samples_.leaves[i].kind == LeafKind::kText) {
        samples_.texts[i].emplace_back(value.text);
      } else {
        samples_.numbers[i].push_back(value.number);
      }
    }
  }

  void sort();

  std::string definition_;
  MessageLayout layout_;
  std::optional<std::size_t> stamp_;
  std::vector<std::size_t> kept_;
  std::vector<std::uint8_t> bytes_;
  std::vector<LeafValue> values_;
  TopicSamples samples_;
};

template <class Value>
void permute(std::vector<Value>& column, const std::vector<std::size_t>& order) {
  if (column.empty()) return;
  std::vector<Value> sorted;
  sorted.reserve(order.size());
  for (const std::size_t index : order) sorted.push_back(std::move(column[index]));
  column = std::move(sorted);
}

void TopicReader::sort() {
  const std::vector<std::int64_t>& stamps_ns = samples_.stamps_ns;
  if (std::is_sorted(stamps_ns.begin(), stamps_ns.end())) return;
  std::vector<std::size_t> order(stamps_ns.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return stamps_ns[a] < stamps_ns[b]; });
  for (auto& column : samples_.numbers) permute(column, order);
  for (auto& column : samples_.texts) permute(column, order);
  permute(samples_.received_ns, order);
  permute(samples_.stamps_ns, order);
}

/// Reads every message of an open bag.
class BagReader {
 public:
  BagReader(const rosbag::Bag& bag, const std::string& path) : view_(bag) {
    found_.path = path;
    for (const rosbag::ConnectionInfo* connection : view_.getConnections()) {
      topics_.insert(connection->topic);
    }
  }

  RecordedTopics read(const ReadingProgress& progress) {
    const auto whole = static_cast<std::int64_t>(view_.size());
    std::int64_t done = 0;
    for (const rosbag::MessageInstance& instance : view_) {
      if (progress) progress(done, whole);
      ++done;
      take(instance);
    }
    for (auto& [topic, reader] : readers_) found_.topics.emplace(topic, reader.take());
    return std::move(found_);
  }

 private:
  void take(const rosbag::MessageInstance& instance) {
    const std::string& topic = instance.getTopic();
    if (isPassedOver(instance.getDataType()) || refused_.count(topic) > 0) return;
    try {
      if (instance.getDataType() ==
          ros::message_traits::DataType<hovercraft_sim::States>::value()) {
        return takeFleet(instance);
      }
      auto reader = readers_.find(topic);
      if (reader == readers_.end()) {
        reader = readers_.emplace(topic, TopicReader(instance)).first;
      }
      reader->second.add(instance);
    } catch (const std::invalid_argument& error) {
      found_.notes.push_back(
          fmt::format("{} ({}) is left out: {}.", topic, instance.getDataType(), error.what()));
      refused_.insert(topic);
      readers_.erase(topic);
    }
  }

  /// The states of all craft in one message: of each that has no topic of its own, as if it had.
  void takeFleet(const rosbag::MessageInstance& instance) {
    const auto fleet = readStates(found_.path, instance);
    for (std::size_t i = 0; i < fleet->names.size(); ++i) {
      const std::string topic = "/" + fleet->names[i] + "/" + kStateTopic;
      if (topics_.count(topic) > 0) continue;
      auto reader = readers_.find(topic);
      if (reader == readers_.end()) {
        reader =
            readers_
                .emplace(topic,
                         TopicReader(
                             topic, ros::message_traits::DataType<hovercraft_sim::State>::value(),
                             ros::message_traits::Definition<hovercraft_sim::State>::value()))
                .first;
      }
      reader->second.add(fleet->states[i], instance.getTime());
    }
  }

  rosbag::View view_;
  std::set<std::string> topics_;  // of the bag
  std::map<std::string, TopicReader> readers_;
  std::set<std::string> refused_;
  RecordedTopics found_;
};

}  // namespace

const std::vector<double>* TopicSamples::column(const std::string& path) const {
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (leaves[i].path == path && leaves[i].kind != LeafKind::kText) return &numbers[i];
  }
  return nullptr;
}

const std::vector<std::string>* TopicSamples::textColumn(const std::string& path) const {
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    if (leaves[i].path == path && leaves[i].kind == LeafKind::kText) return &texts[i];
  }
  return nullptr;
}

const TopicSamples* RecordedTopics::find(const std::string& topic) const {
  const auto at = topics.find(topic);
  return at == topics.end() ? nullptr : &at->second;
}

RecordedTopics readTopics(const std::string& path, const ReadingProgress& progress) {
  rosbag::Bag bag;
  openForReading(bag, path);
  return readingBag(path, [&] { return BagReader(bag, path).read(progress); });
}

}  // namespace hovercraft_ros
