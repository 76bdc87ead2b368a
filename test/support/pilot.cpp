#include "pilot.h"

#include <hovercraft_sim/ThrustCommand.h>
#include <ros/init.h>
#include <ros/transport_hints.h>
#include <std_msgs/Float64.h>

#include "recorded_flight.h"
#include "wait_until.h"
#include "wires.h"

namespace hovercraft_ros::testing {
namespace {

// At 100 Hz of states a command every 0.1 s: well within a time-out of 0.5 s, and slow enough that
// a stall of a second loses none from a queue of ten.
constexpr int kStatesPerCommand = 10;

}  // namespace

Pilot::Pilot(const std::string& vehicle) : vehicle_(vehicle) {
  ros::NodeHandle handle("/" + vehicle);
  all_engines_ = handle.advertise<hovercraft_sim::ThrustCommand>("thrust", 10);
  for (std::size_t i = 0; i < single_engines_.size(); ++i) {
    const std::string topic = std::string("thrust/") + hovercraft::kEngineNames[i];
    single_engines_[i] = handle.advertise<std_msgs::Float64>(topic, 10);
  }
  state_subscriber_ =
      handle.subscribe("state", 100, &Pilot::onState, this, ros::TransportHints().tcpNoDelay());
  waitUntil("the simulation hears the thrusts of " + vehicle, [this] {
    bool connected = all_engines_.getNumSubscribers() > 0;
    for (const ros::Publisher& engine : single_engines_) {
      connected = connected && engine.getNumSubscribers() > 0;
    }
    return connected;
  });
  waitUntil("the state of " + vehicle + " is heard", [this] { return state_.tick > 0; });
}

void Pilot::onState(const hovercraft_sim::State& state) {
  state_ = state;
  if (on_state_) on_state_();
}

void Pilot::command(const hovercraft::Vector3& thrusts) {
  hovercraft_sim::ThrustCommand message;
  message.rear = thrusts[0];
  message.left = thrusts[1];
  message.right = thrusts[2];
  all_engines_.publish(message);
}

void Pilot::command(hovercraft::EngineId engine, double thrust) {
  std_msgs::Float64 message;
  message.data = thrust;
  single_engines_[static_cast<std::size_t>(engine)].publish(message);
}

void Pilot::waitFor(const std::string& what, const Condition& condition) {
  waitUntil(vehicle_ + " " + what, [&] { return condition(state_); });
}

void Pilot::flyUntil(const std::string& what, const hovercraft::Vector3& thrusts,
                     const Condition& condition) {
  on_state_ = [this, thrusts, states = 0]() mutable {
    if (states++ % kStatesPerCommand == 0) command(thrusts);
  };
  try {
    waitFor(what, condition);
  } catch (...) {
    on_state_ = {};
    throw;
  }
  on_state_ = {};
}

void Pilot::waitFor(std::uint64_t ticks) {
  ros::spinOnce();  // states that wait in the queue
  waitFor("has flown on", tickReaches(state_.tick + ticks));
}

void Pilot::flyFor(std::uint64_t ticks, const hovercraft::Vector3& thrusts) {
  ros::spinOnce();
  flyUntil("has flown on", thrusts, tickReaches(state_.tick + ticks));
}

}  // namespace hovercraft_ros::testing
