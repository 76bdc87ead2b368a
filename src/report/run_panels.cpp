#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

#include "hovercraft_sim/hovercraft/engines.h"
#include "hovercraft_sim/report/run_parts.h"

namespace hovercraft_ros {
namespace {

std::vector<std::int64_t> timesOf(const TopicSamples& samples, std::int64_t zero_ns) {
  std::vector<std::int64_t> times_ns = samples.stamps_ns;
  for (std::int64_t& time_ns : times_ns) time_ns -= zero_ns;
  return times_ns;
}

/// What is 0, or the same number, all the time is no curve.
bool isFlat(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [&](double value) {
    return value == values.front() || !std::isfinite(value);
  });
}

RunPanel panel(const char* title, const char* unit, const std::string& source,
               std::vector<std::int64_t> times_ns) {
  RunPanel made;
  made.title = title;
  made.unit = unit;
  made.source = source;
  made.is_main = true;
  made.times_ns = std::move(times_ns);
  return made;
}

void addVelocityPanels(const RunVelocity& velocity, std::vector<RunPanel>& panels) {
  RunPanel linear =
      panel("Velocity in the axes of the craft", "m/s", velocity.source, velocity.times_ns);
  linear.curves.push_back({"forward u", velocity.linear[0]});
  linear.curves.push_back({"left v", velocity.linear[1]});
  if (!isFlat(velocity.linear[2])) linear.curves.push_back({"up w", velocity.linear[2]});
  panels.push_back(linear);
  RunPanel angular = panel("Yaw rate", "rad/s", velocity.source, velocity.times_ns);
  angular.curves.push_back({"yaw r", velocity.angular[2]});
  if (!isFlat(velocity.angular[0])) angular.curves.push_back({"roll p", velocity.angular[0]});
  if (!isFlat(velocity.angular[1])) angular.curves.push_back({"pitch q", velocity.angular[1]});
  if (angular.curves.size() > 1) angular.title = "Angular velocity in the axes of the craft";
  panels.push_back(angular);
}

/// When a flag of a topic was up: from its first message that has it to the first that has not.
RunBand bandOf(const std::vector<double>& flags, const std::vector<std::int64_t>& times_ns,
               std::string label, std::string kind) {
  RunBand band;
  band.label = std::move(label);
  band.kind = std::move(kind);
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i] == 0.0) continue;
    const std::size_t begin = i;
    while (i < flags.size() && flags[i] != 0.0) ++i;
    band.spans_ns.emplace_back(times_ns[begin], times_ns[std::min(i, flags.size() - 1)]);
  }
  return band;
}

/// The curves of an engine, applied and asked for, and when it was beyond its limits or timed out.
/// Nothing of one that never pushes.
void addEngine(const TopicSamples& engines, const std::string& engine, RunPanel& thrusts) {
  const auto* commanded = engines.column(engine + ".commanded");
  const auto* applied = engines.column(engine + ".applied");
  if (commanded == nullptr || applied == nullptr) return;
  const bool is_still = isFlat(*applied) && isFlat(*commanded);
  if (is_still && applied->front() == 0.0 && commanded->front() == 0.0) return;
  thrusts.curves.push_back({engine, *applied});
  thrusts.curves.push_back({engine, *commanded, true});
  for (const char* const kind : {"saturated", "timed_out"}) {
    const auto* flags = engines.column(engine + "." + kind);
    if (flags == nullptr) continue;
    RunBand band = bandOf(*flags, thrusts.times_ns, engine, kind);
    if (!band.spans_ns.empty()) thrusts.bands.push_back(band);
  }
}

void addThrustPanel(const TopicSamples& engines, std::int64_t zero_ns,
                    std::vector<RunPanel>& panels) {
  RunPanel thrusts = panel("Thrust", "N", engines.topic, timesOf(engines, zero_ns));
  for (const char* const name : hovercraft::kEngineNames) addEngine(engines, name, thrusts);
  if (!thrusts.curves.empty()) panels.push_back(thrusts);
}

