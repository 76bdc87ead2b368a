#include "hovercraft_sim/bags/commands_bag.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include <hovercraft_sim/ActuatorCommand.h>
#include <hovercraft_sim/AppliedCommand.h>
#include <hovercraft_sim/RunEvent.h>
#include <hovercraft_sim/ThrustCommand.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <std_msgs/Float32.h>
#include <std_msgs/Float64.h>

#include "hovercraft_sim/bags/bag_file.h"
#include "hovercraft_sim/bags/recorded_messages.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/run_events.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/scenario/actuator_topics.h"

namespace hovercraft_ros {

using hovercraft::Command;
using hovercraft::Tick;

namespace {

std::set<std::string> topicsIn(rosbag::View& view) {
  std::set<std::string> topics;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    topics.insert(connection->topic);
  }
  return topics;
}

/// What asked for an event: a service of the node.
const char* serviceOf(const hovercraft_sim::RunEvent& event) {
  switch (event.kind) {
    case hovercraft_sim::RunEvent::RESET:
      return "reset";
    case hovercraft_sim::RunEvent::LOAD:
      return "load";
    case hovercraft_sim::RunEvent::SET_STATE:
      return "set_state";
    case hovercraft_sim::RunEvent::APPLY_WRENCH:
      return "apply_wrench";
    case kSetWind:
      return "set_wind";
    default:
      return "set_actuator";  // readRunEvent() knows no other
  }
}

/// The commands alone of a run that something else changed as well make another one.
void refuseEvents(const std::string& path, const rosbag::Bag& bag) {
  rosbag::View events(
      bag, rosbag::TypeQuery(ros::message_traits::DataType<hovercraft_sim::RunEvent>::value()));
  rosbag::View::iterator first = events.begin();  // what it leads to is its own
  if (first == events.end()) return;
  const rosbag::MessageInstance& instance = *first;
  const auto event = readRunEvent(path, instance);
  failAt(path, instance,
         fmt::format("{} at tick {}: commands alone would make another flight; a bag with a "
                     "reset, a load or another event is for the tool replay",
                     serviceOf(*event), event->tick));
}

}  // namespace

/// What BagCommandSource::Streams is made of.
namespace streams_of_bag {

/// What is needed to make a message of one vehicle a command.
struct VehicleTopics {
  std::size_t vehicle;
  hovercraft::VehicleScenario craft;
  std::string applied;                        // AppliedCommand
  std::string thrust;                         // ThrustCommand
  std::string actuators;                      // ActuatorCommand
  std::map<std::string, std::size_t> levels;  // Float64 or Float32: ids of engines and actuators

  /// Those of commands as they were given.
  std::vector<std::string> given() const {
    std::vector<std::string> topics = {thrust};
    if (!craft.actuators.empty()) topics.push_back(actuators);
    for (const auto& [topic, id] : levels) topics.push_back(topic);
    return topics;
  }
};

std::vector<VehicleTopics> topicsOf(const hovercraft::Scenario& scenario) {
  std::vector<VehicleTopics> all;
  for (std::size_t vehicle = 0; vehicle < scenario.vehicles.size(); ++vehicle) {
    const std::string space = "/" + scenario.vehicles[vehicle].name + "/";
    const hovercraft::VehicleScenario& craft = scenario.vehicles[vehicle];
    VehicleTopics topics{
        vehicle, craft, space + kCommandsTopic, space + kThrustTopic, space + kActuatorCommandTopic,
        {}};
    for (std::size_t id = 0; id < hovercraft::kFirstActuator + craft.actuators.size(); ++id) {
      if (id < hovercraft::kFirstActuator && !craft.has_engine[id]) continue;
      topics.levels[hovercraft::absoluteTopic(craft, hovercraft::commandTopicOf(craft, id))] = id;
    }
    all.push_back(topics);
  }
  return all;
}

/// The commands of one vehicle, in the order in which the bag holds them.
class VehicleStream {
 public:
  VehicleStream(std::string path, const rosbag::Bag& bag, VehicleTopics topics,
                const std::vector<std::string>& chosen, std::int64_t step_ns, ros::Time begin)
      : path_(std::move(path)),
        topics_(std::move(topics)),
        step_ns_(step_ns),
        begin_(begin),
        view_(std::make_unique<rosbag::View>(bag, rosbag::TopicQuery(chosen))),
        next_(view_->begin()) {
    advance();
  }

  const std::optional<Command>& head() const { return head_; }

  void advance() {
    const Tick last = head_ ? head_->tick : 0;
    head_.reset();
    if (next_ == view_->end()) return;
    const rosbag::MessageInstance& message = *next_;
    head_ = commandOf(message);
    if (head_->tick < last) {
      failAt(path_, message,
             fmt::format("the command is for tick {}: must not be before tick {} of the one that "
                         "precedes it",
                         head_->tick, last));
    }
    ++next_;
  }

