#pragma once

#include <string>
#include <vector>

#include "hovercraft_sim/analysis/compare.h"
#include "hovercraft_sim/math/export.h"
#include "hovercraft_sim/report/run_data.h"

namespace hovercraft_ros {

/// How two runs of one body differ.
struct BodyComparison {
  std::string name;
  hovercraft::Comparison comparison;
};

/// The bodies of the same name of both runs (of a single one each, whatever they are called),
/// compared at the times that both have; where there is none, B interpolated at the times of A.
HOVERCRAFT_PUBLIC std::vector<BodyComparison> compareRuns(const RunData& a, const RunData& b);

/// The page: the front end, and the runs as numbers packed for it. It needs nothing else when it is
/// opened, and no network. Every text of a bag is data in it, none is markup.
/// @param runs one or two.
HOVERCRAFT_PUBLIC std::string pageOf(const std::vector<RunData>& runs,
                                     const std::vector<BodyComparison>& comparisons);

/// The data of a page alone, as JSON.
HOVERCRAFT_PUBLIC std::string pageJson(const std::vector<RunData>& runs,
                                       const std::vector<BodyComparison>& comparisons);

}  // namespace hovercraft_ros
