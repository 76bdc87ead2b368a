#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

/// Manoeuvres as they are asked for, checked by whoever makes them (scenario/pilot_parser.h).
/// Sides, names and measures are those of the ITTC's procedure for full-scale manoeuvring trials
/// (7.5-04-02-01); angles are in degrees, as its manoeuvres are called (zig-zag 10/10).
namespace hovercraft {

/// One level for each channel of a plan: N of an engine, the unit of its kind of another actuator.
using Levels = std::vector<double>;

/// What a helm order does: hard over to one side adds these to the throttle, less of it a share.
struct Helm {
  double hard_over_deg = 35.0;  // deg, of a helm that is hard over
  Levels port;                  // added hard over to port
  Levels starboard;             // to starboard
};

enum class Side { kStarboard, kPort };

/// What answers a step: speed ahead, speed to port, yaw rate, heading.
enum class Response { kSurge, kSway, kYawRate, kHeading };

/// Levels one after another, each held.
struct Steps {
  std::vector<Levels> levels;            // one after another
  double hold = 0.0;                     // s
  Response response = Response::kSurge;  // what is measured
};

/// From one set of levels to another along straight lines.
struct Ramp {
  Levels from;            // at the beginning
  Levels to;              // at the end
  double duration = 0.0;  // s
};

/// A pseudo-random binary sequence of maximum length, 2^order - 1 bits.
struct Prbs {
  Levels low;        // of a bit 0
  Levels high;       // of a bit 1
  int order = 7;     // of the shift register, kLeastPrbsOrder to kMostPrbsOrder
  double bit = 0.0;  // s, that each is held
  int cycles = 1;    // how often the whole sequence is flown
};
constexpr int kLeastPrbsOrder = 2;  // bits
constexpr int kMostPrbsOrder = 12;  // bits

/// centre + amplitude · sin(phase), with a frequency that goes from one to another.
struct Chirp {
  Levels centre;                 // the mean
  Levels amplitude;              // on both sides of it
  double first_frequency = 0.0;  // Hz
  double last_frequency = 0.0;   // Hz
  double duration = 0.0;         // s
  bool is_logarithmic = false;   // else the frequency grows linearly
};

/// Zig-zag: the helm goes over to the other side whenever the heading has changed by so much.
struct ZigZag {
  double helm_deg = 10.0;         // deg, of the helm to each side
  double heading_deg = 10.0;      // deg, of the heading from the first one
  int executes = 5;               // how often the helm is put over
  Side first = Side::kStarboard;  // to which the helm goes first
};

/// Turning circle.
struct TurningCircle {
  double helm_deg = 35.0;        // deg
  double turn_deg = 540.0;       // where it ends
  Side side = Side::kStarboard;  // where it turns to
};

/// A whole turn to one side, then one to the other.
struct FigureOfEight {
  double helm_deg = 35.0;         // deg
  Side first = Side::kStarboard;  // of the first turn
};

/// Stop: other levels until the craft is dead in the water. With all astern a crash stop, with 0
/// the stopping inertia test.
struct Stop {
  Levels levels;            // from the execute on
  double end_speed = 0.02;  // m/s ahead
};

struct Manoeuvre {
  std::string name;       // in the file
  Levels throttle;        // during the approach; of those with a helm also afterwards
  double approach = 0.0;  // s, with the helm amidships, before the first execute
  double longest = 0.0;   // s after the first execute: then it is given up
  /// What is done.
  std::variant<Steps, Ramp, Prbs, Chirp, ZigZag, TurningCircle, FigureOfEight, Stop> task;
};

/// What is flown with one craft.
struct PilotPlan {
  double period = 0.01;               // s from one decision to the next
  Helm helm;                          // what helm orders mean
  std::vector<Manoeuvre> manoeuvres;  // one after another
};

/// The word of a file for a manoeuvre's kind, in the order of Manoeuvre::task: steps, ramp, ...
const std::vector<std::string>& manoeuvreKindNames();
/// Those of Response and of Side.
const std::vector<std::string>& responseNames();
const std::vector<std::string>& sideNames();

}  // namespace hovercraft
