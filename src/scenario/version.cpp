#include "hovercraft_sim/scenario/version.h"

#include <algorithm>
#include <fmt/format.h>
#include <iostream>
#include <string_view>

namespace hovercraft {

std::string softwareText() {
  return fmt::format("hovercraft_sim {} (commit {})", version(), commit());
}

std::string versionText(const std::string& program) {
  return fmt::format("{} of {}, physics version {}", program, softwareText(), kPhysicsVersion);
}

bool answersVersion(const std::string& program, int argc, char** argv) {
  const bool is_asked =
      std::any_of(argv + std::min(argc, 1), argv + argc,
                  [](const char* argument) { return std::string_view(argument) == "--version"; });
  if (is_asked) std::cout << versionText(program) << '\n';
  return is_asked;
}

}  // namespace hovercraft
