#include "hovercraft_sim/bags/recorded_messages.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <limits>

#include "hovercraft_sim/bags/bag_file.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/run_events.h"
#include "hovercraft_sim/sim/command_log.h"

namespace hovercraft_ros {

using hovercraft_sim::AppliedCommand;
using hovercraft_sim::RunEvent;
using hovercraft_sim::State;

namespace {

/// One message of a bag, and what is demanded of it.
struct Place {
  const std::string& path;
  const rosbag::MessageInstance& instance;

  void require(bool holds, const std::string& rule) const {
    if (!holds) failAt(path, instance, rule);
  }
  void requireTick(const char* name, std::uint64_t tick) const {
    require(tick <= static_cast<std::uint64_t>(std::numeric_limits<hovercraft::Tick>::max()),
            fmt::format("{} = {}: must fit 63 bits", name, tick));
  }
  template <class Message>
  void requireFinite(const char* name, const Message& vector) const {
    require(fromMessage(vector).allFinite(), fmt::format("{}: must be finite", name));
  }
};

void checkMotion(const Place& place, const RunEvent& event) {
  place.requireFinite("pose.position", event.pose.position);
  place.requireFinite("twist.linear", event.twist.linear);
  place.requireFinite("twist.angular", event.twist.angular);
  const double length = norm(fromMessage(event.pose.orientation));
  place.require(std::abs(length - 1.0) <= hovercraft::kUnitLength,
                fmt::format("pose.orientation: must have length 1 (it has {:.6g})", length));
}

void checkWrench(const Place& place, const RunEvent& event) {
  place.requireFinite("wrench.force", event.wrench.force);
  place.requireFinite("wrench.torque", event.wrench.torque);
  place.requireTick("end_tick", event.end_tick);
}

}  // namespace

boost::shared_ptr<const AppliedCommand> readAppliedCommand(
    const std::string& path, const rosbag::MessageInstance& instance,
    const hovercraft::VehicleScenario& craft) {
  using hovercraft::kFirstActuator;
  const Place place = {path, instance};
  auto message = messageAs<AppliedCommand>(path, instance);
  place.requireTick("tick", message->tick);
  const bool is_for_engines = message->engines != 0 || message->ids.empty();
  place.require(
      (!is_for_engines || message->engines != 0) && message->engines <= hovercraft::kAllEngines,
      fmt::format("engines = {}: must be 1 to 7", message->engines));
  place.require(
      std::isfinite(message->rear) && std::isfinite(message->left) && std::isfinite(message->right),
      "a thrust must be finite");
  place.require(message->ids.size() == message->values.size(),
                fmt::format("ids and values: must be as many ({} and {} are there)",
                            message->ids.size(), message->values.size()));
  std::size_t least = hovercraft::kFirstActuator;
  for (const std::uint8_t id : message->ids) {
    place.require(id >= least, fmt::format("ids: must be 3 or more, ascending ({} is there)", id));
    least = id + std::size_t{1};
  }
  place.require(least <= kFirstActuator + craft.actuators.size(),
                fmt::format("ids: must be below {}: the craft has {} actuators besides its engines",
                            kFirstActuator + craft.actuators.size(), craft.actuators.size()));
  place.require(std::all_of(message->values.begin(), message->values.end(),
                            [](double value) { return std::isfinite(value); }),
                "values: must be finite");
  return message;
}

boost::shared_ptr<const RunEvent> readRunEvent(const std::string& path,
                                               const rosbag::MessageInstance& instance) {
  const Place place = {path, instance};
  auto message = messageAs<RunEvent>(path, instance);
  place.requireTick("tick", message->tick);
  switch (message->kind) {
    case RunEvent::RESET:
    case RunEvent::LOAD:
      break;
    case RunEvent::SET_STATE:
      checkMotion(place, *message);
      break;
    case RunEvent::APPLY_WRENCH:
      checkWrench(place, *message);
      break;
    case kSetWind:
      place.require(isWind(*message), kWindRuleText);
      break;
    case kSetActuator:
      place.require(isFault(*message), kFaultRuleText);
      break;
    default:
      failAt(path, instance, fmt::format("kind = {}: is no event that is known", message->kind));
  }
  return message;
}

boost::shared_ptr<const State> readState(const std::string& path,
                                         const rosbag::MessageInstance& instance) {
  auto message = messageAs<State>(path, instance);
  Place{path, instance}.requireTick("tick", message->tick);
  return message;
}

boost::shared_ptr<const hovercraft_sim::States> readStates(
    const std::string& path, const rosbag::MessageInstance& instance) {
  auto message = messageAs<hovercraft_sim::States>(path, instance);
  const Place place = {path, instance};
  place.require(message->names.size() == message->states.size(),
                fmt::format("names and states: must be as many ({} and {} are there)",
                            message->names.size(), message->states.size()));
  for (const State& state : message->states) place.requireTick("states.tick", state.tick);
  return message;
}

}  // namespace hovercraft_ros
