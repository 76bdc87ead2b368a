#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <hovercraft_sim/ScheduleCommands.h>
#include <hovercraft_sim/State.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/records/trajectory.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/sim/command_source.h"

namespace hovercraft_ros {

/// One flight of a live simulation, from its scenario's start: plays commands or lets others
/// command, and keeps every state that the simulation publishes. For tests of packages that fly
/// with the simulation (flight_test.h).
///
/// Commands are handed to the simulation before it flies (~schedule) and act at the ticks at which
/// `simulate` applies them, in lockstep or not, on the control grid or off it, whatever the load of
/// the machine: the states have the same bits.
class HOVERCRAFT_PUBLIC Flight {
 public:
  /// Waits for the simulation and takes it back to its start, where it stays paused.
  /// @param node name of the simulation's node; the craft lie in the same namespace.
  /// @throws std::runtime_error if it does not answer within half a minute of wall time.
  explicit Flight(const std::string& node = "/hovercraft_sim");
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  /// Plays the commands of a file (.csv, or .bag with commands or thrusts), goes on for `settle` s
  /// of simulated time after the last of them, and pauses. Times count from the flight's start;
  /// what lies before the present tick acts at once. Thrusts are repeated, so that no engine times
  /// out
  /// (`simulate --hold`).
  /// @throws std::invalid_argument about the file; std::runtime_error if simulated time stands
  /// still for half a minute.
  void play(const std::string& commands, double settle = 1.0);

  /// Lets it fly for a simulated time, s, while somebody else commands, and pauses.
  void watch(double duration);

  /// What was flown until now, one trajectory for each craft; time 0 is the start.
  const std::vector<hovercraft::Trajectory>& trajectories() const { return trajectories_; }

 private:
  /// What answers the states in lockstep.
  struct Played {
    std::unique_ptr<hovercraft::CommandSource> source;
    std::optional<hovercraft::Command> next;
    std::vector<hovercraft::Command> held;  // by vehicle
  };

  hovercraft::Scenario receiveScenario() const;
  void call(const std::string& service) const;
  hovercraft_sim::ScheduleCommands::Response schedule(
      const hovercraft_sim::ScheduleCommands::Request& commands) const;
  hovercraft::Tick scheduleAll(const std::string& commands, hovercraft::Tick now,
                               hovercraft::Tick settle);
  void answerStates(const std::string& commands);
  void connect();
  void onState(std::size_t vehicle, const hovercraft_sim::State& state);
  void answer(std::size_t vehicle, const hovercraft_sim::State& state);
  bool hasReached(hovercraft::Tick tick) const;
  void flyUntil(const std::string& what, const std::function<bool()>& condition);

  std::string node_;
  ros::NodeHandle handle_;
  hovercraft::Scenario scenario_;
  std::optional<std::uint32_t> episode_;
  std::vector<ros::Publisher> publishers_;           // by vehicle
  std::vector<ros::Publisher> actuator_publishers_;  // of craft that have such
  std::vector<ros::Subscriber> subscribers_;
  std::optional<Played> played_;
  std::vector<hovercraft::Trajectory> trajectories_;
};

/// How far a flight may be from its reference, m and rad. Neither set: the same to the last bit.
struct FlightTolerance {
  std::optional<double> position;  // m
  std::optional<double> attitude;  // rad
};

struct FlightVerdict {
  bool follows = false;  // within the tolerance
  std::string text;      // what parted first, when, by how much; or how close they stayed
};

/// Compares a flight with the trajectories of a reference (.bag or .csv) at each time of the
/// reference from the flight's first state on, interpolating where the flight has no state of that
/// time. A flight that ends before its reference does not follow it.
/// @throws std::invalid_argument about the reference.
HOVERCRAFT_PUBLIC FlightVerdict judge(const std::vector<hovercraft::Trajectory>& flown,
                                      const std::string& reference,
                                      const FlightTolerance& tolerance);

}  // namespace hovercraft_ros
