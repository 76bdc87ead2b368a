#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <hovercraft_sim/ActuatorCommand.h>
#include <hovercraft_sim/State.h>
#include <hovercraft_sim/ThrustCommand.h>
#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/single_subscriber_publisher.h>
#include <ros/subscriber.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/pacing/warning_limiter.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/craft_pilot.h"

namespace hovercraft_ros {

/// Flies a file of manoeuvres with a craft of a live simulation: each of its states is answered by
/// one command with the state's stamp, so that it works in lockstep. There the command acts from
/// the state's own tick on, as in `simulate`; at any other pace some steps later. Until the first
/// decision the answer is the levels of the start.
///
/// A new episode (reset, load), ticks that go back, or states that nobody publishes any more end
/// the flight: the manoeuvre is given up. But the first state may be one that was latched before a
/// reset: a run that begins anew after it is flown from its start. A state that no simulation has
/// is dropped, with a warning.
class HOVERCRAFT_PUBLIC PilotNode {
 public:
  /// @param handle of the namespace that the craft's namespace lies in.
  PilotNode(const ros::NodeHandle& handle, const hovercraft::Scenario& scenario,
            hovercraft::PilotFile file);
  PilotNode(const PilotNode&) = delete;
  PilotNode& operator=(const PilotNode&) = delete;

  /// The plan is flown, or given up, and the time after it is over.
  bool isDone() const { return is_done_; }
  /// Ends the flight if the publisher of the states was there and is gone, or no longer answers. To
  /// be called now and then.
  void watchPublisher();
  const hovercraft::CraftPilot& pilot() const { return pilot_; }

 private:
  void answer(const ros::MessageEvent<const hovercraft_sim::State>& event);
  void answer(const hovercraft_sim::State& state);
  bool isNewRun(const hovercraft_sim::State& state) const;
  void beginAnew();
  bool isPublisherAlive();
  void warnOfMissed(hovercraft::Tick last, hovercraft::Tick now);
  /// @param reason why the flight ends.
  void giveUp(const std::string& reason);
  void send(const hovercraft_sim::State& state);
  void tell(const ros::Time& stamp);

  std::int64_t step_ns_;
  hovercraft::VehicleScenario craft_;
  hovercraft::PilotFile file_;
  hovercraft::CraftPilot pilot_;
  hovercraft_sim::ThrustCommand thrusts_;   // the last ones, of engines alone
  hovercraft_sim::ActuatorCommand levels_;  // the last ones, of others too
  std::optional<hovercraft_sim::State> last_;
  std::uint64_t answered_ = 0;  // states
  std::string publisher_;       // of the last state
  std::int64_t asked_ns_ = 0;   // wall time at which it was last known to be there
  std::size_t told_ = 0;        // manoeuvres that were published
  bool is_done_ = false;
  bool had_publisher_ = false;
  std::uint64_t dropped_ = 0;  // states
  std::uint64_t missed_ = 0;   // times that decisions came late or not at all
  hovercraft::WarningLimiter drop_warnings_;
  hovercraft::WarningLimiter miss_warnings_;
  ros::Publisher thrust_;
  ros::Publisher actuators_;
  ros::Publisher manoeuvres_;
  ros::Subscriber states_;
};

}  // namespace hovercraft_ros
