#pragma once

#include <optional>
#include <string>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/math/time.h"
#include "hovercraft_sim/messages/tf_frames.h"
#include "hovercraft_sim/scenario/config_node.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft_ros {

/// The node's private parameters, checked.
struct NodeConfig {
  hovercraft::Scenario scenario;
  hovercraft::Tick publish_every = 1;  // ticks from one published state to the next
  TfFrames frames;                     // parameters world_frame, tf_prefix
  std::string truth_odom = "odom";     // topic of the true odometry
  std::optional<double> map_height;    // m: of the plane that `map` shows; none: no map
  double map_resolution = 0.05;        // m
  double real_time_factor = 1.0;       // simulated per wall time; 0: as fast as it can
  bool paused = false;                 // at the start
  bool clock = false;                  // publish /clock and be the time source, from time 0
  double clock_rate = 100.0;  // Hz of simulated time; never above kMaxClockRate of wall time
  bool lockstep = false;
  hovercraft::Tick control_period = 1;  // ticks between two commands in lockstep
  double lockstep_timeout = 5.0;        // s of wall time until a silent vehicle is named
  double diagnostic_period = 1.0;       // s of wall time between two reports

  // A greater factor than any machine reaches; 0 means as fast as it can.
  static constexpr double kMaxRealTimeFactor = 1000.0;
  // A smaller factor than this, which takes days for a second, is a slip; 0 means something else.
  static constexpr double kMinRealTimeFactor = 1e-6;
  static constexpr double kMinClockRate = 0.001;  // Hz: seldom enough for anyone
  static constexpr double kMaxClockRate =
      250.0;  // Hz: each message costs every Python node some CPU
  static constexpr double kMinDiagnosticPeriod = 0.01;    // s: a report costs more than a step
  static constexpr double kMaxDiagnosticPeriod = 3600.0;  // s
};

/// A real-time factor that a run can have: 0, or kMinRealTimeFactor to kMaxRealTimeFactor.
HOVERCRAFT_PUBLIC bool isRealTimeFactor(double factor);
extern HOVERCRAFT_PUBLIC const char* const kRealTimeFactorRuleText;

/// @param parameters the node's private namespace (parameterTree): `scenario`, the text of a
/// scenario file, with `scenario_dir`, the absolute path that its relative mesh paths start from;
/// or `scenario_file`, the absolute path of one; `set`, overrides of either (withOverrides);
/// `publish_rate` in Hz (a divisor of the step rate; default the nearest to 100),
/// `control_period` in s (a multiple of the step size; default the publish period; an error without
/// `lockstep`), `world_frame` and `tf_prefix`, `truth_odom`
/// (with another name than odom, the first odometry sensor gets `odom`), and what the other members
/// of NodeConfig are called.
/// @param node_name begins every error.
/// @throws std::invalid_argument that names the parameter, its value and the rule.
HOVERCRAFT_PUBLIC NodeConfig parseNodeConfig(const hovercraft::ConfigNode& parameters,
                                             const std::string& node_name);

}  // namespace hovercraft_ros
