#include "wires.h"

#include <XmlRpc.h>
#include <map>

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>

namespace hovercraft_ros::testing {
namespace {

using XmlRpc::XmlRpcValue;

/// Calls a function of a node's slave API that takes the caller's name, or that and a reason; false
/// if the node cannot be reached.
bool call(const std::string& node, const std::string& function, XmlRpcValue& response) {
  XmlRpcValue request;
  XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, uri, false)) return false;
  std::string host;
  std::uint32_t port = 0;
  if (!ros::network::splitURI(static_cast<std::string>(uri), host, port)) return false;
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  XmlRpcValue parameters;
  parameters[0] = ros::this_node::getName();
  if (function == "shutdown") parameters[1] = "a test wants it";
  return client.execute(function.c_str(), parameters, response) && !client.isFault();
}

/// Adds the messages of each connection, by its number, from [[topic, ..., [[number, ...], ...]],
/// ...].
void readCounts(XmlRpcValue topics, int connections_at, int messages_at,
                std::map<int, std::uint64_t>& counts) {
  for (int i = 0; i < topics.size(); ++i) {
    XmlRpcValue& connections = topics[i][connections_at];
    for (int j = 0; j < connections.size(); ++j) {
      counts[static_cast<int>(connections[j][0])] =
          static_cast<std::uint64_t>(static_cast<int>(connections[j][messages_at]));
    }
  }
}

}  // namespace

std::vector<std::string> publishersOf(const std::string& topic) {
  XmlRpcValue request;
  XmlRpcValue response;
  XmlRpcValue state;
  request[0] = ros::this_node::getName();
  std::vector<std::string> nodes;
  if (!ros::master::execute("getSystemState", request, response, state, true)) return nodes;
  XmlRpcValue& published = state[0];
  for (int i = 0; i < published.size(); ++i) {
    if (static_cast<std::string>(published[i][0]) != topic) continue;
    for (int j = 0; j < published[i][1].size(); ++j) nodes.push_back(published[i][1][j]);
  }
  return nodes;
}

std::vector<Link> linksOf(const std::string& node) {
  XmlRpcValue info;
  XmlRpcValue statistics;
  std::vector<Link> links;
  if (!call(node, "getBusInfo", info) || !call(node, "getBusStats", statistics)) return links;
  // roscpp's [publications, subscriptions] tell of an outgoing connection [number, bytes, bytes,
  // messages, ...], of an incoming one [number, bytes, messages, ...].
  std::map<int, std::uint64_t> counts;
  readCounts(statistics[0], 1, 3, counts);
  readCounts(statistics[1], 1, 2, counts);
  // [status, text, [[number, peer, direction, transport, topic, ...], ...]]
  XmlRpcValue& connections = info[2];
  for (int i = 0; i < connections.size(); ++i) {
    XmlRpcValue& connection = connections[i];
    links.push_back({connection[4], connection[1], static_cast<std::string>(connection[2]) == "o",
                     counts[static_cast<int>(connection[0])]});
  }
  return links;
}

std::uint64_t messagesReceived(const std::string& node, const std::string& topic) {
  std::uint64_t count = 0;
  for (const Link& link : linksOf(node)) {
    if (!link.outgoing && (topic.empty() || link.topic == topic)) count += link.messages;
  }
  return count;
}

std::uint64_t messagesReceived(const std::string& node) {
  return messagesReceived(node, "");
}

void shutDown(const std::string& node) {
  XmlRpcValue none;
  call(node, "shutdown", none);
}

}  // namespace hovercraft_ros::testing
