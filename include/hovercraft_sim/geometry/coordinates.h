#pragma once

#include <fmt/format.h>
#include <string>

#include "hovercraft_sim/math/vector.h"

namespace hovercraft {

/// A point for a message, such as "(0.5, 0, -2)": the same text with every version of fmt.
inline std::string coordinates(const Vector3& p) {
  return fmt::format("({:.12g}, {:.12g}, {:.12g})", p.x(), p.y(), p.z());
}

}  // namespace hovercraft
