#include "hovercraft_sim/clients/flight.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>
#include <std_srvs/Trigger.h>
#include <stdexcept>
#include <utility>

#include <hovercraft_sim/Reset.h>
#include <hovercraft_sim/ThrustCommand.h>
#include <ros/callback_queue.h>
#include <ros/init.h>
#include <ros/names.h>
#include <ros/service.h>
#include <ros/transport_hints.h>
#include <std_msgs/String.h>

#include "hovercraft_sim/analysis/compare.h"
#include "hovercraft_sim/bags/simulate.h"
#include "hovercraft_sim/bags/trajectory_file.h"
#include "hovercraft_sim/io/number_text.h"
#include "hovercraft_sim/math/tolerances.h"
#include "hovercraft_sim/messages/conversions.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/scenario/scenario_parser.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft_ros {

using hovercraft::Tick;
using hovercraft::Trajectory;
using hovercraft::TrajectorySample;
using hovercraft::Vector3;

namespace {

constexpr std::chrono::seconds kDeadline(30);  // of wall time: much more than a start takes
constexpr double kPoll = 0.01;                 // s, how often a deadline is looked at
constexpr std::uint32_t kFlightQueue =
    10000;                             // states; a simulation at full speed must not lose one
constexpr std::size_t kBatch = 10000;  // commands handed over in one call

/// Handles callbacks until the condition holds. @param patience wall time without a callback.
void waitUntil(const std::string& what, const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + kDeadline;
  while (!condition()) {
    if (!ros::ok()) throw std::runtime_error("ROS was shut down while waiting for " + what);
    if (std::chrono::steady_clock::now() > deadline) {
      throw std::runtime_error(fmt::format("waited {} s in vain for {}", kDeadline.count(), what));
    }
    ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPoll));
  }
}

TrajectorySample sampleOf(const hovercraft_sim::State& state, std::int64_t step_ns) {
  return {static_cast<std::int64_t>(state.tick) * step_ns, fromMessage(state.pose.position),
          fromMessage(state.pose.orientation), fromMessage(state.velocity),
          fromMessage(state.angular_velocity)};
}

/// The thrusts that a craft is commanded, as a request of its schedule: each change at its tick,
/// and in between again, often enough that no engine times out.
class HeldThrusts {
 public:
  HeldThrusts(const hovercraft::VehicleScenario& craft, std::int64_t step_ns, std::uint32_t episode)
      : episode_(episode) {
    request_.vehicle = craft.name;
    for (const hovercraft::EngineParameters& engine : parametersOf(craft)) {
      if (engine.timeout_ns == 0) continue;
      const Tick half = std::max<Tick>(1, engine.timeout_ns / step_ns / 2);
      repeat_ = repeat_ ? std::min(*repeat_, half) : half;
    }
  }

  /// Repeats what is held, up to a tick.
  void holdUntil(Tick tick) {
    if (!repeat_ || held_.engines == 0) return;
    while (held_.tick + *repeat_ < tick) add(held_.tick + *repeat_);
  }

  void change(const hovercraft::Command& command, Tick tick) {
    hold(command, held_);
    add(tick);
  }

  hovercraft_sim::ScheduleCommands::Request& request() { return request_; }

 private:
  void add(Tick tick) {
    held_.tick = tick;
    request_.commands.push_back(toMessage(held_));
    request_.commands.back().episode = episode_;
  }

  hovercraft_sim::ScheduleCommands::Request request_;
  std::uint32_t episode_;
  std::optional<Tick> repeat_;  // ticks; none: no engine of the craft times out
  hovercraft::Command held_{0, 0, 0, {}};
};

Tick ticksOf(double seconds, std::int64_t step_ns, const char* name) {
  if (!(seconds >= 0.0) || seconds * 1e9 > hovercraft::kMaxNanoseconds) {
    throw std::invalid_argument(fmt::format("{} = {:g}: must be 0 s or more", name, seconds));
  }
  return hovercraft::firstTickAt(std::llround(seconds * 1e9), step_ns);
}

}  // namespace

Flight::Flight(const std::string& node)
    : node_(node), handle_(ros::names::parentNamespace(node)), scenario_(receiveScenario()) {
  connect();
  call("pause");
  hovercraft_sim::Reset reset;
  if (!ros::service::call(node_ + "/reset", reset) || !reset.response.success) {
    throw std::runtime_error(node_ + "/reset failed: " + reset.response.message);
  }
  episode_ = reset.response.episode;
}