 private:
  Command commandOf(const rosbag::MessageInstance& message) {
    if (message.getTopic() == topics_.applied) return appliedOf(message);
    // Not as a ros::Duration, which has 32 bits for the seconds, one of them for the sign.
    const auto time_ns = static_cast<std::int64_t>(message.getTime().toNSec() - begin_.toNSec());
    Command command = askedBy(message);
    command.tick = hovercraft::firstTickAt(time_ns, step_ns_);
    return command;
  }

  /// @returns its tick is 0.
  Command askedBy(const rosbag::MessageInstance& message) {
    if (message.getTopic() == topics_.actuators) {
      const auto values = messageAs<hovercraft_sim::ActuatorCommand>(path_, message);
      const auto command = toCommand(*values, topics_.craft, topics_.vehicle);
      if (!command) {
        failAt(path_, message, "names and values must be of actuators, each once and finite");
      }
      return *command;
    }
    const std::optional<Command> command =
        message.getTopic() == topics_.thrust
            ? toCommand(*messageAs<hovercraft_sim::ThrustCommand>(path_, message), topics_.vehicle)
            : levelOf(message);
    if (!command) failAt(path_, message, "a thrust must be finite");
    return *command;
  }

  std::optional<Command> levelOf(const rosbag::MessageInstance& message) {
    const std::size_t id = topics_.levels.at(message.getTopic());
    const double value =
        hovercraft::isFloat32(topics_.craft, id)
            ? static_cast<double>(messageAs<std_msgs::Float32>(path_, message)->data)
            : messageAs<std_msgs::Float64>(path_, message)->data;
    return toCommand(value, id, topics_.vehicle);
  }

  Command appliedOf(const rosbag::MessageInstance& instance) {
    const auto message = readAppliedCommand(path_, instance, topics_.craft);
    if (first_episode_.value_or(message->episode) != message->episode) {
      failAt(path_, instance,
             fmt::format("episode {}: must be episode {} as before; a bag with a reset is for the "
                         "tool replay",
                         message->episode, *first_episode_));
    }
    first_episode_ = message->episode;
    return toCommand(*message, topics_.vehicle);
  }

  std::string path_;
  VehicleTopics topics_;
  std::int64_t step_ns_;
  ros::Time begin_;
  std::unique_ptr<rosbag::View> view_;
  rosbag::View::iterator next_;
  std::optional<Command> head_;
  std::optional<std::uint32_t> first_episode_;
};

}  // namespace streams_of_bag

class BagCommandSource::Streams {
  using VehicleStream = streams_of_bag::VehicleStream;
  using VehicleTopics = streams_of_bag::VehicleTopics;

 public:
  Streams(const std::string& path, const hovercraft::Scenario& scenario) {
    openForReading(bag_, path);
    rosbag::View everything(bag_);
    const std::set<std::string> present = topicsIn(everything);
    const std::vector<VehicleTopics> all = streams_of_bag::topicsOf(scenario);
    const bool has_applied = std::any_of(all.begin(), all.end(), [&](const VehicleTopics& topics) {
      return present.count(topics.applied) > 0;
    });
    for (const VehicleTopics& topics : all) {
      std::vector<std::string> wanted = {topics.applied};
      if (!has_applied) wanted = topics.given();
      std::vector<std::string> chosen;
      std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(chosen),
                   [&](const std::string& topic) { return present.count(topic) > 0; });
      if (chosen.empty()) continue;
      chosen_.insert(chosen_.end(), chosen.begin(), chosen.end());
      streams_.push_back(std::make_unique<VehicleStream>(
          path, bag_, topics, chosen, scenario.step_ns, everything.getBeginTime()));
    }
    if (streams_.empty()) {
      throw std::invalid_argument(
          fmt::format("{}: there are no commands in it: must have {}, or {} or one of its engines",
                      path, all.front().applied, all.front().thrust));
    }
    refuseEvents(path, bag_);
    description_ = fmt::format("{}", fmt::join(chosen_, ", "));
  }

  std::optional<Command> next() {
    VehicleStream* first = nullptr;
    for (const auto& stream : streams_) {
      if (!stream->head()) continue;
      if (first == nullptr || stream->head()->tick < first->head()->tick) first = stream.get();
    }
    if (first == nullptr) return std::nullopt;
    std::optional<Command> command = first->head();
    first->advance();
    return command;
  }

  const std::string& description() const { return description_; }

 private:
  rosbag::Bag bag_;
  std::vector<std::unique_ptr<VehicleStream>> streams_;
  std::vector<std::string> chosen_;
  std::string description_;
};

BagCommandSource::BagCommandSource(const std::string& path, const hovercraft::Scenario& scenario)
    : path_(path),
      streams_(readingBag(path, [&] { return std::make_unique<Streams>(path, scenario); })) {}

BagCommandSource::~BagCommandSource() = default;

std::optional<Command> BagCommandSource::next() {
  return readingBag(path_, [this] { return streams_->next(); });
}

const std::string& BagCommandSource::description() const {
  return streams_->description();
}

}  // namespace hovercraft_ros
