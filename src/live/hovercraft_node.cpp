#include "hovercraft_sim/live/hovercraft_node.h"

#include <algorithm>
#include <fmt/format.h>
#include <stdexcept>

#include <ros/callback_queue.h>
#include <ros/console.h>
#include <ros/init.h>

#include "hovercraft_sim/io/steady_clock.h"
#include "hovercraft_sim/scenario/world_builder.h"

namespace hovercraft_ros {
namespace {

constexpr std::int64_t kIdleWaitNs = 4000000;   // how soon an idle node looks at its clock again
constexpr std::int64_t kStepSliceNs = 2000000;  // of stepping between two looks at the callbacks
constexpr std::int64_t kLongestSleepNs =
    10000000;  // so few steps that a callback can wait for them

hovercraft::Tick nextMultiple(hovercraft::Tick tick, hovercraft::Tick period) {
  return (tick + period - 1) / period * period;
}

std::int64_t nanosecondsOf(const ros::Time& stamp) {
  return static_cast<std::int64_t>(stamp.toNSec());
}

bool beginsEpisode(const hovercraft_sim::RunEvent& event) {
  return event.kind == hovercraft_sim::RunEvent::RESET ||
         event.kind == hovercraft_sim::RunEvent::LOAD;
}

}  // namespace

volatile std::sig_atomic_t HovercraftNode::is_stopped = 0;

/// ros::ok() holds until the callbacks have ended, also the one that asks.
bool HovercraftNode::goesOn() {
  return is_stopped == 0 && ros::ok() && !ros::isShuttingDown();
}

void HovercraftNode::setRealTimeFactor(double real_time_factor) {
  catchUp();
  config_.real_time_factor = real_time_factor;
  pacer_.reset();
  if (real_time_factor > 0.0) pacer_.emplace(config_.scenario.step_ns, real_time_factor);
  restartPace();
}

double HovercraftNode::changeRealTimeFactor(double wanted) {
  if (isRealTimeFactor(wanted)) {
    setRealTimeFactor(wanted);
  } else {
    ROS_WARN("real_time_factor = %g: %s; it stays %g", wanted, kRealTimeFactorRuleText,
             config_.real_time_factor);
  }
  return config_.real_time_factor;
}

void HovercraftNode::restartPace() {
  if (pacer_) pacer_->restart(run_.simulation().tick(), hovercraft::steadyNow());
}

void HovercraftNode::resume() {
  paused_ = false;
  restartPace();
}

void HovercraftNode::run() {
  restartPace();
  pace_.restart(hovercraft::steadyNow());
  while (goesOn()) {
    ros::WallDuration timeout;
    timeout.fromNSec(waitNs(hovercraft::steadyNow()));
    ros::getGlobalCallbackQueue()->callAvailable(timeout);
    advance();
  }
}

const char* HovercraftNode::accept(hovercraft::Command command,
                                   const std::optional<ros::Time>& stamp) {
  catchUp();
  if (config_.lockstep) {
    const auto stamp_ns = stamp ? std::optional(nanosecondsOf(*stamp)) : std::nullopt;
    const char* refusal = lockstep_.offer(command.vehicle, stamp_ns);
    if (refusal != nullptr) return refusal;
  }
  command.tick = run_.simulation().tick();
  run_.simulation().push(command);
  if (config_.lockstep && !lockstep_.awaited()) {
    // The time that the controllers took is not the node's lateness.
    answered_ns_ = hovercraft::steadyNow();
    if (pacer_) pacer_->forgiveWait(command.tick, answered_ns_);
  }
  return nullptr;
}

/// The next tick that something is published at. Nobody can tell when the steps before it are made.
hovercraft::Tick HovercraftNode::nextVisibleTick() const {
  const hovercraft::Simulation& simulation = run_.simulation();
  const hovercraft::Tick next = simulation.tick() + 1;
  // A command is published by the step that it acts in.
  if (simulation.hasWaitingCommands()) return next;
  hovercraft::Tick visible = nextMultiple(next, config_.publish_every);
  if (config_.lockstep) visible = std::min(visible, nextMultiple(next, config_.control_period));
  if (const auto scheduled = schedule_.next()) {  // published by the step that it acts in
    visible = std::min(visible, std::max(next, *scheduled + 1));
  }
  visible = std::min(visible, std::max(next, simulation.nextSampleTick()));
  if (clock_) {
    const std::int64_t step_ns = config_.scenario.step_ns;
    const hovercraft::Tick wait = (clock_->untilDueNs(run_.stamp()) + step_ns - 1) / step_ns;
    visible = std::min(visible, std::max(next, simulation.tick() + wait));
  }
  return mayMeetBefore(visible) ? next : visible;
}

/// Whether a contact may have to be published before a tick, as far as the motion now can tell.
bool HovercraftNode::mayMeetBefore(hovercraft::Tick tick) const {
  const hovercraft::Simulation& simulation = run_.simulation();
  const hovercraft::World* const world = simulation.world();
  if (world == nullptr) return false;
  const hovercraft::Tick longest = kLongestSleepNs / config_.scenario.step_ns + 1;
  const hovercraft::Tick steps = std::min(tick - simulation.tick(), longest);
  return !world->isClearAhead(simulation.state().bodies, static_cast<double>(steps));
}

std::int64_t HovercraftNode::waitNs(std::int64_t now_ns) const {
  if (isIdle()) return kIdleWaitNs;
  if (!pacer_) return 0;
  const std::int64_t wait = pacer_->deadline(nextVisibleTick()) - now_ns;
  return std::clamp<std::int64_t>(wait, 0, kLongestSleepNs);
}

bool HovercraftNode::isStepDue(std::int64_t now_ns) const {
  return !isIdle() && (!pacer_ || pacer_->deadline(run_.simulation().tick() + 1) <= now_ns);
}

void HovercraftNode::catchUp() {
  if (!pacer_) return;
  const std::int64_t now = hovercraft::steadyNow();
  // More than it may have slept through is a backlog: callbacks are handled between its slices.
  const bool is_behind = isStepDue(now - kLongestSleepNs);
  do {
    if (isStepDue(now)) advance();
  } while (!is_behind && isStepDue(now));
}

void HovercraftNode::advance() {
  std::int64_t now = hovercraft::steadyNow();
  if (isIdle()) {
    noticeSilence(now);
  } else if (pacer_) {
    const std::int64_t given_up = pacer_->giveUpBacklog(run_.simulation().tick() + 1, now);
    pace_.addGivenUp(given_up);
    if (given_up > 0 && behind_warnings_.isDue(now)) {
      ROS_WARN(
          "The simulation falls behind its pace: %.3f s of wall time given up since the last "
          "report",
          hovercraft::toSeconds(pace_.givenUp()));
    }
  }
  const std::int64_t slice_end = now + kStepSliceNs;
  while (isStepDue(now) && now < slice_end) {
    const hovercraft::Tick next = run_.simulation().tick() + 1;
    if (pacer_ && next == nextVisibleTick()) {
      pace_.addLateness(now - std::max(pacer_->deadline(next), answered_ns_),
                        config_.scenario.step_ns);
    }
    stepOnce();
    const std::int64_t after = hovercraft::steadyNow();
    pace_.addStep(after - now);
    now = after;
  }
  if (clock_) clock_->publishIfDue(run_.headerStamp(), now, isIdle());
}

/// Scheduled commands come at their tick, as if they were sent then.
void HovercraftNode::pushScheduled() {
  while (auto command = schedule_.takeDue(run_.simulation().tick())) {
    run_.simulation().push(*command);
    vehicles_[command->vehicle]->noteSaturation(*command, "~schedule");
  }
}

void HovercraftNode::stepOnce() {
  pushScheduled();
  run_.simulation().step();
  const hovercraft::Tick tick = run_.simulation().tick();
  const bool ends_period = config_.lockstep && tick % config_.control_period == 0;
  if (ends_period || tick % config_.publish_every == 0) publishState();
  if (ends_period) awaitCommands();
}

void HovercraftNode::awaitCommands() {
  lockstep_.await(nanosecondsOf(run_.stamp()));
  waiting_since_ns_ = hovercraft::steadyNow();
}

void HovercraftNode::stepPaused(std::uint32_t steps) {
  for (std::uint32_t i = 0; i < steps; ++i) {
    if (!goesOn()) {
      throw std::runtime_error(fmt::format("the node shuts down after {} of {} steps", i, steps));
    }
    stepOnce();
  }
}

/// Whether a newcomer would wait in vain: nothing is published by itself. No stamp is used twice:
/// tick 0 has that of tick 1 where its own would be 0, which ROS takes for no time.
bool HovercraftNode::stands() const {
  const bool borrows_stamp = run_.stamp().isZero() && config_.publish_every == 1;
  return isIdle() && !borrows_stamp;
}

/// From what the craft and the loose bodies have filled.
void HovercraftNode::gatherTransforms() {
  transforms_message_.transforms.clear();
  for (const auto& vehicle : vehicles_) {
    if (vehicle->messages().hasTransform()) {
      transforms_message_.transforms.push_back(vehicle->messages().transform());
    }
  }
  for (const BodyMessages& body : bodies_) {
    transforms_message_.transforms.push_back(body.transform());
  }
}

/// Likewise.
void HovercraftNode::gatherStates() {
  states_message_.header.stamp = run_.headerStamp();
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    states_message_.states[i] = vehicles_[i]->messages().state();
  }
}