hovercraft::Scenario Flight::receiveScenario() const {
  ros::NodeHandle handle(handle_);
  std::string text;
  const boost::function<void(const std_msgs::String&)> on_scenario =
      [&text](const std_msgs::String& message) { text = message.data; };
  const std::string topic = node_ + "/scenario";
  const ros::Subscriber subscriber = handle.subscribe<std_msgs::String>(topic, 1, on_scenario);
  waitUntil("a scenario on " + topic, [&text] { return !text.empty(); });
  return hovercraft::parseScenario(text, {topic, "", {}});
}

void Flight::call(const std::string& service) const {
  std_srvs::Trigger trigger;
  const std::string name = node_ + "/" + service;
  if (!ros::service::call(name, trigger) || !trigger.response.success) {
    throw std::runtime_error(name + " failed: " + trigger.response.message);
  }
}

void Flight::connect() {
  for (std::size_t i = 0; i < scenario_.vehicles.size(); ++i) {
    const std::string& name = scenario_.vehicles[i].name;
    ros::NodeHandle own(handle_, name);
    Trajectory& trajectory = trajectories_.emplace_back();
    trajectory.vehicle = name;
    trajectory.source = own.resolveName(kStateTopic) + ", centre of mass";
    trajectory.holds_time_zero = false;
    const boost::function<void(const hovercraft_sim::State&)> on_state =
        [this, i](const hovercraft_sim::State& state) { onState(i, state); };
    subscribers_.push_back(own.subscribe<hovercraft_sim::State>(
        kStateTopic, kFlightQueue, on_state, ros::VoidConstPtr(),
        ros::TransportHints().tcpNoDelay()));
  }
  waitUntil("the states of every craft", [this] {
    return std::all_of(
        subscribers_.begin(), subscribers_.end(),
        [](const ros::Subscriber& subscriber) { return subscriber.getNumPublishers() > 0; });
  });
}

void Flight::onState(std::size_t vehicle, const hovercraft_sim::State& state) {
  if (state.episode != episode_) return;
  auto& samples = trajectories_[vehicle].samples;
  const TrajectorySample sample = sampleOf(state, scenario_.step_ns);
  if (!samples.empty() && sample.time_ns <= samples.back().time_ns) return;
  samples.push_back(sample);
  if (played_) answer(vehicle, state);
}

void Flight::answer(std::size_t vehicle, const hovercraft_sim::State& state) {
  const auto tick = static_cast<Tick>(state.tick);
  Played& played = *played_;
  for (; played.next && played.next->tick <= tick; played.next = played.source->next()) {
    hold(*played.next, played.held[played.next->vehicle]);
  }
  const hovercraft::Command& held = played.held[vehicle];
  const hovercraft::VehicleScenario& craft = scenario_.vehicles[vehicle];
  // One message, since in lockstep a state has one answer.
  if (held.engines > hovercraft::kAllEngines) {
    actuator_publishers_[vehicle].publish(toActuatorCommand(held, craft, state.header.stamp));
  } else {
    publishers_[vehicle].publish(toThrustCommand(held, state.header.stamp));
  }
}

hovercraft_sim::ScheduleCommands::Response Flight::schedule(
    const hovercraft_sim::ScheduleCommands::Request& commands) const {
  hovercraft_sim::ScheduleCommands call;
  call.request = commands;
  const std::string name = node_ + "/schedule";
  if (!ros::service::call(name, call) || !call.response.success) {
    throw std::runtime_error(name + " failed: " + call.response.message);
  }
  return call.response;
}

/// Hands over every command of the file. @param settle ticks that the thrusts are held for at the
/// end. @returns the tick of the last command.
Tick Flight::scheduleAll(const std::string& commands, Tick now, Tick settle) {
  const auto source = openCommands(commands, scenario_);
  std::vector<HeldThrusts> held;
  held.reserve(scenario_.vehicles.size());
  for (const hovercraft::VehicleScenario& craft : scenario_.vehicles) {
    held.emplace_back(craft, scenario_.step_ns, *episode_);
  }
  Tick last = now;
  while (const auto command = source->next()) {
    last = std::max(now, command->tick);
    HeldThrusts& craft = held[command->vehicle];
    craft.holdUntil(last);
    craft.change(*command, last);
    if (craft.request().commands.size() >= kBatch) {
      schedule(craft.request());
      craft.request().commands.clear();
    }
  }
  for (HeldThrusts& craft : held) {
    craft.holdUntil(last + settle);
    schedule(craft.request());
  }
  return last;
}

