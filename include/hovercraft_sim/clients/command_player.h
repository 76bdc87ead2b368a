#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <hovercraft_sim/State.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/command_source.h"

namespace hovercraft_ros {

/// Simulated time that has passed since the first state that was heard, in ticks. It goes on
/// through the episodes: a reset or a load takes no time, as ROS time goes on. Where ticks go back
/// without a new episode (the simulation was started again) it goes on from the first state of the
/// new run.
class HOVERCRAFT_PUBLIC PlayedTime {
 public:
  explicit PlayedTime(std::int64_t step_ns) : step_ns_(step_ns) {}

  /// The next state was heard. @returns ticks, 0 at first; they never go back.
  hovercraft::Tick hear(const hovercraft_sim::State& state);
  /// Whether that state began an episode or a run, whose engines are without command.
  bool isNewRun() const { return is_new_run_; }

 private:
  std::int64_t step_ns_;
  std::optional<hovercraft_sim::State> last_;
  hovercraft::Tick played_ = 0;
  bool is_new_run_ = false;
};

/// Plays commands into a live simulation as ThrustCommand messages, on simulated time: it listens
/// to the ticks of the state topic, so that it keeps to the manoeuvre at any pace. Tick 0 of the
/// commands is the first state that it hears. The last thrusts are repeated well within the
/// time-outs of the engines. A reset or a load does not stop it: the commands go on in the new
/// episode at the simulated time at which they were, with the thrusts that hold then.
class HOVERCRAFT_PUBLIC CommandPlayer {
 public:
  /// @param handle of the namespace that the craft's namespaces lie in.
  /// @param settle_ns simulated time to wait after the last command, with the thrusts held, ns.
  /// @param wanted_subscribers of each thrust topic before it begins: the simulation, and whoever
  /// records.
  CommandPlayer(const ros::NodeHandle& handle, const hovercraft::Scenario& scenario,
                std::unique_ptr<hovercraft::CommandSource> source, std::int64_t settle_ns,
                std::uint32_t wanted_subscribers);

  /// Everything was played and the settling time is over.
  bool isDone() const { return done_; }

 private:
  void onState(const hovercraft_sim::State& state);
  void takeDue(hovercraft::Tick tick);
  void send(const ros::Time& stamp);
  bool allConnected() const;

  std::unique_ptr<hovercraft::CommandSource> source_;
  std::optional<hovercraft::Command> next_;
  hovercraft::Tick settle_ticks_;
  hovercraft::Tick repeat_ticks_;
  std::uint32_t wanted_subscribers_;
  std::vector<ros::Publisher> publishers_;           // by vehicle
  std::vector<ros::Publisher> actuator_publishers_;  // of craft that have such
  std::vector<hovercraft::VehicleScenario> craft_;
  std::vector<hovercraft::Command> held_;  // of each craft
  std::vector<bool> commanded_;
  ros::Subscriber state_subscriber_;
  PlayedTime time_;
  bool has_begun_ = false;
  hovercraft::Tick last_command_ = 0;
  hovercraft::Tick last_sent_ = 0;
  bool done_ = false;
};

}  // namespace hovercraft_ros
