#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/cushion/hover.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// The hover of one craft over level ground, as the tool `cushion` shows it.
struct HoverReport {
  std::string vehicle;
  double mass = 0.0;        // kg
  double weight = 0.0;      // N
  double hem_length = 0.0;  // m
  double area = 0.0;        // m²
  double mass_flow = 0.0;   // kg/s, that the fans take in: momentum drag per m/s
  Hover hover;
};

/// Of the craft with a cushion. @param vehicle its name; empty: all of them.
/// @throws std::invalid_argument if there is none.
HOVERCRAFT_PUBLIC std::vector<HoverReport> hoverReports(const Scenario& scenario,
                                                        const std::string& vehicle);

/// Text for people: one paragraph for each craft.
HOVERCRAFT_PUBLIC std::string toText(const std::vector<HoverReport>& reports);

/// One JSON object, numbers as appendNumber(); several in {"vehicles": {NAME: object, ...}}. What a
/// craft that does not hover has not is null.
HOVERCRAFT_PUBLIC std::string toJson(const std::vector<HoverReport>& reports);

}  // namespace hovercraft
