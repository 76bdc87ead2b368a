#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include <hovercraft_sim/State.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/math/vector.h"

namespace hovercraft_ros::testing {

/// Flies one craft over its topics and watches its state.
class Pilot {
 public:
  using Condition = std::function<bool(const hovercraft_sim::State&)>;

  /// Returns when the simulation hears its thrusts and it hears the state.
  explicit Pilot(const std::string& vehicle);
  Pilot(const Pilot&) = delete;
  Pilot& operator=(const Pilot&) = delete;

  /// One message for all engines; N: rear, left, right.
  void command(const hovercraft::Vector3& thrusts);
  /// One message for one engine, N.
  void command(hovercraft::EngineId engine, double thrust);

  /// Waits until a state fulfils the condition.
  /// @param what is awaited, for the error when that never happens.
  void waitFor(const std::string& what, const Condition& condition);
  /// Likewise, and commands the thrusts with every tenth state that it hears, beginning with the
  /// next one.
  void flyUntil(const std::string& what, const hovercraft::Vector3& thrusts,
                const Condition& condition);
  /// Waits for this much simulated time from the last state that was heard.
  void waitFor(std::uint64_t ticks);
  void flyFor(std::uint64_t ticks, const hovercraft::Vector3& thrusts);

  /// The last state that was heard.
  const hovercraft_sim::State& state() const { return state_; }

 private:
  void onState(const hovercraft_sim::State& state);

  std::string vehicle_;
  ros::Publisher all_engines_;
  std::array<ros::Publisher, hovercraft::kEngineCount> single_engines_;
  ros::Subscriber state_subscriber_;
  hovercraft_sim::State state_;
  std::function<void()> on_state_;
};

/// A condition: simulated time reaches the tick.
inline Pilot::Condition tickReaches(std::uint64_t tick) {
  return [tick](const hovercraft_sim::State& state) { return state.tick >= tick; };
}

}  // namespace hovercraft_ros::testing
