#pragma once

#include <string_view>

namespace hovercraft_ros {

/// The front end as it was built into web/dist: the page with two comments in the places of data
/// and script, the page that is fed live (src/web), and the script of both. CMake makes the source
/// of these from the files.
std::string_view frontEndPage();
std::string_view frontEndLivePage();
std::string_view frontEndScript();

}  // namespace hovercraft_ros
