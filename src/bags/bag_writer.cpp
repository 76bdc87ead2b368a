#include "hovercraft_sim/bags/bag_writer.h"

#include <algorithm>
#include <boost/make_shared.hpp>
#include <fmt/format.h>
#include <stdexcept>
#include <vector>

#include <ros/datatypes.h>
#include <ros/message_traits.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/messages/manoeuvre_messages.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros {
namespace {

constexpr const char* kScenarioTopic = "/hovercraft_sim/scenario";  // the node's ~scenario
constexpr const char* kEventsTopic = "/hovercraft_sim/events";      // the node's ~events
constexpr const char* kContactsTopic = "/hovercraft_sim/contacts";  // the node's ~contacts

std::invalid_argument writeError(const std::string& path, const rosbag::BagException& error) {
  return std::invalid_argument(fmt::format("{}: cannot be written: {}", path, error.what()));
}

/// The header of a latched topic, so that rosbag play latches it again.
template <class Message>
boost::shared_ptr<ros::M_string> latchedHeader(const Message& message) {
  auto header = boost::make_shared<ros::M_string>();
  (*header)["type"] = ros::message_traits::datatype(message);
  (*header)["md5sum"] = ros::message_traits::md5sum(message);
  (*header)["message_definition"] = ros::message_traits::definition(message);
  (*header)["latching"] = "1";
  return header;
}

}  // namespace

BagWriter::BagWriter(const std::string& path, const hovercraft::Scenario& scenario,
                     const std::string& truth_odom)
    : file_(path),
      bag_(new rosbag::Bag),
      step_ns_(scenario.step_ns),
      bodies_(bodyMessages(scenario, TfFrames())),
      sensors_(sensorMessages(scenario, TfFrames(),
                              truth_odom == kOdomTopic ? kOdometryTopic : kOdomTopic)),
      truth_odom_(truth_odom) {
  for (std::size_t vehicle = 0; vehicle < scenario.vehicles.size(); ++vehicle) {
    vehicles_.emplace_back(scenario, vehicle);
  }
  try {
    bag_->open(file_.openablePath(), rosbag::bagmode::Write);
    // Less is written, and less often: rosbag seeks before each message, which empties the buffer
    // of what is not compressed.
    bag_->setCompression(rosbag::compression::LZ4);
  } catch (const rosbag::BagException& error) {
    throw writeError(file_.path(), error);
  }
  writeConstants(scenario);
}

void BagWriter::BagDeleter::operator()(rosbag::Bag* bag) const {
  try {
    bag->close();
  } catch (const rosbag::BagException&) {
    // Why was thrown to whoever wrote last. The list keeps the bag in reach: it is no leak that
    // grows unseen.
    static auto& undeletable = *new std::vector<rosbag::Bag*>;
    undeletable.push_back(bag);
    return;
  }
  delete bag;
}

ros::Time BagWriter::stampOfTick(hovercraft::Tick tick) const {
  return stampOf(ros::Time(), std::max(epoch_ns_ + tick * step_ns_, step_ns_));
}

std::string BagWriter::topic(const VehicleMessages& messages, const char* name) const {
  return "/" + messages.name() + "/" + name;
}

template <class Message>
void BagWriter::write(const std::string& topic, const ros::Time& stamp, const Message& message,
                      bool latched) {
  try {
    bag_->write(topic, stamp, message,
                latched ? latchedHeader(message) : boost::shared_ptr<ros::M_string>());
  } catch (const rosbag::BagException& error) {
    throw writeError(file_.path(), error);
  }
}

void BagWriter::writeConstants(const hovercraft::Scenario& scenario) {
  const ros::Time stamp = stampOfTick(1);
  std_msgs::String text;
  text.data = hovercraft::toYaml(scenario);
  write(kScenarioTopic, stamp, text, true);
  tf2_msgs::TFMessage frames;
  for (const VehicleMessages& messages : vehicles_) {
    const auto engines = messages.engineFrames(stamp);
    frames.transforms.insert(frames.transforms.end(), engines.begin(), engines.end());
  }
  for (const SensorMessages& sensors : sensors_) {
    const auto own = sensors.sensorFrames(stamp);
    frames.transforms.insert(frames.transforms.end(), own.begin(), own.end());
  }
  write("/tf_static", stamp, frames, true);
}