/// Fixed-axis roll, pitch, yaw; the yaw without jumps.
void addAttitudePanels(const RunMotion& motion, std::vector<RunPanel>& panels) {
  const auto& [x, y, z, w] = motion.orientation;
  std::vector<double> roll;
  std::vector<double> pitch;
  std::vector<double> yaw;
  for (std::size_t i = 0; i < x.size(); ++i) {
    roll.push_back(
        std::atan2(2.0 * (w[i] * x[i] + y[i] * z[i]), 1.0 - 2.0 * (x[i] * x[i] + y[i] * y[i])));
    pitch.push_back(std::asin(std::clamp(2.0 * (w[i] * y[i] - z[i] * x[i]), -1.0, 1.0)));
    const double wrapped =
        std::atan2(2.0 * (w[i] * z[i] + x[i] * y[i]), 1.0 - 2.0 * (y[i] * y[i] + z[i] * z[i]));
    const double before = yaw.empty() ? wrapped : yaw.back();
    yaw.push_back(before + std::remainder(wrapped - before, 4.0 * std::acos(0.0)));
  }
  RunPanel heading = panel("Heading", "rad", motion.source, motion.times_ns);
  heading.curves.push_back({"yaw", yaw});
  panels.push_back(heading);
  RunPanel tilt = panel("Roll and pitch", "rad", motion.source, motion.times_ns);
  if (!isFlat(roll)) tilt.curves.push_back({"roll", roll});
  if (!isFlat(pitch)) tilt.curves.push_back({"pitch", pitch});
  if (!tilt.curves.empty()) panels.push_back(tilt);
  RunPanel height = panel("Height of base_link", "m", motion.source, motion.times_ns);
  height.curves.push_back({"z", motion.position[2]});
  if (!isFlat(motion.position[2])) panels.push_back(height);
}

/// The unit of what a field is called, for the fields of common messages. One more kind of number
/// is one more line.
std::string unitOf(const std::string& field) {
  static const std::map<std::string, std::string> units = {
      {"angular", "rad/s"},
      {"angular_acceleration", "rad/s²"},
      {"angular_velocity", "rad/s"},
      {"age", "s"},
      {"apparent", "m/s"},
      {"applied", "N"},
      {"commanded", "N"},
      {"demanded", "N"},
      {"altitude", "m"},
      {"energy", "J"},
      {"flow", "m³/s"},
      {"force", "N"},
      {"gap", "m"},
      {"height", "m"},
      {"impulse", "N s"},
      {"lateness_p50", "s"},
      {"lateness_p99", "s"},
      {"latitude", "deg"},
      {"linear", "m/s"},
      {"mean", "m/s"},
      {"linear_acceleration", "m/s²"},
      {"longitude", "deg"},
      {"magnetic_field", "T"},
      {"position", "m"},
      {"power", "W"},
      {"pressure", "Pa"},
      {"range", "m"},
      {"step_time_p50", "s"},
      {"step_time_p99", "s"},
      {"temperature", "°C"},
      {"thrust", "N"},
      {"time_given_up", "s"},
      {"torque", "N m"},
      {"translation", "m"},
      {"velocity", "m/s"},
      {"true_wind", "m/s"},
      {"wind", "m/s"},
  };
  const auto unit = units.find(field);
  return unit == units.end() ? "" : unit->second;
}

/// Types whose numbers are of one kind, and what that is.
struct OneKind {
  const char* title;
  const char* unit;
};
const OneKind* oneKindOf(const std::string& type) {
  static const std::map<std::string, OneKind> kinds = {
      {"hovercraft_sim/ThrustCommand", {"Thrust asked for", "N"}},
      {"geometry_msgs/Vector3Stamped", {"Vector", ""}},
      {"geometry_msgs/PointStamped", {"Point", "m"}},
  };
  const auto kind = kinds.find(type);
  return kind == kinds.end() ? nullptr : &kind->second;
}

/// `a.b[2].c` lies in `a.b[2]`.
std::string parentOf(const std::string& path) {
  const std::size_t dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}
