#include "hovercraft_sim/io/base64.h"

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

/// How many '=' the last four characters end in: two at most.
std::size_t paddingOf(const std::string& text) {
  const std::size_t size = text.size();
  if (size < 4 || text[size - 1] != '=') return 0;
  return text[size - 2] == '=' ? 2 : 1;
}

/// The 24 bits of four characters, of which `padding` stand for 0; nothing if another one has no
/// place in the alphabet.
std::optional<std::uint32_t> bitsOf(const std::string& text, std::size_t first,
                                    std::size_t padding) {
  std::uint32_t group = 0;
  for (std::size_t i = first; i < first + 4 - padding; ++i) {
    const std::size_t digit = kAlphabet.find(text[i]);
    if (digit == std::string_view::npos) return std::nullopt;
    group = (group << 6U) | static_cast<std::uint32_t>(digit);
  }
  return group << (6U * static_cast<unsigned int>(padding));
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

std::optional<std::string> base64Bytes(const std::string& text) {
  if (text.size() % 4 != 0) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  for (std::size_t first = 0; first < text.size(); first += 4) {
    const std::size_t padding = first + 4 == text.size() ? paddingOf(text) : 0;
    const std::optional<std::uint32_t> group = bitsOf(text, first, padding);
    if (!group) return std::nullopt;
    for (std::size_t i = 0; i < 3 - padding; ++i) {
      bytes += static_cast<char>((*group >> (16U - 8U * static_cast<unsigned int>(i))) & 255U);
    }
  }
  return bytes;
}

}  // namespace hovercraft