void BagWriter::state(const hovercraft::Simulation& simulation) {
  if (epoch_ns_ + simulation.timeNs() == 0) return;
  const ros::Time stamp = stampOfTick(simulation.tick());
  transforms_.transforms.clear();
  for (VehicleMessages& messages : vehicles_) {
    messages.fill(simulation, {stamp, episode_, events_});
    write(topic(messages, kPoseTopic), stamp, messages.pose());
    write(topic(messages, kTwistTopic), stamp, messages.twist());
    write(topic(messages, truth_odom_.c_str()), stamp, messages.odom());
    write(topic(messages, kEnginesTopic), stamp, messages.engines());
    if (messages.hasActuators()) {
      write(topic(messages, kActuatorsTopic), stamp, messages.actuators());
    }
    write(topic(messages, kStateTopic), stamp, messages.state());
    write(topic(messages, kWindTopic), stamp, messages.wind());
    if (messages.hasCushion()) write(topic(messages, kCushionTopic), stamp, messages.cushion());
    if (messages.hasTransform()) transforms_.transforms.push_back(messages.transform());
  }
  for (BodyMessages& messages : bodies_) {
    messages.fill(simulation, stamp);
    write("/" + messages.name() + "/" + kPoseTopic, stamp, messages.pose());
    transforms_.transforms.push_back(messages.transform());
  }
  if (!transforms_.transforms.empty()) write("/tf", stamp, transforms_);
}

void BagWriter::applied(const hovercraft::Command& command) {
  VehicleMessages& messages = vehicles_[command.vehicle];
  const ros::Time stamp = stampOfTick(command.tick);
  write(topic(messages, kCommandsTopic), stamp,
        messages.appliedCommand(command, {stamp, episode_, events_}));
}

void BagWriter::contact(const hovercraft::ContactEvent& event) {
  write(kContactsTopic, stampOfTick(event.tick),
        toMessage(event, epoch_ns_, episode_, kDefaultWorldFrame));
}

void BagWriter::sample(const hovercraft::SensorSample& sample) {
  SensorMessages& craft = sensors_[sample.vehicle];
  const SensorMessage& filled = craft.fill(sample, stampOfTick(sample.measured));
  const ros::Time received = stampOfTick(sample.delivered);
  const std::string space = "/" + craft.name() + "/";
  std::visit([&](const auto& message) { write(space + filled.topic, received, message); },
             filled.message);
  if (!filled.velocity_topic.empty()) {
    write(space + filled.velocity_topic, received, filled.velocity);
  }
  if (const auto transform = craft.transform(sample.sensor)) {
    tf2_msgs::TFMessage message;
    message.transforms.push_back(*transform);
    write("/tf", received, message);
  }
}

void BagWriter::flown(const hovercraft::FlownManoeuvre& manoeuvre, std::size_t vehicle,
                      hovercraft::Tick tick) {
  const ros::Time stamp = stampOfTick(tick);
  write(topic(vehicles_[vehicle], kManoeuvresTopic), stamp, toMessage(manoeuvre, stamp));
}

void BagWriter::event(const hovercraft_sim::RunEvent& event,
                      const hovercraft::Simulation& simulation) {
  hovercraft_sim::RunEvent written = event;
  if (event.episode != episode_) events_ = 0;
  written.number = ++events_;
  const auto tick = static_cast<hovercraft::Tick>(event.tick);
  written.header.stamp = stampOfTick(tick);
  write(kEventsTopic, written.header.stamp, written);
  if (event.episode == episode_) return;
  episode_ = event.episode;
  epoch_ns_ += (tick - simulation.tick()) * step_ns_;
}

void BagWriter::close() {
  try {
    bag_->close();
  } catch (const rosbag::BagException& error) {
    throw writeError(file_.path(), error);
  }
  bag_.reset();
  file_.commit();
}

}  // namespace hovercraft_ros
