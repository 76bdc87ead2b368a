#pragma once

#include <diagnostic_updater/diagnostic_updater.h>
#include <map>
#include <rosgraph_msgs/Clock.h>
#include <set>
#include <string>
#include <tf2_msgs/TFMessage.h>

#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// What only one node may publish.
struct Claims {
  std::set<std::string> topics;  // full names
  std::set<std::string> frames;  // children in tf
  bool clock = false;            // the time
};

/// Publishing nodes by topic, full names: the first part of the master's getSystemState.
using PublishersByTopic = std::map<std::string, std::set<std::string>>;

/// The nodes but `self` that publish a claimed topic, or a claimed /clock, with the reason why they
/// must not.
HOVERCRAFT_PUBLIC std::map<std::string, std::string> conflictsOf(
    const Claims& claims, const PublishersByTopic& publishers, const std::string& self);

/// The first claimed frame among the children of the transforms; empty if there is none.
HOVERCRAFT_PUBLIC std::string claimedFrame(const Claims& claims,
                                           const tf2_msgs::TFMessage& transforms);

/// Notices nodes that publish what this one claims, and a time that it does not go by. Each is said
/// once in the log, and in the diagnostics as long as it is there. The master is asked at the
/// start, and then while somebody is in conflict; else other nodes are heard of by their static
/// frames and their clock.
class HOVERCRAFT_PUBLIC GraphWatch {
 public:
  /// Call it when everything that is claimed has been advertised.
  GraphWatch(const ros::NodeHandle& handle, Claims claims);
  GraphWatch(const GraphWatch&) = delete;
  GraphWatch& operator=(const GraphWatch&) = delete;

  void report(diagnostic_updater::DiagnosticStatusWrapper& status);

 private:
  void look();
  void note(const std::string& node, const std::string& reason);
  void onFrames(const ros::MessageEvent<const tf2_msgs::TFMessage>& event);
  void onClock(const ros::MessageEvent<const rosgraph_msgs::Clock>& event);

  Claims claims_;
  std::map<std::string, std::string> conflicts_;  // reason by node
  std::string foreign_time_;                      // why its time is not that of the others
  ros::Subscriber frames_subscriber_;
  ros::Subscriber clock_subscriber_;
};

}  // namespace hovercraft_ros
