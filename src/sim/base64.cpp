#include "hovercraft_sim/sim/base64.h"

#include <cstdint>
#include <string_view>

namespace hovercraft {
namespace {

constexpr std::string_view kAlphabet =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

/// Three bytes, or fewer at the end, as one number of 24 bits.
std::uint32_t groupAt(const std::string& bytes, std::size_t first) {
  std::uint32_t group = 0;
  for (std::size_t i = first; i < first + 3; ++i) {
    group <<= 8U;
    if (i < bytes.size()) group |= static_cast<unsigned char>(bytes[i]);
  }
  return group;
}

}  // namespace

std::string base64Text(const std::string& bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t first = 0; first < bytes.size(); first += 3) {
    const std::uint32_t group = groupAt(bytes, first);
    for (unsigned int shift = 18; shift < 24; shift -= 6) {  // 18, 12, 6, 0
      text += kAlphabet[(group >> shift) & 63U];
    }
    const std::size_t left = bytes.size() - first;
    for (std::size_t i = left; i < 3; ++i) text[text.size() + i - 3] = '=';
  }
  return text;
}

// NOLINTNEXTLINE(readability-function-cognitive-complexity): to be split.
std::optional<std::string> base64Bytes(const std::string& text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t first = 0; first < text.size(); first += 4) {
    std::uint32_t group = 0;
    std::size_t padding = 0;
    for (std::size_t i = first; i < first + 4; ++i) {
      const std::size_t digit = kAlphabet.find(text[i]);
      const bool is_padding = text[i] == '=' && first + 4 == text.size() && i >= first + 2;
      if (is_padding ? false : digit == std::string_view::npos || padding > 0) return std::nullopt;
      if (is_padding) ++padding;
      group = (group << 6U) | (is_padding ? 0U : static_cast<std::uint32_t>(digit));
    }
    for (std::size_t i = 0; i < 3 - padding; ++i) {
      bytes += static_cast<char>((group >> (16U - 8U * static_cast<unsigned int>(i))) & 255U);
    }
  }
  return bytes;
}

}  // namespace hovercraft
