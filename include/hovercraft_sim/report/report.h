#pragma once

#include <ostream>
#include <string>

#include "hovercraft_sim/math/export.h"

namespace hovercraft_ros {

/// What the tool `report` was asked for.
struct ReportRequest {
  std::string bag;
  std::string other;                   // a second bag, laid over the first; or empty
  std::string output = "report.html";  // the page
  std::string png;                     // folder for the plots as pictures; or empty
  std::string svg;                     // the same as drawings
  bool shows_progress = false;         // a bar on `terminal`
};

/// Makes the page of a bag, or of two, and whatever else was asked for; says on `terminal` what it
/// could not read.
/// @returns numbers of the run, a line each, and what was made.
/// @throws std::invalid_argument for whatever in the request or the bags is bad.
HOVERCRAFT_PUBLIC std::string makeReport(const ReportRequest& request, std::ostream& terminal);

}  // namespace hovercraft_ros
