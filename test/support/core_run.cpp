#include "core_run.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include <hovercraft_sim/EngineStatus.h>
#include <ros/serialization.h>

#include "hovercraft_sim/messages/vehicle_messages.h"
#include "hovercraft_sim/sim/run_observer.h"
#include "hovercraft_sim/sim/simulation.h"

namespace hovercraft_ros::testing {
namespace {

template <class Message>
std::string bitsWithoutHeader(Message message) {
  message.header = std_msgs::Header();
  std::string bytes(ros::serialization::serializationLength(message), '\0');
  ros::serialization::OStream stream(reinterpret_cast<std::uint8_t*>(bytes.data()),
                                     static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

/// What was recorded of one craft.
struct Track {
  VehicleMessages expected;
  std::map<std::uint64_t, hovercraft_sim::State> states;      // by tick
  std::map<ros::Time, hovercraft_sim::EngineStatus> engines;  // by stamp

  Track(const Recording& recording, const hovercraft::Scenario& scenario, std::size_t vehicle)
      : expected(scenario, vehicle) {
    const std::string prefix = "/" + scenario.vehicles[vehicle].name;
    for (const auto& state : recording.messages<hovercraft_sim::State>(prefix + "/state")) {
      states[state.tick] = state;
    }
    for (const auto& status :
         recording.messages<hovercraft_sim::EngineStatus>(prefix + "/engines")) {
      engines[status.header.stamp] = status;
    }
  }

  std::uint64_t lastTick() const { return states.empty() ? 0 : states.rbegin()->first; }

  /// Compares what was recorded at the simulation's tick; returns the difference, empty if there is
  /// none.
  std::string difference(const hovercraft::Simulation& simulation) {
    const auto state = states.find(static_cast<std::uint64_t>(simulation.tick()));
    if (state == states.end()) return "";
    const ros::Time stamp = state->second.header.stamp;
    expected.fill(simulation, {stamp});
    if (bitsWithoutHeader(state->second) != bitsWithoutHeader(expected.state())) {
      const auto& p = state->second.pose.position;
      const auto& q = expected.state().pose.position;
      return fmt::format(
          "{}, tick {}: state ({:.17g}, {:.17g}, hash {:x}) differs from the core's ({:.17g}, "
          "{:.17g}, hash {:x})",
          expected.name(), simulation.tick(), p.x, p.y, state->second.hash, q.x, q.y,
          expected.state().hash);
    }
    const auto status = engines.find(stamp);
    if (status != engines.end() &&
        bitsWithoutHeader(status->second) != bitsWithoutHeader(expected.engines())) {
      return fmt::format("{}, tick {}: engine status differs from the core's", expected.name(),
                         simulation.tick());
    }
    return "";
  }
};

}  // namespace

std::string bitsOfMotion(hovercraft_sim::State state) {
  state.tick = 0;
  state.hash = 0;  // of the tick too
  state.commands = 0;
  return bitsWithoutHeader(state);
}

void expectEqualsCoreRun(const Recording& recording) {
  const hovercraft::Scenario scenario = recording.scenario();
  hovercraft::Simulation simulation(scenario);
  for (const hovercraft::Command& command : recording.commands(scenario)) simulation.push(command);
  std::vector<Track> tracks;
  std::uint64_t last_tick = 0;
  for (std::size_t i = 0; i < scenario.vehicles.size(); ++i) {
    tracks.emplace_back(recording, scenario, i);
    ASSERT_FALSE(tracks.back().states.empty());
    ASSERT_FALSE(tracks.back().engines.empty());
    last_tick = std::max(last_tick, tracks.back().lastTick());
  }
  hovercraft::RunCallbacks told;
  simulation.observe(&told);
  told.on_applied = [&tracks](const hovercraft::Command& command) {
    tracks[command.vehicle].expected.appliedCommand(command, {});
  };
  while (static_cast<std::uint64_t>(simulation.tick()) < last_tick) {
    simulation.step();
    for (Track& track : tracks) {
      const std::string difference = track.difference(simulation);
      ASSERT_EQ(difference, "");
    }
  }
}

}  // namespace hovercraft_ros::testing
