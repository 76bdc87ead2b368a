#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// The connections between nodes, as the master and the nodes themselves tell them (the ROS master
/// and slave APIs, which rosnode info shows).

namespace hovercraft_ros::testing {

/// One end of a connection.
struct Link {
  std::string topic;
  std::string peer;  // outgoing: name of the subscriber; incoming: URI of the publisher
  bool outgoing = false;
  std::uint64_t messages = 0;  // sent or received so far
};

/// The nodes that publish the topic (its full name).
std::vector<std::string> publishersOf(const std::string& topic);

/// Every connection of a node; none if it cannot be reached.
std::vector<Link> linksOf(const std::string& node);

/// Messages that a node has received so far.
std::uint64_t messagesReceived(const std::string& node, const std::string& topic);
std::uint64_t messagesReceived(const std::string& node);

/// Asks a node to shut down, as rosnode kill does.
void shutDown(const std::string& node);

}  // namespace hovercraft_ros::testing
