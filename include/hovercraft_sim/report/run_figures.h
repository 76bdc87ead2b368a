#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/report/figure.h"
#include "hovercraft_sim/report/run_data.h"

namespace hovercraft_ros {

struct NamedFigure {
  std::string name;  // of a file, without its ending: small letters, digits and _
  Figure figure;
};

/// The plots of a page, one figure each: the way from above, then the panels of each body, with
/// those of the second run dashed.
/// @param runs one or two.
HOVERCRAFT_PUBLIC std::vector<NamedFigure> figuresOf(const std::vector<RunData>& runs);

}  // namespace hovercraft_ros
