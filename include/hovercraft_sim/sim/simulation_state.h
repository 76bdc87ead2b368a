#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "hovercraft_sim/body/body_state.h"
#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/hovercraft/gusts.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/sensors/sensor_suite.h"
#include "hovercraft_sim/sim/command_log.h"
#include "hovercraft_sim/world/world.h"

/// What a simulation is at one tick, and what it tells of it.

namespace hovercraft {

/// A wrench that acts on one craft for some steps, besides engines, drag and weight.
struct ExternalWrench {
  enum class Frame { kWorld, kBody };

  std::size_t vehicle = 0;      // index into Scenario::vehicles
  Frame frame = Frame::kWorld;  // of `wrench`
  Wrench wrench;                // N and N m about the centre of mass
  Tick end_tick = 0;            // it acts in the steps that begin before this tick
};

/// Everything that determines the future of a run, besides the scenario and what is still to be
/// pushed.
struct SimulationState {
  Tick tick = 0;                         // at which it stands
  std::int64_t seed = 1;                 // of the run's noise
  Vector3 wind_W = Vector3::Zero();      // m/s, the mean
  std::vector<BodyState> bodies;         // vehicles, then loose ones, in the scenario's order
  std::vector<EngineStates> engines;     // of each vehicle
  std::vector<ExternalWrench> wrenches;  // in the order in which they were applied
  std::vector<ContactCache> contacts;    // of pairs that are near, ascending
  std::vector<SensorState> sensors;      // of all craft, in the order of the scenario
  std::vector<GustState> gusts;          // of each body; empty without gusts
  CommandLog commands;                   // that have not taken effect
};

/// A contact as it is reported: once, in the step in which it happened.
struct ContactEvent {
  ContactKind kind = ContactKind::kBounce;  // what happened
  std::int64_t time_ns = 0;                 // of the impact, to the nearest ns
  double time = 0.0;                        // s
  Tick tick = 0;                            // at the end of the step
  std::string_view a;                       // names, as long as the simulation lives
  std::string_view b;                       // likewise
  Vector3 p_WC;                             // m
  Vector3 nhat_AB_W;                        // unit
  Vector3 impulse_B_W;                      // N s, on b
};

/// Motion of one craft as it is reported; W world, B at the centre of mass.
struct Motion {
  Vector3 p_WB;                // m
  Quaternion q_WB;             // B -> W
  Twist twist;                 // in W
  Vector3 momentum_W;          // kg m/s
  Vector3 angular_momentum_W;  // kg m²/s
  double energy;  // J: kinetic, and potential in the field of gravity (0 at the origin of W)
};

/// One engine as it is reported.
struct EngineReport {
  double commanded;         // N or in the unit of its commands, as received
  double applied;           // N, after limits, time-out and lag
  bool saturated;           // the command is beyond the limits
  bool timed_out;           // the last command is too old
  double command_age;       // s of simulated time; -1 before the first command
  double efficiency = 1.0;  // EngineState
  bool stuck = false;       // EngineState
};

/// The cushion of a craft as it is reported.
struct CushionReport {
  std::vector<CellReport> cells;   // in the order of the scenario
  std::vector<double> fan_speeds;  // of each fan, shares of their nominal speeds
  double power = 0.0;              // W, that the fans put into the air
};

}  // namespace hovercraft
