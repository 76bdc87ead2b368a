#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include <hovercraft_sim/ActuatorCommand.h>
#include <hovercraft_sim/State.h>
#include <hovercraft_sim/ThrustCommand.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/single_subscriber_publisher.h>
#include <ros/subscriber.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/sim/craft_pilot.h"
#include "hovercraft_sim/sim/scenario.h"

namespace hovercraft_ros {

/// Flies a file of manoeuvres with a craft of a live simulation: each of its states is answered by
/// one command with the state's stamp, so that it works in lockstep. There the command acts from
/// the state's own tick on, as in `simulate`; at any other pace some steps later.
///
/// A new episode (reset, load), or ticks that go back, end the flight: the manoeuvre is given up.
class HOVERCRAFT_PUBLIC PilotNode {
 public:
  /// @param handle of the namespace that the craft's namespace lies in.
  PilotNode(const ros::NodeHandle& handle, const hovercraft::Scenario& scenario,
            hovercraft::PilotFile file);
  PilotNode(const PilotNode&) = delete;
  PilotNode& operator=(const PilotNode&) = delete;

  /// The plan is flown, or given up, and the time after it is over.
  bool isDone() const { return is_done_; }
  const hovercraft::CraftPilot& pilot() const { return pilot_; }

 private:
  void answer(const hovercraft_sim::State& state);
  bool isNewRun(const hovercraft_sim::State& state) const;
  void send(const hovercraft_sim::State& state);
  void tell(const ros::Time& stamp);

  hovercraft::VehicleScenario craft_;
  hovercraft::CraftPilot pilot_;
  hovercraft_sim::ThrustCommand thrusts_;   // the last ones, of engines alone
  hovercraft_sim::ActuatorCommand levels_;  // the last ones, of others too
  std::optional<hovercraft_sim::State> last_;
  std::size_t told_ = 0;  // manoeuvres that were published
  bool is_done_ = false;
  bool has_warned_ = false;
  ros::Publisher thrust_;
  ros::Publisher actuators_;
  ros::Publisher manoeuvres_;
  ros::Subscriber states_;
};

}  // namespace hovercraft_ros
