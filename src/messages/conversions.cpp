#include "hovercraft_sim/messages/conversions.h"

#include <algorithm>
#include <cmath>

#include "hovercraft_sim/math/floating_point_environment.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft_ros {
namespace {

// Distance (-) of a direction from -x below which it counts as -x: its square is no normal number.
constexpr double kHalfTurn = 1e-150;

/// Makes it a command for one actuator more.
void addValue(hovercraft::Command& command, std::size_t id, double value) {
  if (command.thrusts.size() <= id) command.thrusts.resize(id + 1);
  command.thrusts[id] = value;
  command.engines = static_cast<hovercraft::EngineMask>(command.engines | hovercraft::maskOf(id));
}

}  // namespace

using hovercraft::Command;
using hovercraft::Quaternion;
using hovercraft::Vector3;

geometry_msgs::Vector3 toVector3Message(const Vector3& v) {
  geometry_msgs::Vector3 message;
  message.x = v.x();
  message.y = v.y();
  message.z = v.z();
  return message;
}

geometry_msgs::Point toPointMessage(const Vector3& p) {
  geometry_msgs::Point message;
  message.x = p.x();
  message.y = p.y();
  message.z = p.z();
  return message;
}

geometry_msgs::Quaternion toQuaternionMessage(const Quaternion& q) {
  geometry_msgs::Quaternion message;
  message.x = q.v.x();
  message.y = q.v.y();
  message.z = q.v.z();
  message.w = q.s;
  return message;
}

Vector3 fromMessage(const geometry_msgs::Vector3& v) {
  return {v.x, v.y, v.z};
}

Vector3 fromMessage(const geometry_msgs::Point& p) {
  return {p.x, p.y, p.z};
}

Quaternion fromMessage(const geometry_msgs::Quaternion& q) {
  return {q.w, {q.x, q.y, q.z}};
}

HullMotion hullMotion(const hovercraft::Motion& motion, const Vector3& p_HB) {
  const hovercraft::FloatingPointEnvironment environment;
  const hovercraft::Matrix3 R_WH = hovercraft::rotationMatrix(motion.q_WB);
  const Vector3 p_WH = motion.p_WB - hovercraft::times(R_WH, p_HB);
  const Vector3 v_WH = hovercraft::velocityOfPoint(motion.twist, p_WH, motion.p_WB);
  return {p_WH, motion.q_WB, hovercraft::transposeTimes(R_WH, v_WH),
          hovercraft::transposeTimes(R_WH, motion.twist.w_WB)};
}

Quaternion turnFromX(const Vector3& direction) {
  const hovercraft::FloatingPointEnvironment environment;
  const double length = hovercraft::norm(direction);
  const double x = direction.x();
  const double across = direction.y() * direction.y() + direction.z() * direction.z();
  // length + x, without the cancellation that a direction near -x would suffer.
  const double twice_halfway = x > 0.0 ? length + x : across / (length - x);
  const Quaternion turn = {twice_halfway, hovercraft::cross(Vector3::UnitX(), direction)};
  if (hovercraft::norm(turn) < kHalfTurn) return {0.0, Vector3::UnitZ()};
  return hovercraft::normalized(turn);
}

hovercraft_sim::Engine toMessage(const hovercraft::EngineReport& report) {
  hovercraft_sim::Engine message;
  message.commanded = report.commanded;
  message.applied = report.applied;
  message.saturated = report.saturated;
  message.timed_out = report.timed_out;
  message.age = report.command_age;
  return message;
}

hovercraft_sim::AppliedCommand toMessage(const Command& command) {
  hovercraft_sim::AppliedCommand message;
  message.tick = static_cast<std::uint64_t>(command.tick);
  message.engines = static_cast<std::uint8_t>(command.engines & hovercraft::kAllEngines);
  message.rear = command.thrusts[0];
  message.left = command.thrusts[1];
  message.right = command.thrusts[2];
  for (std::size_t id = hovercraft::kFirstActuator; id < command.thrusts.size(); ++id) {
    if ((command.engines & hovercraft::maskOf(id)) == 0) continue;
    message.ids.push_back(static_cast<std::uint8_t>(id));
    message.values.push_back(command.thrusts[id]);
  }
  return message;
}

hovercraft_sim::ThrustCommand toThrustCommand(const Command& command, const ros::Time& stamp) {
  hovercraft_sim::ThrustCommand message;
  message.header.stamp = stamp;
  message.rear = command.thrusts[0];
  message.left = command.thrusts[1];
  message.right = command.thrusts[2];
  return message;
}

hovercraft_sim::ActuatorCommand toActuatorCommand(const Command& command,
                                                  const hovercraft::VehicleScenario& craft,
                                                  const ros::Time& stamp) {
  hovercraft_sim::ActuatorCommand message;
  message.header.stamp = stamp;
  const auto add = [&](std::size_t id, const std::string& name) {
    if ((command.engines & hovercraft::maskOf(id)) == 0) return;
    message.names.push_back(name);
    message.values.push_back(command.thrusts[id]);
  };
  for (std::size_t id = 0; id < hovercraft::kEngineNames.size(); ++id) {
    if (craft.has_engine[id]) add(id, hovercraft::kEngineNames[id]);
  }
  for (std::size_t i = 0; i < craft.actuators.size(); ++i) {
    add(hovercraft::kFirstActuator + i, craft.actuators[i].name);
  }
  return message;
}

std::optional<Command> toCommand(const hovercraft_sim::ThrustCommand& message,
                                 std::size_t vehicle) {
  const Vector3 thrusts(message.rear, message.left, message.right);
  if (!thrusts.allFinite()) return std::nullopt;
  return Command{0, vehicle, hovercraft::kAllEngines, thrusts};
}

Command toCommand(const hovercraft_sim::AppliedCommand& message, std::size_t vehicle) {
  Command command{static_cast<hovercraft::Tick>(message.tick), vehicle, message.engines,
                  Vector3(message.rear, message.left, message.right)};
  for (std::size_t i = 0; i < message.ids.size(); ++i) {
    addValue(command, message.ids[i], message.values[i]);
  }
  return command;
}

std::optional<Command> toCommand(double value, std::size_t id, std::size_t vehicle) {
  if (!std::isfinite(value)) return std::nullopt;
  Command command{0, vehicle, 0, {}};
  addValue(command, id, value);
  return command;
}

std::optional<Command> toCommand(const hovercraft_sim::ActuatorCommand& message,
                                 const hovercraft::VehicleScenario& craft, std::size_t vehicle) {
  if (message.names.empty() || message.names.size() != message.values.size()) return std::nullopt;
  Command command{0, vehicle, 0, {}};
  for (std::size_t i = 0; i < message.names.size(); ++i) {
    const auto id = hovercraft::actuatorIdOf(craft, message.names[i]);
    if (!id || !std::isfinite(message.values[i])) return std::nullopt;
    if ((command.engines & hovercraft::maskOf(*id)) != 0) return std::nullopt;
    addValue(command, *id, message.values[i]);
  }
  return command;
}

}  // namespace hovercraft_ros
