#include "hovercraft_sim/clients/pilot_node.h"

#include <utility>

#include <hovercraft_sim/Manoeuvre.h>
#include <ros/console.h>
#include <ros/transport_hints.h>

#include "hovercraft_sim/clients/node_ping.h"
#include "hovercraft_sim/io/steady_clock.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/manoeuvre_messages.h"
#include "hovercraft_sim/messages/vehicle_messages.h"

namespace hovercraft_ros {
namespace {

constexpr std::uint32_t kPilotQueue = 100;

// After so long without a state its publisher is asked whether it is there.
constexpr std::int64_t kSilenceNs = 2000000000;

bool hasOthers(const hovercraft::Command& command) {
  return command.engines > hovercraft::kAllEngines;
}

}  // namespace

PilotNode::PilotNode(const ros::NodeHandle& handle, const hovercraft::Scenario& scenario,
                     hovercraft::PilotFile file)
    : step_ns_(scenario.step_ns),
      craft_(scenario.vehicles[file.vehicle]),
      file_(std::move(file)),
      pilot_(file_, scenario.step_ns) {
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
  const boost::function<void(const ros::MessageEvent<const hovercraft_sim::State>&)> on_state =
      [this](const ros::MessageEvent<const hovercraft_sim::State>& event) { answer(event); };
  states_ = own.subscribe<hovercraft_sim::State>(
      kStateTopic, kPilotQueue, on_state, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

bool PilotNode::isNewRun(const hovercraft_sim::State& state) const {
  return last_ && (state.episode != last_->episode || state.tick < last_->tick);
}

/// What was answered was of a run before.
void PilotNode::beginAnew() {
  pilot_ = hovercraft::CraftPilot(file_, step_ns_);
  last_.reset();
}

void PilotNode::answer(const ros::MessageEvent<const hovercraft_sim::State>& event) {
  publisher_ = event.getPublisherName();
  asked_ns_ = hovercraft::steadyNow();
  answer(*event.getConstMessage());
}

void PilotNode::answer(const hovercraft_sim::State& state) {
  if (is_done_) return;
  const auto motion = toObservedMotion(state, step_ns_);
  if (!motion) {
    ++dropped_;
    if (drop_warnings_.isDue(hovercraft::steadyNow())) {
      ROS_WARN(
          "%s: dropped a state: its numbers must be finite, its orientation a unit quaternion, "
          "its tick one that a simulation can reach (%lu dropped so far)",
          states_.getTopic().c_str(), static_cast<unsigned long>(dropped_));
    }
    return;
  }
  if (isNewRun(state)) {
    if (answered_ > 1) {
      giveUp("the run began anew");
      return;
    }
    beginAnew();
  }
  ++answered_;
  const hovercraft::Tick last = last_ ? static_cast<hovercraft::Tick>(last_->tick) : 0;
  if (last_) warnOfMissed(last, motion->tick);
  if (pilot_.isDueSince(last, motion->tick)) pilot_.decide(*motion);
  last_ = state;
  if (motion->tick == 0) return;  // in lockstep too nobody waits for an answer to the start
  send(state);
  tell(state.header.stamp);
  is_done_ = pilot_.isOver();
}

void PilotNode::warnOfMissed(hovercraft::Tick last, hovercraft::Tick now) {
  if (!pilot_.hasMissed(last, now)) return;
  ++missed_;
  if (!miss_warnings_.isDue(hovercraft::steadyNow())) return;
  ROS_WARN(
      "no state at a tick of a decision: states come every %ld ticks, decisions every %ld: the "
      "flight is another one than with a state for each (%lu late so far)",
      static_cast<long>(now - last), static_cast<long>(pilot_.periodTicks()),
      static_cast<unsigned long>(missed_));
}

void PilotNode::giveUp(const std::string& reason) {
  pilot_.giveUp(reason);
  if (last_) tell(last_->header.stamp);
  is_done_ = true;
}

/// Who sends states is there; who does not, in lockstep or paused, is asked.
bool PilotNode::isPublisherAlive() {
  const std::int64_t now = hovercraft::steadyNow();
  if (publisher_.empty() || now - asked_ns_ < kSilenceNs) return true;
  asked_ns_ = now;
  return answers(publisher_);
}

void PilotNode::watchPublisher() {
  if (is_done_) return;
  const bool has_publisher = states_.getNumPublishers() > 0;
  if (had_publisher_ && (!has_publisher || !isPublisherAlive())) giveUp("the simulation ended");
  had_publisher_ = has_publisher;
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