void Flight::answerStates(const std::string& commands) {
  Played played;
  played.source = openCommands(commands, scenario_);
  played.next = played.source->next();
  played.held.assign(scenario_.vehicles.size(), {0, 0, 0, {}});
  played_ = std::move(played);
  for (const hovercraft::VehicleScenario& craft : scenario_.vehicles) {
    ros::NodeHandle own(handle_, craft.name);
    publishers_.push_back(own.advertise<hovercraft_sim::ThrustCommand>(kThrustTopic, kFlightQueue));
    actuator_publishers_.push_back(
        craft.actuators.empty()
            ? ros::Publisher()
            : own.advertise<hovercraft_sim::ActuatorCommand>(kActuatorCommandTopic, kFlightQueue));
  }
  waitUntil("somebody who takes the thrusts of every craft", [this] {
    const auto is_heard = [](const ros::Publisher& publisher) {
      return !publisher || publisher.getNumSubscribers() > 0;
    };
    return std::all_of(publishers_.begin(), publishers_.end(), is_heard) &&
           std::all_of(actuator_publishers_.begin(), actuator_publishers_.end(), is_heard);
  });
}

void Flight::play(const std::string& commands, double settle) {
  const Tick after = ticksOf(settle, scenario_.step_ns, "settle");
  hovercraft_sim::ScheduleCommands::Request none;
  none.vehicle = scenario_.vehicles.front().name;
  const auto now = schedule(none);
  const Tick end = scheduleAll(commands, static_cast<Tick>(now.tick), after) + after;
  if (now.control_period > 0) answerStates(commands);
  flyUntil("the end of " + commands, [this, end] { return hasReached(end); });
  played_.reset();
  publishers_.clear();
  actuator_publishers_.clear();
}

void Flight::watch(double duration) {
  const auto& samples = trajectories_.front().samples;
  const Tick begin = samples.empty() ? 0 : samples.back().time_ns / scenario_.step_ns;
  const Tick end = begin + ticksOf(duration, scenario_.step_ns, "duration");
  flyUntil(fmt::format("{:g} s of flight", duration), [this, end] { return hasReached(end); });
}

bool Flight::hasReached(Tick tick) const {
  return std::all_of(trajectories_.begin(), trajectories_.end(), [&](const Trajectory& flown) {
    return !flown.samples.empty() && flown.samples.back().time_ns >= tick * scenario_.step_ns;
  });
}

void Flight::flyUntil(const std::string& what, const std::function<bool()>& condition) {
  call("resume");
  const auto flown_samples = [this] { return trajectories_.front().samples.size(); };
  // The deadline is for time that stands still, not for a long flight.
  while (!condition()) {
    const std::size_t before = flown_samples();
    waitUntil(what + ": the next state", [&] { return condition() || flown_samples() > before; });
  }
  call("pause");
}

FlightVerdict judge(const std::vector<Trajectory>& flown, const std::string& reference,
                    const FlightTolerance& tolerance) {
  const std::vector<Trajectory> references = readTrajectories(reference);
  hovercraft::CompareOptions options;
  options.position_tolerance = tolerance.position;
  options.attitude_tolerance = tolerance.attitude;
  options.matching = hovercraft::SampleMatching::kInterpolated;
  FlightVerdict verdict{true, ""};
  for (const hovercraft::TrajectoryPair& pair : pairByVehicle(references, flown)) {
    const hovercraft::Comparison comparison = compareTrajectories(*pair.a, *pair.b, options);
    verdict.text += fmt::format("{}, A: reference {}, B: flown\n", pair.b->vehicle, pair.a->source);
    verdict.text += toText(comparison, options);
    verdict.follows = verdict.follows && comparison.is_within;
    const auto end_ns = [](const Trajectory& trajectory) {
      return trajectory.samples.empty() ? 0 : trajectory.samples.back().time_ns;
    };
    if (end_ns(*pair.b) < end_ns(*pair.a)) {
      verdict.follows = false;
      verdict.text += fmt::format("  the flight ended at {} s, the reference at {} s\n",
                                  hovercraft::secondsText(end_ns(*pair.b)),
                                  hovercraft::secondsText(end_ns(*pair.a)));
    }
  }
  return verdict;
}

}  // namespace hovercraft_ros
