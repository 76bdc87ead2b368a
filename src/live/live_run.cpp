#include "hovercraft_sim/live/live_run.h"

#include <algorithm>
#include <exception>
#include <fmt/format.h>
#include <stdexcept>
#include <string>
#include <utility>

#include "hovercraft_sim/messages/run_events.h"

namespace hovercraft_ros {

using hovercraft_sim::RunEvent;

LiveRun::LiveRun(hovercraft::Scenario scenario, std::int64_t epoch_ns)
    : simulation_(std::move(scenario)), epoch_ns_(epoch_ns) {}

ros::Time LiveRun::stampOf(hovercraft::Tick tick) const {
  ros::Time stamp;
  stamp.fromNSec(static_cast<std::uint64_t>(epoch_ns_ + tick * simulation_.scenario().step_ns));
  return stamp;
}

ros::Time LiveRun::sampleStamp(hovercraft::Tick tick) const {
  const std::int64_t time_ns = epoch_ns_ + tick * simulation_.scenario().step_ns;
  ros::Time stamp;
  stamp.fromNSec(static_cast<std::uint64_t>(std::max<std::int64_t>(time_ns, 1)));
  return stamp;
}

std::uint64_t LiveRun::stalls() const {
  const hovercraft::World* const world = simulation_.world();
  return world == nullptr ? 0 : static_cast<std::uint64_t>(world->stalls()) - trial_stalls_;
}

/// A request that would end the node within a few steps is refused instead.
void LiveRun::applyOnTrial(const RunEvent& event) {
  const hovercraft::SimulationState before = simulation_.state();
  applyEvent(event, simulation_);
  const hovercraft::SimulationState after = simulation_.state();
  hovercraft::RunObserver* const observer = simulation_.observer();
  const std::uint64_t stalls_before = stalls();
  simulation_.observe(nullptr);
  std::string failure;
  try {
    for (int n = 0; n < kTrialSteps; ++n) simulation_.step();
  } catch (const std::exception& error) {
    failure = error.what();
  }
  simulation_.observe(observer);
  trial_stalls_ += stalls() - stalls_before;
  simulation_.restore(failure.empty() ? after : before);
  if (failure.empty()) return;
  throw std::invalid_argument(
      fmt::format("it would end the run within {} steps: {}", kTrialSteps, failure));
}

RunEvent LiveRun::apply(RunEvent event) {
  event.header.stamp = headerStamp();
  event.tick = static_cast<std::uint64_t>(simulation_.tick());
  const std::int64_t now_ns = epoch_ns_ + simulation_.timeNs();
  const bool is_of_forces = event.kind == RunEvent::SET_STATE ||
                            event.kind == RunEvent::APPLY_WRENCH || event.kind == kSetWind;
  if (is_of_forces) {
    applyOnTrial(event);
  } else {
    applyEvent(event, simulation_);
  }
  if (event.kind == RunEvent::RESET || event.kind == RunEvent::LOAD) {
    ++episode_;
    events_ = 0;
    epoch_ns_ = now_ns - simulation_.timeNs();
  }
  event.episode = episode_;
  event.number = ++events_;
  return event;
}

}  // namespace hovercraft_ros