void HovercraftNode::publishState() {
  // Asked once, as in VehicleInterface::publish().
  MessageParts of_all;
  of_all.frames = transforms_.isHeard();
  of_all.state = states_.isHeard();
  for (const auto& vehicle : vehicles_) vehicle->publish(of_all);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const bool is_heard = body_poses_[i].isHeard();
    if (is_heard || of_all.frames) bodies_[i].fill(run_.simulation(), run_.headerStamp());
    body_poses_[i].publishIf(is_heard, bodies_[i].pose());
  }
  if (of_all.frames) gatherTransforms();
  const bool is_empty = of_all.frames && transforms_message_.transforms.empty();
  if (!is_empty) transforms_.publishIf(of_all.frames, transforms_message_);
  if (of_all.state) gatherStates();
  states_.publishIf(of_all.state, states_message_);
  if (clock_) clock_->publishIfDue(run_.headerStamp(), hovercraft::steadyNow(), false);
}

void HovercraftNode::apply(const hovercraft_sim::RunEvent& event) {
  events_.publish(run_.apply(event));
  if (beginsEpisode(event)) {
    lockstep_.clear();
    schedule_.clear();
    const hovercraft::Tick tick = run_.simulation().tick();
    if (config_.lockstep && tick > 0 && tick % config_.control_period == 0) {
      // Here the run that never stopped waited. The stamp is a new one: a late command for the
      // state before the load is none for the one after it.
      run_.renewStamp();
      publishState();
      awaitCommands();
    }
  }
  restartPace();
}

