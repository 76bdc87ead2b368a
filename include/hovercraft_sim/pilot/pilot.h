#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/pilot/manoeuvre.h"
#include "hovercraft_sim/pilot/measures.h"
#include "hovercraft_sim/pilot/planar_motion.h"

namespace hovercraft {

/// A manoeuvre that was flown, and what it came to.
struct FlownManoeuvre {
  std::string name;         // of the plan
  std::string kind;         // zig_zag, turning_circle, ...
  bool is_complete = true;  // false: it was given up, or never began
  std::string reason;       // why it was given up
  double begin = 0.0;       // s: of the approach
  double execute = 0.0;     // s: of the first execute; if it was given up before, its end
  double end = 0.0;         // s
  Measures measures;        // what it came to
};

/// What it came to, a line each, for people.
HOVERCRAFT_PUBLIC std::string toText(const FlownManoeuvre& flown);

/// Flies a plan with one craft: at each decision it is told how the craft moves, and gives the
/// levels that hold until the next one. Its answers depend on nothing but the motions that it was
/// told, so the same motions give the same levels, to the last bit, live or not.
class HOVERCRAFT_PUBLIC Pilot {
 public:
  /// @param plan as it was parsed.
  explicit Pilot(PilotPlan plan);

  /// @param motion at this decision; times go up.
  /// @returns what the channels are to be set to; empty once the plan is flown.
  const Levels& decide(const PlanarMotion& motion);

  /// Whether all of the plan is flown.
  bool isDone() const { return current_ >= plan_.manoeuvres.size(); }
  /// Those that ended, in their order.
  const std::vector<FlownManoeuvre>& flown() const { return flown_; }
  /// Ends the manoeuvre that is flown, as given up for a reason, and all that would follow.
  void giveUp(const std::string& reason);

 private:
  const Manoeuvre& manoeuvre() const { return plan_.manoeuvres[current_]; }
  double sinceExecute() const { return track_.back().time - track_.front().time; }
  bool isApproaching(const PlanarMotion& motion);
  /// Sets the levels, or returns true if the manoeuvre is over.
  bool fly();
  bool fly(const ZigZag& task);
  bool fly(const TurningCircle& task);
  bool fly(const FigureOfEight& task);
  bool fly(const Stop& task);
  template <class Timed>
  bool fly(const Timed& task);
  /// @param helm_deg to starboard.
  void steer(double helm_deg);
  void end(std::string reason);
  Measures measures() const;

  PilotPlan plan_;
  std::size_t current_ = 0;
  std::vector<FlownManoeuvre> flown_;
  Levels levels_;
  Track track_;                        // from the first execute on
  std::vector<std::size_t> executes_;  // indices of it
  double begin_ = 0.0;                 // s, of the approach
  double last_time_ = 0.0;             // s, of the last decision
  bool has_begun_ = false;
};

}  // namespace hovercraft
