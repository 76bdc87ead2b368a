#include "hovercraft_sim/live/leave_graph.h"

#include <XmlRpcClient.h>
#include <XmlRpcValue.h>

#include <ros/master.h>
#include <ros/service_manager.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

namespace hovercraft_ros {
namespace {

/// Calls of one method for each topic, behind those that are there.
void append(XmlRpc::XmlRpcValue& calls, int& count, const char* method,
            const ros::V_string& topics) {
  for (const std::string& topic : topics) {
    XmlRpc::XmlRpcValue& call = calls[count++];
    call["methodName"] = method;
    call["params"][0] = ros::this_node::getName();
    call["params"][1] = topic;
    call["params"][2] = ros::XMLRPCManager::instance()->getServerURI();
  }
}

}  // namespace

void leaveGraph() {
  ros::ServiceManager::instance()->shutdown();
  ros::V_string published;
  ros::V_string subscribed;
  ros::this_node::getAdvertisedTopics(published);
  ros::this_node::getSubscribedTopics(subscribed);
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue& calls = request[0];
  int count = 0;
  append(calls, count, "unregisterPublisher", published);
  append(calls, count, "unregisterSubscriber", subscribed);
  if (count == 0) return;
  XmlRpc::XmlRpcClient master(ros::master::getHost().c_str(),
                              static_cast<int>(ros::master::getPort()), "/");
  XmlRpc::XmlRpcValue answer;
  master.execute("system.multicall", request, answer);
}

}  // namespace hovercraft_ros
