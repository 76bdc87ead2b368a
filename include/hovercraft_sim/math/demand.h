#pragma once

#include <stdexcept>
#include <string>

namespace hovercraft {

/// Checks an invariant of our own code, in every build.
/// @throws std::logic_error with `message` when `condition` is false: a bug of this library, never
/// of its user.
inline void demand(bool condition, const char* message) {
  if (!condition) throw std::logic_error(std::string("hovercraft_sim bug: ") + message);
}

}  // namespace hovercraft
