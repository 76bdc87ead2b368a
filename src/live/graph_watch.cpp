#include "hovercraft_sim/live/graph_watch.h"

#include <XmlRpcValue.h>
#include <fmt/format.h>
#include <optional>
#include <utility>

#include <ros/console.h>
#include <ros/master.h>
#include <ros/param.h>
#include <ros/this_node.h>

namespace hovercraft_ros {
namespace {

constexpr const char* kClockTopic = "/clock";
constexpr const char* kStaticFramesTopic = "/tf_static";
constexpr const char* kClockReason =
    "publishes /clock as well, and only one node may make the time: set clock to false here, or "
    "stop the other";
constexpr std::uint32_t kFramesQueue = 100;
constexpr std::uint32_t kWatchedClockQueue = 10;

std::string topicReason(const std::string& topic) {
  return "publishes " + topic +
         " as well: two simulations need namespaces of their own (<group ns=\"...\">), or other "
         "names for their craft";
}

/// None if the master does not answer.
std::optional<PublishersByTopic> askMaster() {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue state;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, state, false)) {
    return std::nullopt;
  }
  PublishersByTopic publishers;
  XmlRpc::XmlRpcValue& topics = state[0];
  for (int i = 0; i < topics.size(); ++i) {
    XmlRpc::XmlRpcValue& nodes = topics[i][1];
    auto& names = publishers[static_cast<std::string>(topics[i][0])];
    for (int k = 0; k < nodes.size(); ++k) names.insert(static_cast<std::string>(nodes[k]));
  }
  return publishers;
}

/// Why the stamps of a node that goes by the wall time do not fit; empty if they do.
std::string reasonOfForeignTime(const Claims& claims) {
  bool use_sim_time = false;
  ros::param::get("/use_sim_time", use_sim_time);
  if (claims.clock || !use_sim_time) return "";
  return "/use_sim_time is true, but this simulation does not publish /clock and goes by the wall "
         "time: its stamps do not fit the time of the other nodes. Run it with clock:=true and "
         "nobody else that publishes /clock, or say rosparam delete /use_sim_time";
}

}  // namespace

std::map<std::string, std::string> conflictsOf(const Claims& claims,
                                               const PublishersByTopic& publishers,
                                               const std::string& self) {
  std::map<std::string, std::string> conflicts;
  for (const auto& [topic, nodes] : publishers) {
    const bool is_clock = claims.clock && topic == kClockTopic;
    if (!is_clock && claims.topics.count(topic) == 0) continue;
    for (const std::string& node : nodes) {
      if (node != self) conflicts.emplace(node, is_clock ? kClockReason : topicReason(topic));
    }
  }
  return conflicts;
}

std::string claimedFrame(const Claims& claims, const tf2_msgs::TFMessage& transforms) {
  for (const auto& transform : transforms.transforms) {
    const std::string& frame = transform.child_frame_id;
    const std::string name = frame.rfind('/', 0) == 0 ? frame.substr(1) : frame;
    if (claims.frames.count(name) > 0) return name;
  }
  return "";
}

GraphWatch::GraphWatch(const ros::NodeHandle& handle, Claims claims)
    : claims_(std::move(claims)), foreign_time_(reasonOfForeignTime(claims_)) {
  ros::NodeHandle node(handle);
  frames_subscriber_ =
      node.subscribe(kStaticFramesTopic, kFramesQueue, &GraphWatch::onFrames, this);
  if (claims_.clock) {
    clock_subscriber_ = node.subscribe(kClockTopic, kWatchedClockQueue, &GraphWatch::onClock, this);
  }
  if (!foreign_time_.empty()) ROS_WARN("%s", foreign_time_.c_str());
  look();
}

/// Who is in conflict by what the master knows; whoever is gone is forgotten.
void GraphWatch::look() {
  const auto publishers = askMaster();
  if (!publishers) return;
  const auto now = conflictsOf(claims_, *publishers, ros::this_node::getName());
  const auto publishes = [&](const char* topic, const std::string& node) {
    const auto found = publishers->find(topic);
    return found != publishers->end() && found->second.count(node) > 0;
  };
  for (auto known = conflicts_.begin(); known != conflicts_.end();) {
    const bool stays = now.count(known->first) > 0 || publishes(kStaticFramesTopic, known->first);
    known = stays ? std::next(known) : conflicts_.erase(known);
  }
  for (const auto& [node, reason] : now) note(node, reason);
}

void GraphWatch::note(const std::string& node, const std::string& reason) {
  if (node == ros::this_node::getName() || !conflicts_.emplace(node, reason).second) return;
  ROS_WARN("%s %s", node.c_str(), reason.c_str());
}

void GraphWatch::onFrames(const ros::MessageEvent<const tf2_msgs::TFMessage>& event) {
  const std::string frame = claimedFrame(claims_, *event.getConstMessage());
  if (frame.empty()) return;
  note(event.getPublisherName(), "publishes the tf frame " + frame +
                                     " as well: two simulations in one tf tree need a tf_prefix "
                                     "each");
}

void GraphWatch::onClock(const ros::MessageEvent<const rosgraph_msgs::Clock>& event) {
  note(event.getPublisherName(), kClockReason);
}

void GraphWatch::report(diagnostic_updater::DiagnosticStatusWrapper& status) {
  using diagnostic_msgs::DiagnosticStatus;
  if (!conflicts_.empty()) look();
  status.summary(DiagnosticStatus::OK, "Nobody publishes the same");
  if (!foreign_time_.empty()) status.mergeSummary(DiagnosticStatus::WARN, foreign_time_);
  for (const auto& [node, reason] : conflicts_) {
    status.mergeSummary(DiagnosticStatus::WARN, fmt::format("{} {}", node, reason));
    status.add(node, reason);
  }
}

}  // namespace hovercraft_ros
