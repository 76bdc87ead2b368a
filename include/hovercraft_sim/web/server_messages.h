#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"
#include "hovercraft_sim/web/driver_seats.h"

/// What viewers are told, as JSON (doc/web.md). Each is made once, however many viewers there are.
namespace hovercraft_ros {

/// A craft or a loose body at one tick.
struct LiveBody {
  std::array<double, 3> position{};          // m, of base_link in W
  std::array<double, 4> orientation{};       // x, y, z, w
  std::array<double, 3> velocity{};          // m/s, of base_link in its own axes; craft only
  std::array<double, 3> angular_velocity{};  // rad/s
  std::vector<double> applied;               // in the order of controlsOf(): what acts
  std::vector<double> demanded;              // what was commanded last; NaN: not heard
};

struct LiveState {
  double time = 0.0;  // s, simulated, of the episode
  std::uint64_t tick = 0;
  std::uint32_t episode = 0;
  std::vector<LiveBody> craft;   // in the order of the scenario
  std::vector<LiveBody> bodies;  // loose ones, likewise; of one not heard of the position is NaN
};

/// How the simulation keeps its pace.
struct LivePace {
  bool is_there = false;  // it was heard of within the last seconds
  bool is_paused = false;
  double wanted = 1.0;  // simulated per wall time; 0: as fast as it can
  double reached = 0.0;
};

struct Viewer {
  ViewerId id = 0;
  std::string name;
};

/// Everything that does not move: shapes, engines, obstacles and ground as the page of a run has
/// them (page.h), and the controls of each craft.
HOVERCRAFT_PUBLIC std::string sceneMessage(const hovercraft::Scenario& scenario,
                                           const std::string& source, const std::string& text);
HOVERCRAFT_PUBLIC std::string stateMessage(const LiveState& state);
HOVERCRAFT_PUBLIC std::string paceMessage(const LivePace& pace);
/// @param craft names in the order of the seats.
HOVERCRAFT_PUBLIC std::string seatsMessage(const DriverSeats& seats,
                                           const std::vector<std::string>& craft,
                                           const std::vector<Viewer>& viewers);
HOVERCRAFT_PUBLIC std::string helloMessage(const Viewer& viewer);
/// A sentence for everybody, or about what one has asked for. Bytes that are no UTF-8 become '?'.
HOVERCRAFT_PUBLIC std::string noteMessage(const std::string& text, bool is_failure);

}  // namespace hovercraft_ros
