#pragma once

#include <string_view>
#include <vector>

#include "hovercraft_sim/report/figure.h"

namespace hovercraft_ros {

/// A text as lines, its base line on y = 0 (y down), from x = 0 on.
struct StrokedText {
  std::vector<std::vector<FigurePoint>> lines;
  double width = 0.0;
};

/// A line of ASCII in Hershey's simplex letters, which need no font file; any other character is a
/// question mark. @param size height of capitals.
StrokedText strokesOf(std::string_view text, double size);

}  // namespace hovercraft_ros
