#pragma once

#include <cstdint>
#include <functional>

#include <hovercraft_sim/RunEvent.h>
#include <ros/time.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros {

/// A simulation in ROS time: ticks, episodes and stamps. Stamps are epoch + n·h and never go back:
/// a reset or a load begins an episode with ticks of its own, whose epoch is chosen so that time
/// goes on from where it was.
class HOVERCRAFT_PUBLIC LiveRun {
 public:
  /// Where a step is too long for a speed or a force, each step makes the error greater: default
  /// craft that diverge at all are not finite after 1 to 30.
  static constexpr int kTrialSteps = 50;

  /// @param epoch_ns ROS time of tick 0 of the first episode, ns.
  LiveRun(hovercraft::Scenario scenario, std::int64_t epoch_ns);

  hovercraft::Simulation& simulation() { return simulation_; }
  const hovercraft::Simulation& simulation() const { return simulation_; }
  std::uint32_t episode() const { return episode_; }

  /// What messages say of the current tick.
  RunStamp place() const { return {headerStamp(), episode_, events_}; }
  /// ROS time of the current tick.
  ros::Time stamp() const { return stampOf(simulation_.tick()); }
  /// The same for a header: ROS takes time 0 for no time, so that what happens then is stamped as
  /// tick 1, as in the bags of `simulate`.
  ros::Time headerStamp() const { return stamp().isZero() ? stampOf(1) : stamp(); }
  ros::Time stampOf(hovercraft::Tick tick) const;
  /// ROS time of a measurement. After a load a sample may be of before time 0: it gets 1 ns.
  ros::Time sampleStamp(hovercraft::Tick tick) const;
  /// Of tick 0 of this episode, ns.
  std::int64_t epochNs() const { return epoch_ns_; }

  /// Applies an event at the current tick (run_events.h) and returns it with its header, number,
  /// tick and episode.
  /// @throws std::invalid_argument as applyEvent(), or if a motion, a wrench or a wind makes the
  /// motion diverge within kTrialSteps from there; nothing has changed then.
  hovercraft_sim::RunEvent apply(hovercraft_sim::RunEvent event);

  /// How often contact was cut off (World::stalls()) in all episodes, but for trials.
  std::uint64_t stalls() const;

  /// Lets ROS time go on by one step while the simulation stands: a stamp of its own for the
  /// current tick, where the one before has been published.
  void renewStamp() { epoch_ns_ += simulation_.scenario().step_ns; }

 private:
  void applyOnTrial(const hovercraft_sim::RunEvent& event);

  hovercraft::Simulation simulation_;
  std::int64_t epoch_ns_;  // of tick 0 of this episode; below 0 after a load of a long run
  std::uint32_t episode_ = 0;
  std::uint64_t events_ = 0;        // of this episode
  std::uint64_t trial_stalls_ = 0;  // that the world has counted in trials
};

}  // namespace hovercraft_ros
