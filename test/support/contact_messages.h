#pragma once

#include <algorithm>
#include <cstdint>
#include <fmt/format.h>
#include <string>

#include <hovercraft_sim/Contact.h>

#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros::testing {

/// The first field, in the order of Contact.msg, in which a message is not that of an event of the
/// core; empty if it is. @param epoch_ns ROS time of tick 0, ns.
inline std::string differenceOf(const hovercraft_sim::Contact& message,
                                const hovercraft::ContactEvent& event, std::int64_t epoch_ns) {
  const auto stamp_ns =
      static_cast<std::uint64_t>(std::max<std::int64_t>(epoch_ns + event.time_ns, 1));
  if (message.header.frame_id != "world") return "frame_id = " + message.header.frame_id;
  if (message.header.stamp.toNSec() != stamp_ns) {
    return fmt::format("stamp = {}, not {}", message.header.stamp.toNSec(), stamp_ns);
  }
  if (message.tick != static_cast<std::uint64_t>(event.tick)) {
    return fmt::format("tick = {}, not {}", message.tick, event.tick);
  }
  if (message.episode != 0) return fmt::format("episode = {}", message.episode);
  const std::uint8_t kinds[] = {hovercraft_sim::Contact::BOUNCE, hovercraft_sim::Contact::STICK,
                                hovercraft_sim::Contact::REST};
  if (message.kind != kinds[static_cast<int>(event.kind)]) {
    return fmt::format("kind = {}", message.kind);
  }
  if (message.body_a != event.a) return "body_a = " + message.body_a;
  if (message.body_b != event.b) return "body_b = " + message.body_b;
  if (fromMessage(message.point) != event.p_WC) return "point";
  if (fromMessage(message.normal) != event.nhat_AB_W) return "normal";
  if (fromMessage(message.impulse) != event.impulse_B_W) return "impulse";
  return "";
}

}  // namespace hovercraft_ros::testing
