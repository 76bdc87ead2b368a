#include "recorded_flight.h"

#include <algorithm>
#include <csignal>
#include <fmt/format.h>
#include <map>
#include <stdexcept>
#include <unistd.h>

#include "wait_until.h"
#include "wires.h"

namespace hovercraft_ros::testing {
namespace {

// What the recorder must have received after the last message of interest before it is stopped: its
// ten threads have taken that one from the queue long before.
constexpr std::uint64_t kLaterMessages = 50;

std::string makeNodeName() {
  static int count = 0;
  return fmt::format("recorder_{}_{}", getpid(), ++count);
}

std::vector<std::string> recordCommand(const std::string& path, const std::string& name,
                                       const std::vector<std::string>& topics) {
  std::vector<std::string> command = {"rosrun", "rosbag", "record",       "-q",
                                      "-O",     path,     "--buffsize=0", "__name:=" + name};
  command.insert(command.end(), topics.begin(), topics.end());
  return command;
}

/// Messages that the simulation sent to each connection with the recorder, by topic.
std::map<std::string, std::uint64_t> sentTo(const std::string& recorder) {
  std::map<std::string, std::uint64_t> sent;
  for (const Link& link : linksOf(kSimulationNode)) {
    if (link.outgoing && link.peer == recorder) sent[link.topic] = link.messages;
  }
  return sent;
}

bool isConnected(const std::string& publisher, const std::string& topic,
                 const std::string& recorder) {
  const std::vector<Link> links = linksOf(publisher);
  return std::any_of(links.begin(), links.end(), [&](const Link& link) {
    return link.outgoing && link.topic == topic && link.peer == recorder;
  });
}

bool isConnectedToAll(const std::string& recorder, const std::string& topic) {
  const std::vector<std::string> publishers = publishersOf(topic);
  return std::all_of(publishers.begin(), publishers.end(), [&](const std::string& publisher) {
    return isConnected(publisher, topic, recorder);
  });
}

}  // namespace

std::vector<std::string> outputTopics(const std::vector<std::string>& vehicles) {
  std::vector<std::string> topics = {"/tf", "/tf_static", "/diagnostics", kScenarioTopic};
  for (const std::string& vehicle : vehicles) {
    for (const char* name : {"pose", "twist", "odom", "engines", "state", "commands"}) {
      topics.push_back("/" + vehicle + "/" + name);
    }
  }
  return topics;
}

RecordedFlight::RecordedFlight(const std::vector<std::string>& topics)
    : path_(folder_.path() + "/flight.bag"),
      recorder_name_("/" + makeNodeName()),
      recorder_(recordCommand(path_, recorder_name_.substr(1), topics)) {
  // The last topic that the simulation announces: before, one without a publisher would count as
  // connected.
  waitUntil("the simulation has announced its topics",
            [] { return !publishersOf(kScenarioTopic).empty(); });
  for (const std::string& topic : topics) {
    waitUntil("rosbag record is connected to " + topic, [&] {
      if (recorder_.hasEnded()) throw std::runtime_error("rosbag record could not be started");
      return isConnectedToAll(recorder_name_, topic);
    });
  }
}

Recording RecordedFlight::finish() {
  for (const auto& [topic, count] : sentTo(recorder_name_)) {
    const std::string& name = topic;
    const std::uint64_t wanted = count;
    waitUntil("rosbag record has received " + topic,
              [&] { return messagesReceived(recorder_name_, name) >= wanted; });
  }
  const std::uint64_t received = messagesReceived(recorder_name_);
  waitUntil("rosbag record has received what came later",
            [&] { return messagesReceived(recorder_name_) >= received + kLaterMessages; });
  recorder_.signal(SIGINT);
  waitUntil("rosbag record has closed its bag", [&] { return recorder_.hasEnded(); });
  if (recorder_.exitStatus() != 0) {
    throw std::runtime_error(fmt::format("rosbag record ended with {}", recorder_.exitStatus()));
  }
  return Recording(path_);
}

}  // namespace hovercraft_ros::testing
