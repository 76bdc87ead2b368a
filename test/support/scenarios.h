#pragma once

#include <string>

#include "hovercraft_sim/scenario/scenario_parser.h"

namespace hovercraft::testing {

/// A planar craft of 2 kg and 0.5 kg m² without drag or lag, all engines within ±10 N with a
/// time-out of 0.5 s: 1 N from the rear engine accelerates it by 0.5 m/s².
inline std::string craftYaml(const std::string& name) {
  return "  " + name +
         ":\n"
         "    mass: 2\n"
         "    inertia: {ixx: 0.5, iyy: 0.5, izz: 0.5}\n"
         "    engines:\n"
         "      rear: {position: [-1, 0, 0], direction: [1, 0, 0], min_thrust: -10, max_thrust: "
         "10}\n"
         "      left: {position: [1, 0, 0], direction: [0, -1, 0], min_thrust: -10, max_thrust: "
         "10}\n"
         "      right: {position: [1, 0, 0], direction: [0, 1, 0], min_thrust: -10, max_thrust: "
         "10}\n";
}

/// That craft, stepped by 10 ms.
inline std::string oneCraftYaml() {
  return "step_size: 0.01\nmodel: planar\nvehicles:\n" + craftYaml("craft");
}

/// Two such craft, alpha and beta.
inline std::string twoCraftYaml() {
  return "step_size: 0.01\nmodel: planar\nvehicles:\n" + craftYaml("alpha") + craftYaml("beta");
}

inline Scenario scenarioOf(const std::string& yaml) {
  return parseScenario(yaml, {"test", "", {}});
}

}  // namespace hovercraft::testing
