#include "hovercraft_sim/clients/node_ping.h"

#include <XmlRpcClient.h>
#include <XmlRpcValue.h>
#include <cstdint>

#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>

namespace hovercraft_ros {

bool answers(const std::string& node) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue answer;
  XmlRpc::XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, answer, uri, false)) return false;
  std::string host;
  std::uint32_t port = 0;
  if (uri.getType() != XmlRpc::XmlRpcValue::TypeString ||
      !ros::network::splitURI(static_cast<std::string>(uri), host, port)) {
    return false;
  }
  XmlRpc::XmlRpcValue self;
  self[0] = ros::this_node::getName();
  XmlRpc::XmlRpcClient client(host.c_str(), static_cast<int>(port), "/");
  return client.execute("getPid", self, answer);
}

}  // namespace hovercraft_ros
