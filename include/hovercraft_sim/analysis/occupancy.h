#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/records/simulate.h"
#include "hovercraft_sim/scenario/scenario.h"

namespace hovercraft {

/// What a map of a scenario is asked for.
struct OccupancyRequest {
  double height = 0.1;       // m, in W: of the plane that is mapped
  double resolution = 0.05;  // m, side of a cell
  double margin = 0.5;       // m of free cells around the obstacles
};

/// Which cells of a plane of W the obstacles reach into.
struct OccupancyMap {
  double resolution = 0.0;  // m
  double origin_x = 0.0;    // m, of the lower left corner of the first cell, in W
  double origin_y = 0.0;
  std::int32_t width = 0;  // cells along x
  std::int32_t height = 0;
  std::vector<std::int8_t> cells;  // row by row from the least y: 100 occupied, 0 free
};

/// The obstacles of a scenario, cut at a height. A cell is occupied if an obstacle has a point in
/// it, its border included. Craft and loose bodies are not in it.
/// @throws std::invalid_argument with the rule if no obstacle reaches the height, if a number of
/// the request is not positive and finite, or if the map would have more than 10^8 cells.
HOVERCRAFT_PUBLIC OccupancyMap occupancyOf(const Scenario& scenario,
                                           const OccupancyRequest& request);

/// As map_server reads it: `path` (.yaml) and, beside it, the image with the same name (.pgm).
/// @param inputs files that must stay.
/// @throws std::invalid_argument if the path does not end in .yaml, or cannot be written.
HOVERCRAFT_PUBLIC void writeMap(const OccupancyMap& map, const std::string& path,
                                const std::vector<std::string>& inputs = {});

/// The tool `occupancy`: the map of a scenario file. @throws as loadScenarioFile(), occupancyOf()
/// and writeMap().
HOVERCRAFT_PUBLIC void writeMapOf(const std::string& scenario, const OccupancyRequest& request,
                                  const std::string& path, RosFiles& ros);

}  // namespace hovercraft
