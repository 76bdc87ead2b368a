#include "hovercraft_sim/clients/command_player.h"

#include <algorithm>
#include <utility>

#include <hovercraft_sim/ThrustCommand.h>
#include <ros/transport_hints.h>

#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/vehicle_messages.h"

namespace hovercraft_ros {
namespace {

constexpr std::int64_t kRepeatNs = 50000000;  // a tenth of the default time-out
constexpr std::uint32_t kPlayerQueue = 100;

}  // namespace

hovercraft::Tick PlayedTime::hear(const hovercraft_sim::State& state) {
  is_new_run_ = !last_ || state.episode != last_->episode || state.tick < last_->tick;
  if (last_ && !is_new_run_) {
    played_ += static_cast<hovercraft::Tick>(state.tick - last_->tick);
  } else if (last_ && state.episode > last_->episode) {
    // Ticks count anew, or from those of a snapshot; stamps go on.
    const std::int64_t passed_ns = (state.header.stamp - last_->header.stamp).toNSec();
    played_ += std::max<std::int64_t>(0, passed_ns) / step_ns_;
  }
  last_ = state;
  return played_;
}

CommandPlayer::CommandPlayer(const ros::NodeHandle& handle, const hovercraft::Scenario& scenario,
                             std::unique_ptr<hovercraft::CommandSource> source,
                             std::int64_t settle_ns, std::uint32_t wanted_subscribers)
    : source_(std::move(source)),
      next_(source_->next()),
      settle_ticks_(hovercraft::firstTickAt(settle_ns, scenario.step_ns)),
      repeat_ticks_(std::max<hovercraft::Tick>(1, kRepeatNs / scenario.step_ns)),
      wanted_subscribers_(wanted_subscribers),
      craft_(scenario.vehicles),
      held_(scenario.vehicles.size(), {0, 0, 0, {}}),
      commanded_(scenario.vehicles.size(), false),
      time_(scenario.step_ns) {
  for (const hovercraft::VehicleScenario& craft : scenario.vehicles) {
    ros::NodeHandle own(handle, craft.name);
    publishers_.push_back(own.advertise<hovercraft_sim::ThrustCommand>(kThrustTopic, kPlayerQueue));
    actuator_publishers_.push_back(
        craft.actuators.empty()
            ? ros::Publisher()
            : own.advertise<hovercraft_sim::ActuatorCommand>(kActuatorCommandTopic, kPlayerQueue));
  }
  ros::NodeHandle first(handle, scenario.vehicles.front().name);
  state_subscriber_ = first.subscribe(kStateTopic, kPlayerQueue, &CommandPlayer::onState, this,
                                      ros::TransportHints().tcpNoDelay());
}

bool CommandPlayer::allConnected() const {
  const auto is_heard = [this](const ros::Publisher& publisher) {
    return !publisher || publisher.getNumSubscribers() >= wanted_subscribers_;
  };
  return std::all_of(publishers_.begin(), publishers_.end(), is_heard) &&
         std::all_of(actuator_publishers_.begin(), actuator_publishers_.end(), is_heard);
}

void CommandPlayer::onState(const hovercraft_sim::State& state) {
  has_begun_ = has_begun_ || allConnected();
  if (!has_begun_) return;
  const hovercraft::Tick now = time_.hear(state);
  const hovercraft::Tick before = last_command_;
  takeDue(now);
  if (last_command_ != before || now - last_sent_ >= repeat_ticks_ || time_.isNewRun()) {
    send(state.header.stamp);
    last_sent_ = now;
  }
  done_ = !next_ && now >= last_command_ + settle_ticks_;
}

void CommandPlayer::takeDue(hovercraft::Tick tick) {
  while (next_ && next_->tick <= tick) {
    hold(*next_, held_[next_->vehicle]);
    commanded_[next_->vehicle] = true;
    last_command_ = next_->tick;
    next_ = source_->next();
  }
}

void CommandPlayer::send(const ros::Time& stamp) {
  for (std::size_t vehicle = 0; vehicle < publishers_.size(); ++vehicle) {
    if (!commanded_[vehicle]) continue;
    const hovercraft::Command& held = held_[vehicle];
    if (held.engines > hovercraft::kAllEngines) {
      // One message, since in lockstep a state has one answer.
      actuator_publishers_[vehicle].publish(toActuatorCommand(held, craft_[vehicle], stamp));
    } else {
      publishers_[vehicle].publish(toThrustCommand(held, stamp));
    }
  }
}

}  // namespace hovercraft_ros
