#pragma once

#include <string_view>

namespace hovercraft_ros {

/// The front end as it was built into web/dist: the page with two comments in the places of data
/// and script, and the script. CMake makes the source of these from the files.
std::string_view frontEndPage();
std::string_view frontEndScript();

}  // namespace hovercraft_ros
