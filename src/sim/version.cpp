#include "hovercraft_sim/sim/version.h"

#include <fmt/format.h>

namespace hovercraft {

std::string versionText(const std::string& program) {
  return fmt::format("{} of hovercraft_sim {}, physics version {}", program, kVersion,
                     kPhysicsVersion);
}

}  // namespace hovercraft
