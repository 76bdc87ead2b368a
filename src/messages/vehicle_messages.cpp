#include "hovercraft_sim/messages/vehicle_messages.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <utility>

#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/scenario/scenario_names.h"

namespace hovercraft_ros {

using hovercraft::kEngineNames;

namespace {

/// First or last parts of the topics that a craft has for something else.
std::set<std::string> takenNames() {
  std::set<std::string> names = {
      kThrustTopic,  kPoseTopic,     kTwistTopic,     kEnginesTopic,
      kCushionTopic, kWindTopic,     kActuatorsTopic, kActuatorCommandTopic,
      kStateTopic,   kCommandsTopic, "manoeuvres",    "cmd_vel"};
  for (const std::string& topic : hovercraft::sensorTopics()) {
    names.insert(topic.substr(0, topic.find('/')));
    names.insert(topic.substr(topic.rfind('/') + 1));
  }
  return names;
}

bool isTakenName(const std::string& part) {
  static const std::set<std::string> names = takenNames();
  return names.count(part) > 0;
}

}  // namespace

bool isTopicForTruth(const std::string& topic) {
  const std::string first = topic.substr(0, topic.find('/'));
  std::string part;
  for (std::istringstream parts(topic + "/"); std::getline(parts, part, '/');) {
    if (!hovercraft::isGraphName(part)) return false;
  }
  return !isTakenName(first) && !isTakenName(topic.substr(topic.rfind('/') + 1));
}

ros::Time stampOf(const ros::Time& epoch, std::int64_t time_ns) {
  ros::Time stamp;
  stamp.fromNSec(epoch.toNSec() + static_cast<std::uint64_t>(time_ns));
  return stamp;
}

VehicleMessages::VehicleMessages(const hovercraft::Scenario& scenario, std::size_t vehicle,
                                 TfFrames frames)
    : description_(scenario.vehicles.at(vehicle)), vehicle_(vehicle), frames_(std::move(frames)) {
  const std::string base_frame = frames_.of(description_.name);
  pose_.header.frame_id = frames_.world;
  twist_.header.frame_id = base_frame;
  odom_.header.frame_id = frames_.world;
  odom_.child_frame_id = base_frame;
  transform_.header.frame_id = frames_.world;
  transform_.child_frame_id = base_frame;
  engines_.header.frame_id = base_frame;
  cushion_.header.frame_id = base_frame;
  actuators_.header.frame_id = base_frame;
  wind_.header.frame_id = base_frame;
  for (const hovercraft::ActuatorScenario& actuator : description_.actuators) {
    hovercraft_sim::ActuatorStatus status;
    status.name = actuator.name;
    status.id = static_cast<std::uint8_t>(hovercraft::kFirstActuator + actuators_.actuators.size());
    status.kind = hovercraft::actuatorKindNames()[static_cast<std::size_t>(actuator.kind)];
    actuators_.actuators.push_back(status);
  }
  state_.actuators.resize(description_.actuators.size());
  state_.header.frame_id = frames_.world;
}

void VehicleMessages::fill(const hovercraft::Simulation& simulation, const RunStamp& place,
                           const MessageParts& parts) {
  enter(place.episode);
  const bool is_moving_part_wanted = parts.frames || parts.wind || parts.state;
  if (is_moving_part_wanted) {
    const hovercraft::Motion motion = simulation.motion(vehicle_);
    const HullMotion hull = hullMotion(motion, description_.mass_properties.p_HB);
    if (parts.frames) fillFrames(hull, place.stamp);
    if (parts.state) fillState(simulation, place, motion);
    if (parts.wind) {
      wind_.header.stamp = place.stamp;
      fillWind(simulation, hull);
    }
  }
  if (parts.engines) {
    engines_.header.stamp = place.stamp;
    fillEngines(simulation);
  }
  if (parts.actuators) {
    actuators_.header.stamp = place.stamp;
    fillActuators(simulation);
  }
  if (parts.cushion) {
    cushion_.header.stamp = place.stamp;
    if (hasCushion()) fillCushion(simulation);
  }
}

void VehicleMessages::fillFrames(const HullMotion& hull, const ros::Time& stamp) {
  for (std_msgs::Header* header :
       {&pose_.header, &twist_.header, &odom_.header, &transform_.header}) {
    header->stamp = stamp;
  }
  pose_.pose.position = toPointMessage(hull.p_WH);
  pose_.pose.orientation = toQuaternionMessage(hull.q_WH);
  twist_.twist.linear = toVector3Message(hull.v_WH_H);
  twist_.twist.angular = toVector3Message(hull.w_WH_H);
  odom_.pose.pose = pose_.pose;
  odom_.twist.twist = twist_.twist;
  transform_.transform.translation = toVector3Message(hull.p_WH);
  transform_.transform.rotation = pose_.pose.orientation;
}

void VehicleMessages::fillEngines(const hovercraft::Simulation& simulation) {
  engines_.rear = toMessage(simulation.engineReport(vehicle_, 0));
  engines_.left = toMessage(simulation.engineReport(vehicle_, 1));
  engines_.right = toMessage(simulation.engineReport(vehicle_, 2));
}

void VehicleMessages::fillState(const hovercraft::Simulation& simulation, const RunStamp& place,
                                const hovercraft::Motion& motion) {
  state_.header.stamp = place.stamp;
  state_.tick = static_cast<std::uint64_t>(simulation.tick());
  state_.episode = place.episode;
  state_.pose.position = toPointMessage(motion.p_WB);
  state_.pose.orientation = toQuaternionMessage(motion.q_WB);
  state_.velocity = toVector3Message(motion.twist.v_WB);
  state_.angular_velocity = toVector3Message(motion.twist.w_WB);
  state_.momentum = toVector3Message(motion.momentum_W);
  state_.angular_momentum = toVector3Message(motion.angular_momentum_W);
  const hovercraft::EngineStates& all = simulation.state().engines[vehicle_];
  for (std::size_t i = 0; i < hovercraft::kEngineCount; ++i) {
    state_.thrust[i] = simulation.engineReport(vehicle_, static_cast<int>(i)).applied;
  }
  for (std::size_t i = 0; i < state_.actuators.size(); ++i) {
    const auto id = static_cast<int>(hovercraft::kFirstActuator + i);
    state_.actuators[i] = simulation.engineReport(vehicle_, id).applied;
  }
  state_.extra.clear();
  if (std::any_of(all.begin(), all.end(), [](const auto& one) { return one.isFaulty(); })) {
    for (const hovercraft::EngineState& actuator : all) {
      state_.extra.push_back(actuator.efficiency);
      state_.extra.push_back(actuator.stuck ? 1.0 : 0.0);
    }
  }
  state_.energy = motion.energy;
  state_.commands = commands_;
  state_.events = place.events;
  state_.hash = simulation.hash(vehicle_);
  state_.sensor_hash = simulation.sensorHash(vehicle_);
}

void VehicleMessages::fillWind(const hovercraft::Simulation& simulation, const HullMotion& hull) {
  const hovercraft::Vector3 wind_W = simulation.windAt(vehicle_);
  wind_.mean = toVector3Message(simulation.state().wind_W);
  wind_.true_wind = toVector3Message(wind_W);
  wind_.apparent = toVector3Message(rotate(conjugate(hull.q_WH), wind_W) - hull.v_WH_H);
}

void VehicleMessages::fillCushion(const hovercraft::Simulation& simulation) {
  simulation.cushionReport(vehicle_, cushion_report_);
  cushion_.cells.resize(cushion_report_.cells.size());
  for (std::size_t i = 0; i < cushion_.cells.size(); ++i) {
    const hovercraft::CellReport& cell = cushion_report_.cells[i];
    cushion_.cells[i].pressure = cell.pressure;
    cushion_.cells[i].gap = cell.gap;
    cushion_.cells[i].flow = cell.flow;
    cushion_.cells[i].force = cell.force;
  }
  cushion_.fan_speed = cushion_report_.fan_speeds;
  cushion_.power = cushion_report_.power;
}

void VehicleMessages::fillActuators(const hovercraft::Simulation& simulation) {
  for (std::size_t i = 0; i < actuators_.actuators.size(); ++i) {
    hovercraft_sim::ActuatorStatus& status = actuators_.actuators[i];
    const auto report = simulation.engineReport(vehicle_, status.id);
    status.commanded = report.commanded;
    status.applied = report.applied;
    status.saturated = static_cast<std::uint8_t>(report.saturated);
    status.timed_out = static_cast<std::uint8_t>(report.timed_out);
    status.age = report.command_age;
    status.efficiency = report.efficiency;
    status.stuck = static_cast<std::uint8_t>(report.stuck);
  }
}

/// Commands are counted anew in each episode.
void VehicleMessages::enter(std::uint32_t episode) {
  if (episode != episode_) commands_ = 0;
  episode_ = episode;
}

hovercraft_sim::AppliedCommand VehicleMessages::appliedCommand(const hovercraft::Command& command,
                                                               const RunStamp& place) {
  hovercraft_sim::AppliedCommand message = toMessage(command);
  message.episode = place.episode;
  enter(place.episode);
  message.number = ++commands_;
  message.header.stamp = place.stamp;
  message.header.frame_id = engines_.header.frame_id;
  return message;
}

std::vector<geometry_msgs::TransformStamped> VehicleMessages::engineFrames(
    const ros::Time& stamp) const {
  std::vector<geometry_msgs::TransformStamped> frames;
  for (std::size_t i = 0; i < kEngineNames.size(); ++i) {
    if (!description_.has_engine[i]) continue;
    const hovercraft::EngineParameters& engine = description_.engines[i];
    geometry_msgs::TransformStamped frame;
    frame.header.stamp = stamp;
    frame.header.frame_id = transform_.child_frame_id;
    frame.child_frame_id = frames_.of(description_.name, std::string("engine_") + kEngineNames[i]);
    frame.transform.translation = toVector3Message(engine.p_HE);
    frame.transform.rotation = toQuaternionMessage(turnFromX(engine.direction));
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace hovercraft_ros
