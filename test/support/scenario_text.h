#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "hovercraft_sim/scenario/scenario_parser.h"

#include "files.h"

namespace hovercraft::testing {

/// A valid scenario; each of its lines can be replaced by with().
inline const std::string& validScenario() {
  static const std::string text = R"(step_size: 0.002
integrator: rk4
orientation: matrix
model: spatial
gravity: [0, 0, -9.81]
wind: [1, -2, 0.5]
seed: 7
vehicles:
  alpha:
    mass: 5.5
    center_of_mass: [0.01, 0.02, 0.03]
    inertia: {ixx: 0.1, iyy: 0.2, izz: 0.25, ixy: 0.01, ixz: -0.02, iyz: 0.03}
    engines:
      rear: {position: [-0.25, 0, 0.05], direction: [1, 0, 0], min_thrust: -1, max_thrust: 4.5, time_constant: 0.1, timeout: 0.75}
      left: {position: [0.2, 0.15, 0.05], direction: [0, -1, 0], min_thrust: 0, max_thrust: 1.5}
      right: {position: [0.2, -0.15, 0.05], direction: [0, 0.6, 0.8], min_thrust: 0, max_thrust: 1.25}
    drag: {linear: [0.8, 1.2, 1.6], quadratic: [0.4, 0.9, 1.1], angular_linear: [0.12, 0.13, 0.14], angular_quadratic: [0.05, 0.06, 0.07]}
    initial: {position: [1, 2, 3], rpy: [0.1, 0.2, 0.3], velocity: [4, 5, 6], angular_velocity: [0.4, 0.5, 0.6]}
)";
  return text;
}

/// `text` with its only occurrence of `old_part` replaced.
inline std::string with(std::string text, const std::string& old_part,
                        const std::string& new_part) {
  const std::size_t place = text.find(old_part);
  if (place == std::string::npos || text.find(old_part, place + 1) != std::string::npos) {
    throw std::logic_error("'" + old_part + "' must stand once in the text");
  }
  return text.replace(place, old_part.size(), new_part);
}

/// The lines of validScenario() that parts stand for.
constexpr const char* kMassByNumbers =
    "    mass: 5.5\n    center_of_mass: [0.01, 0.02, 0.03]\n    inertia: {ixx: 0.1, iyy: 0.2, izz: "
    "0.25, ixy: 0.01, ixz: -0.02, iyz: 0.03}\n";

/// One of each solid, by mass and by density, turned and moved.
inline std::string scenarioOfParts() {
  return with(validScenario(), kMassByNumbers, R"(    parts:
      - {box: {size: [0.6, 0.4, 0.1]}, density: 31.7}
      - {cylinder: {radius: 0.05, length: 0.2}, mass: 0.3, position: [-0.25, 0, 0.1], rpy: [0, 1.5707963267948966, 0]}
      - {cone: {radius: 0.07, length: 0.3}, mass: 0.15, position: [0.3, 0, 0.05], rpy: [0.1, 1.1, -0.4]}
      - {sphere: {radius: 0.033}, density: 7850, position: [0.01, 0.07, 0]}
)");
}

inline Scenario parsed(const std::string& text) {
  ScenarioSource source;
  source.name = "test.yaml";
  source.directory = "test/data";
  return parseScenario(text, source);
}

/// What a scenario that is in order says, line by line.
inline std::vector<std::string> notesOn(const std::string& text) {
  std::vector<std::string> notes;
  ScenarioSource source;
  source.name = "test.yaml";
  source.directory = "test/data";
  source.note = [&notes](const std::string& note) { notes.push_back(note); };
  parseScenario(text, source);
  return notes;
}

/// What parsing says.
inline std::string complaintAbout(const std::string& text) {
  return messageOf([&text] { parsed(text); });
}

}  // namespace hovercraft::testing
