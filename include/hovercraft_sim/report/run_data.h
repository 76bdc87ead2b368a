#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hovercraft_sim/math/quaternion.h"
#include "hovercraft_sim/math/vector.h"
#include "hovercraft_sim/scenario/scenario.h"

/// What a page shows of one bag. All times are ns from the start of the run: from tick 0 where the
/// bag has states, else from its first pose.
namespace hovercraft_ros {

constexpr double kNanosecond = 1e-9;  // s

/// Nothing is drawn beyond: a value of a curve, and a position in m.
constexpr double kGreatestDrawn = 1e300;
constexpr double kFarthestDrawn = 1e9;

/// One curve of a panel.
struct RunCurve {
  std::string label;
  std::vector<double> values;  // one for each time of the panel; not finite: a gap
  bool is_demand = false;      // drawn dotted, in the colour of the curve of the same label
};

/// When something held, such as that an engine was saturated.
struct RunBand {
  std::string label;
  std::string kind;                                             // "saturated" or "timed_out"
  std::vector<std::pair<std::int64_t, std::int64_t>> spans_ns;  // begin, end
};

/// Curves of one unit over the same times.
struct RunPanel {
  std::string title;
  std::string source;    // the topic
  std::string unit;      // empty: none, or not known
  bool is_main = false;  // one that is always looked at; others come behind
  std::vector<std::int64_t> times_ns;
  std::vector<RunCurve> curves;
  std::vector<RunBand> bands;
};

/// The way of base_link, or of the one point of a foreign bag.
struct RunMotion {
  std::vector<std::int64_t> times_ns;
  std::array<std::vector<double>, 3> position;     // m, in W
  std::array<std::vector<double>, 4> orientation;  // x, y, z, w
  std::string source;                              // the topic
};

/// Velocities in the axes of the body.
struct RunVelocity {
  std::vector<std::int64_t> times_ns;
  std::array<std::vector<double>, 3> linear;   // m/s
  std::array<std::vector<double>, 3> angular;  // rad/s
  std::string source;                          // the topic; of poses: that they are their quotients
};

/// A solid in the frame of its body (of an obstacle: in W).
struct RunShape {
  enum class Kind { kBox, kCylinder, kCone, kSphere, kFaces };
  Kind kind = Kind::kBox;
  hovercraft::Vector3 size = hovercraft::Vector3::Zero();  // m: edges; radius, length; radius
  hovercraft::Vector3 position = hovercraft::Vector3::Zero();
  hovercraft::Quaternion orientation;
  std::vector<hovercraft::Vector3> vertices;  // m, of faces
  std::vector<std::vector<std::int32_t>> faces;
  std::string role = "hull";  // what it is: hull, skirt, body, obstacle
};

struct RunEngine {
  std::string name;
  hovercraft::Vector3 position = hovercraft::Vector3::Zero();  // m, in base_link
  hovercraft::Vector3 direction = hovercraft::Vector3::UnitX();
  double full_thrust = 0.0;  // N, the greater of its limits
};

/// Work on a craft between the first and the last of its states, J.
struct EnergyLedger {
  double begin = 0.0;     // kinetic plus potential
  double engines = 0.0;   // work of the thrusts
  double drag = 0.0;      // work of the drag, the wind included
  double contacts = 0.0;  // what else changed between two states with a contact of the craft
  double others = 0.0;    // what else changed: cushion, pushes, set_state, the steps of the sums
  double end = 0.0;
};

struct RunBody {
  std::string name;
  bool is_craft = true;  // else a loose body
  std::vector<RunShape> shapes;
  std::vector<RunEngine> engines;
  RunMotion motion;
  std::optional<RunVelocity> velocity;
  std::vector<RunPanel> panels;
  std::optional<EnergyLedger> ledger;
};

struct RunObstacle {
  std::string name;
  std::vector<RunShape> shapes;
};

/// What lies under everything: a plane, or heights at even places.
struct RunGround {
  double height = 0.0;  // m, of a plane at x = y = 0
  hovercraft::Vector3 normal = hovercraft::Vector3::UnitZ();
  std::size_t columns = 0;  // along x; 0: a plane
  double spacing = 0.0;     // m
  double x = 0.0;           // m, of the first column and row
  double y = 0.0;
  std::vector<double> heights;  // m, row by row
};

struct RunContact {
  std::int64_t time_ns = 0;
  std::string kind;  // bounce, stick, rest
  std::string a;
  std::string b;
  hovercraft::Vector3 point = hovercraft::Vector3::Zero();    // m, in W
  hovercraft::Vector3 normal = hovercraft::Vector3::Zero();   // unit, from a to b
  hovercraft::Vector3 impulse = hovercraft::Vector3::Zero();  // N s, on b
};

/// A reset, a load and the like.
struct RunMark {
  std::int64_t time_ns = 0;
  std::string text;
};

/// A manoeuvre that a pilot has flown.
struct RunManoeuvre {
  std::string craft;
  std::string name;
  std::string kind;
  bool is_complete = true;
  std::int64_t execute_ns = 0;  // the first execute
  std::int64_t end_ns = 0;
  std::string text;  // what it came to, a line each
};

/// A number or a word about the run.
struct RunFact {
  std::string label;
  std::string value;
};

struct RunData {
  std::string source;           // the file
  std::int64_t zero_ns = 0;     // ROS time of time 0
  std::int64_t end_ns = 0;      // time of the last pose or sample
  std::vector<RunBody> bodies;  // craft first, then loose bodies
  std::vector<RunObstacle> obstacles;
  std::optional<RunGround> ground;
  std::vector<RunContact> contacts;
  std::vector<RunManoeuvre> manoeuvres;
  std::vector<RunMark> marks;
  std::vector<RunFact> facts;
  std::vector<RunPanel> panels;    // of no craft
  std::vector<std::string> notes;  // sentences: what is missing, what was derived
  std::string scenario_text;
  std::optional<hovercraft::Scenario> scenario;
};

}  // namespace hovercraft_ros
