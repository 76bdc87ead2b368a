#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hovercraft_sim/math/export.h"

namespace hovercraft {

/// An image of grey values.
struct GreyImage {
  std::size_t columns = 0;
  std::size_t rows = 0;
  std::uint32_t most = 255;           // the greatest value that a pixel may have
  std::vector<std::uint16_t> pixels;  // row by row from above, each from the left
};

/// Greatest length (bytes) of an image file: written into the text of a scenario it takes a third
/// more, which must stay below kLongestYamlText.
constexpr std::size_t kMostImageBytes = 8U << 20U;

/// Most pixels of an image, 2048 by 2048: 32 MB as heights.
constexpr std::size_t kMostPixels = 4U << 20U;

/// The image in the bytes of a PGM (P2 or P5) or grey PNG file, of 8 or 16 bits. Any bytes may
/// come.
/// @throws std::invalid_argument with the rule.
HOVERCRAFT_PUBLIC GreyImage greyImageOf(const std::string& bytes);

}  // namespace hovercraft
