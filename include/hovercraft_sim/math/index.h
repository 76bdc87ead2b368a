#pragma once

#include <cstddef>
#include <cstdint>

namespace hovercraft {

/// The index of an element of a standard container. What is stored about vertices, faces and bodies
/// are 32-bit numbers: they take half the memory.
/// @param index not negative.
constexpr std::size_t at(std::int32_t index) {
  return static_cast<std::size_t>(index);
}

}  // namespace hovercraft
