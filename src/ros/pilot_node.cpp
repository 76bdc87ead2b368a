#include "hovercraft_sim/ros/pilot_node.h"

#include <utility>

#include <hovercraft_sim/Manoeuvre.h>
#include <ros/console.h>
#include <ros/transport_hints.h>

#include "hovercraft_sim/ros/conversions.h"
#include "hovercraft_sim/ros/manoeuvre_messages.h"
#include "hovercraft_sim/ros/vehicle_messages.h"

namespace hovercraft_ros {
namespace {

constexpr std::uint32_t kPilotQueue = 100;

bool hasOthers(const hovercraft::Command& command) {
  return command.engines > hovercraft::kAllEngines;
}

hovercraft::ObservedMotion observed(const hovercraft_sim::State& state) {
  return {static_cast<hovercraft::Tick>(state.tick), fromMessage(state.pose.position),
          fromMessage(state.pose.orientation), fromMessage(state.velocity),
          fromMessage(state.angular_velocity)};
}

}  // namespace

PilotNode::PilotNode(const ros::NodeHandle& handle, const hovercraft::Scenario& scenario,
                     hovercraft::PilotFile file)
    : craft_(scenario.vehicles[file.vehicle]), pilot_(std::move(file), scenario.step_ns) {
  ros::NodeHandle own(handle, craft_.name);
  // In lockstep the simulation waits for the first answer even if it came before its connection.
  const ros::SubscriberStatusCallback repeat = [this](const ros::SingleSubscriberPublisher& to) {
    if (!thrusts_.header.stamp.isZero()) to.publish(thrusts_);
  };
  const ros::SubscriberStatusCallback repeat_levels =
      [this](const ros::SingleSubscriberPublisher& to) {
        if (!levels_.header.stamp.isZero()) to.publish(levels_);
      };
  thrust_ = own.advertise<hovercraft_sim::ThrustCommand>(kThrustTopic, kPilotQueue, repeat);
  if (!craft_.actuators.empty()) {
    actuators_ = own.advertise<hovercraft_sim::ActuatorCommand>(kActuatorCommandTopic, kPilotQueue,
                                                                repeat_levels);
  }
  manoeuvres_ = own.advertise<hovercraft_sim::Manoeuvre>(kManoeuvresTopic, kPilotQueue, true);
  states_ = own.subscribe(kStateTopic, kPilotQueue, &PilotNode::answer, this,
                          ros::TransportHints().tcpNoDelay());
}

bool PilotNode::isNewRun(const hovercraft_sim::State& state) const {
  return last_ && (state.episode != last_->episode || state.tick < last_->tick);
}

void PilotNode::answer(const hovercraft_sim::State& state) {
  if (is_done_) return;
  const auto tick = static_cast<hovercraft::Tick>(state.tick);
  if (isNewRun(state)) {
    pilot_.giveUp("the run began anew");
    tell(state.header.stamp);
    is_done_ = true;
    return;
  }
  const bool is_first = !last_;
  const auto passed = is_first ? 0 : tick - static_cast<hovercraft::Tick>(last_->tick);
  if (passed > pilot_.periodTicks() && !has_warned_) {
    has_warned_ = true;
    ROS_WARN(
        "states come every %ld ticks, decisions every %ld: the flight is another one than "
        "with a state for each",
        static_cast<long>(passed), static_cast<long>(pilot_.periodTicks()));
  }
  const bool is_new = is_first || passed > 0;
  if (is_new && (pilot_.isDue(tick) || passed > pilot_.periodTicks())) {
    pilot_.decide(observed(state));
  }
  last_ = state;
  if (pilot_.command().tick == 0) return;  // nothing was decided yet
  send(state);
  tell(state.header.stamp);
  is_done_ = pilot_.isOver();
}

void PilotNode::send(const hovercraft_sim::State& state) {
  const hovercraft::Command& command = pilot_.command();
  // One message, since in lockstep a state has one answer.
  if (hasOthers(command)) {
    levels_ = toActuatorCommand(command, craft_, state.header.stamp);
    actuators_.publish(levels_);
  } else {
    thrusts_ = toThrustCommand(command, state.header.stamp);
    thrust_.publish(thrusts_);
  }
}

void PilotNode::tell(const ros::Time& stamp) {
  for (; told_ < pilot_.flown().size(); ++told_) {
    manoeuvres_.publish(toMessage(pilot_.flown()[told_], stamp));
  }
}

}  // namespace hovercraft_ros
