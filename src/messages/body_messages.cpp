#include "hovercraft_sim/messages/body_messages.h"

#include <algorithm>

#include "hovercraft_sim/messages/conversions.h"

namespace hovercraft_ros {

BodyMessages::BodyMessages(const hovercraft::Scenario& scenario, std::size_t body,
                           const TfFrames& frames)
    : description_(scenario.world->bodies.at(body)), body_(body) {
  pose_.header.frame_id = frames.world;
  transform_.header.frame_id = frames.world;
  transform_.child_frame_id = frames.of(description_.name);
}

void BodyMessages::fill(const hovercraft::Simulation& simulation, const ros::Time& stamp) {
  const HullMotion hull =
      hullMotion(simulation.bodyMotion(body_), description_.mass_properties.p_HB);
  pose_.header.stamp = stamp;
  pose_.pose.position = toPointMessage(hull.p_WH);
  pose_.pose.orientation = toQuaternionMessage(hull.q_WH);
  transform_.header.stamp = stamp;
  transform_.transform.translation = toVector3Message(hull.p_WH);
  transform_.transform.rotation = pose_.pose.orientation;
}

std::vector<BodyMessages> bodyMessages(const hovercraft::Scenario& scenario,
                                       const TfFrames& frames) {
  std::vector<BodyMessages> messages;
  if (!scenario.world) return messages;
  for (std::size_t body = 0; body < scenario.world->bodies.size(); ++body) {
    messages.emplace_back(scenario, body, frames);
  }
  return messages;
}

hovercraft_sim::Contact toMessage(const hovercraft::ContactEvent& event, std::int64_t epoch_ns,
                                  std::uint32_t episode, const std::string& world_frame) {
  hovercraft_sim::Contact message;
  message.header.frame_id = world_frame;
  message.header.stamp.fromNSec(
      static_cast<std::uint64_t>(std::max<std::int64_t>(epoch_ns + event.time_ns, 1)));
  message.tick = static_cast<std::uint64_t>(event.tick);
  message.episode = episode;
  message.kind = static_cast<std::uint8_t>(event.kind);
  message.body_a = event.a;
  message.body_b = event.b;
  message.point = toPointMessage(event.p_WC);
  message.normal = toVector3Message(event.nhat_AB_W);
  message.impulse = toVector3Message(event.impulse_B_W);
  return message;
}

}  // namespace hovercraft_ros