void HovercraftNode::noticeSilence(std::int64_t now_ns) {
  const auto awaited = lockstep_.awaited();
  if (paused_ || !awaited) return;
  const double waited = hovercraft::toSeconds(now_ns - waiting_since_ns_);
  if (waited < config_.lockstep_timeout) return;
  telemetry_message_.waiting_for = vehicles_[*awaited]->messages().name();
  if (silence_warnings_.isDue(now_ns)) {
    ROS_WARN(
        "Lockstep: no ThrustCommand of %s with the stamp of the last state for %.1f s; the "
        "simulation waits",
        telemetry_message_.waiting_for.c_str(), waited);
  }
}

void HovercraftNode::report() {
  catchUp();
  const std::int64_t now = hovercraft::steadyNow();
  pace_.fill(telemetry_message_, now, config_.scenario.step_ns);
  telemetry_message_.header.stamp = run_.headerStamp();
  telemetry_message_.tick = static_cast<std::uint64_t>(run_.simulation().tick());
  telemetry_message_.episode = run_.episode();
  telemetry_message_.paused = static_cast<std::uint8_t>(paused_ ? 1 : 0);
  telemetry_message_.wanted_real_time_factor = config_.real_time_factor;
  const std::uint64_t stalls = run_.stalls();
  telemetry_message_.contact_stalls = stalls - reported_stalls_;
  reported_stalls_ = stalls;
  telemetry_.publish(telemetry_message_);
  diagnostics_.force_update();
  telemetry_message_.waiting_for.clear();
  pace_.restart(now);
}

void HovercraftNode::reportCommands(diagnostic_updater::DiagnosticStatusWrapper& status,
                                    std::size_t vehicle) {
  using diagnostic_msgs::DiagnosticStatus;
  const std::uint64_t drops = vehicles_[vehicle]->droppedCommands();
  const std::uint64_t saturations = vehicles_[vehicle]->saturatedCommands();
  bool timed_out = false;
  const hovercraft::VehicleScenario& craft = run_.simulation().scenario().vehicles[vehicle];
  const std::size_t count = hovercraft::kFirstActuator + craft.actuators.size();
  for (std::size_t id = 0; id < count; ++id) {
    if (id < hovercraft::kFirstActuator && !craft.has_engine[id]) continue;
    const auto state = run_.simulation().engineReport(vehicle, static_cast<int>(id));
    timed_out = timed_out || state.timed_out;
    status.addf("Age of command, " + actuatorName(craft, id) + " (s)", "%.3f", state.command_age);
  }
  if (drops > reported_drops_[vehicle]) {
    status.summary(DiagnosticStatus::WARN, "Dropped commands");
  } else if (saturations > reported_saturations_[vehicle]) {
    status.summary(DiagnosticStatus::WARN, "Saturated commands beyond the limits");
  } else {
    status.summary(DiagnosticStatus::OK, timed_out ? "Timed out" : "OK");
  }
  status.add("Dropped commands", drops);
  status.add("Saturated commands", saturations);
  reported_drops_[vehicle] = drops;
  reported_saturations_[vehicle] = saturations;
}

}  // namespace hovercraft_ros