std::string lastOf(const std::string& path) {
  const std::string last = path.substr(path.rfind('.') + 1);
  return last.substr(0, last.find('['));
}

/// `a[2].b` without the numbers: all elements of a list have one panel.
std::string withoutIndices(const std::string& path) {
  std::string name;
  bool is_index = false;
  for (const char character : path) {
    if (character == '[') is_index = true;
    if (!is_index) name += character;
    if (character == ']') is_index = false;
  }
  return name;
}

/// What an element of a list is called: by its `name`, if it has one.
std::string labelOf(const TopicSamples& samples, const std::string& path) {
  const auto* names = samples.textColumn(parentOf(path) + ".name");
  if (names == nullptr || names->empty() || names->front().empty()) return path;
  return names->front();
}

/// Where the numbers of a field go: the panel by its title, with its unit, and what the curve is
/// called.
struct CurvePlace {
  std::string title;
  std::string unit;
  std::string label;
};

/// x, y, z of a vector belong together; what has a unit of its own stands for itself.
CurvePlace placeOf(const TopicSamples& samples, const std::string& path) {
  const std::string parent = parentOf(path);
  const std::string own = unitOf(lastOf(path));
  const bool is_component = !parent.empty() && own.empty();
  CurvePlace place;
  if (is_component) {
    place = {parent, unitOf(lastOf(parent)), path.substr(parent.size() + 1)};
  } else {
    place = {withoutIndices(path), own, labelOf(samples, path)};
  }
  // Each actuator has a unit of its own.
  const std::string last = lastOf(path);
  const bool is_level = last == "applied" || last == "commanded";
  if (samples.type == "hovercraft_sim/ActuatorStatusArray" && is_level) place.unit.clear();
  const OneKind* const one_kind = oneKindOf(samples.type);
  if (one_kind != nullptr) {
    place.title = one_kind->title;
    place.unit = one_kind->unit;
  }
  return place;
}

bool isDrawn(const TopicSamples& samples, std::size_t leaf) {
  const LeafKind kind = samples.leaves[leaf].kind;
  if (kind == LeafKind::kText || kind == LeafKind::kTime) return false;
  return !samples.numbers[leaf].empty() && !isFlat(samples.numbers[leaf]);
}

}  // namespace

std::vector<RunPanel> mainPanels(const RunBody& body, const BodyTopics& topics,
                                 std::int64_t zero_ns) {
  std::vector<RunPanel> panels;
  if (body.velocity) addVelocityPanels(*body.velocity, panels);
  if (topics.engines != nullptr) addThrustPanel(*topics.engines, zero_ns, panels);
  addAttitudePanels(body.motion, panels);
  const auto* energy = topics.state != nullptr ? topics.state->column("energy") : nullptr;
  if (energy != nullptr && !isFlat(*energy)) {
    RunPanel panel_of_energy = panel("Energy, kinetic and potential", "J", topics.state->topic,
                                     timesOf(*topics.state, zero_ns));
    panel_of_energy.curves.push_back({"energy", *energy});
    panels.push_back(panel_of_energy);
  }
  return panels;
}

std::vector<RunPanel> panelsOfTopic(const TopicSamples& samples, std::int64_t zero_ns) {
  std::vector<RunPanel> panels;
  std::map<std::string, std::size_t> indices;  // of the panels, by title
  for (std::size_t i = 0; i < samples.leaves.size(); ++i) {
    if (!isDrawn(samples, i)) continue;
    const CurvePlace place = placeOf(samples, samples.leaves[i].path);
    const auto [index, is_new] = indices.emplace(place.title, panels.size());
    if (is_new) {
      RunPanel made;
      made.source = samples.topic;
      made.title = place.title;
      made.unit = place.unit;
      made.times_ns = timesOf(samples, zero_ns);
      panels.push_back(made);
    }
    panels[index->second].curves.push_back({place.label, samples.numbers[i]});
  }
  return panels;
}

}  // namespace hovercraft_ros
